"""When a message was stamped, without decoding the rest of it.

``first_stamp_ns``  of a message that begins with one
``stamp_reader``    reads the stamps of one type's messages
"""

import struct
from collections.abc import Callable
from typing import Final

from rosbags.interfaces import Nodetype
from rosbags.typesys.store import Typestore

from tlcomm_core.units import NANOSECONDS_PER_SECOND
from tlcomm_tools.wire import stamp_ns

__all__ = ["first_stamp_ns", "stamp_reader"]

_HEADER: Final = (Nodetype.NAME, "std_msgs/msg/Header")
# CDR: behind the four bytes of the encapsulation, of which the second tells the byte order.
_STAMP: Final = (struct.Struct(">iI"), struct.Struct("<iI"))
_OFFSET: Final = 4


def first_stamp_ns(data: bytes) -> int:
    """Return the stamp (ns) that a serialised message begins with, as all recorded types do.

    Raises:
        ValueError: it is too short to have one.
    """
    if len(data) < _OFFSET + _STAMP[0].size:
        raise ValueError(f"{len(data)} bytes are no message with a stamp")
    seconds, nanoseconds = _STAMP[data[1] & 1].unpack_from(data, _OFFSET)
    return int(seconds) * NANOSECONDS_PER_SECOND + int(nanoseconds)


def stamp_reader(store: Typestore, kind: str) -> Callable[[bytes], int]:
    """Return what reads the stamp (ns) of a serialised message.

    Args:
        store: with the type.
        kind: of the message; it has a header. If that comes first, nothing else is decoded.
    """
    _, (first, *_) = store.fielddefs[kind]
    if first[1] == _HEADER:
        return first_stamp_ns
    return lambda data: stamp_ns(store.deserialize_cdr(data, kind).header.stamp)  # type: ignore[attr-defined]
