"""A serialised message (CDR), field by field, where a whole decoder would take too long.

``Cursor``            where its next field lies
``is_little_endian``  whether it has one
"""

import struct
from typing import Any, Final

from tlcomm_core.units import NANOSECONDS_PER_SECOND

__all__ = ["Cursor", "is_little_endian"]

# What comes first says how the rest is encoded; fields are aligned from behind it.
_LITTLE_ENDIAN: Final = b"\x00\x01"
_HEAD: Final = 4
_WORD: Final = 4
_STAMP: Final = struct.Struct("<iI")
_LENGTH: Final = struct.Struct("<I")


def is_little_endian(data: bytes) -> bool:
    """Return whether a message is encoded as all machines do that robots have."""
    return data[:2] == _LITTLE_ENDIAN


class Cursor:
    """Where a message's next field lies; it only moves on."""

    def __init__(self, data: bytes) -> None:
        """Begin at the first field.

        Raises:
            ValueError: it isn't little-endian CDR.
        """
        if not is_little_endian(data):
            raise ValueError(f"no little-endian CDR: it begins with {data[:2]!r}")
        self._data: Final = data
        self._at = _HEAD

    def take(self, layout: struct.Struct, width: int = _WORD) -> tuple[Any, ...]:
        """Return fields that lie side by side.

        Args:
            layout: theirs.
            width: of the first one, in bytes.

        Raises:
            ValueError: the message ends before.
        """
        at = self._at + -(self._at - _HEAD) % width
        self._at = at + layout.size
        try:
            return layout.unpack_from(self._data, at)
        except struct.error as error:
            raise ValueError(f"{len(self._data)} bytes are no message of its type") from error

    def take_stamp_ns(self) -> int:
        """Return a ``builtin_interfaces/Time`` in nanoseconds."""
        sec, nanosec = self.take(_STAMP)
        return int(sec) * NANOSECONDS_PER_SECOND + int(nanosec)

    def skip_text(self) -> None:
        """Pass over a string."""
        (length,) = self.take(_LENGTH)
        self._at += length

    def skip_header(self) -> None:
        """Pass over a ``std_msgs/Header``."""
        self.take(_STAMP)
        self.skip_text()
