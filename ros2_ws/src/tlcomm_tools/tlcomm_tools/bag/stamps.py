"""When a message was stamped, without decoding the rest of it.

``stamp_reader``  reads the stamps of one type's messages
"""

import struct
from collections.abc import Callable
from typing import Final

from rosbags.interfaces import Nodetype
from rosbags.typesys.store import Typestore

from tlcomm_core.units import NANOSECONDS_PER_SECOND
from tlcomm_tools.wire import stamp_ns

__all__ = ["stamp_reader"]

_HEADER: Final = (Nodetype.NAME, "std_msgs/msg/Header")
# CDR: behind the four bytes of the encapsulation, of which the second tells the byte order.
_STAMP: Final = (struct.Struct(">iI"), struct.Struct("<iI"))
_OFFSET: Final = 4


def stamp_reader(store: Typestore, kind: str) -> Callable[[bytes], int]:
    """Return what reads the stamp (ns) of a serialised message.

    Args:
        store: with the type.
        kind: of the message; it has a header. If that comes first, nothing else is decoded.
    """
    _, (first, *_) = store.fielddefs[kind]
    if first[1] == _HEADER:
        return _read_first
    return lambda data: stamp_ns(store.deserialize_cdr(data, kind).header.stamp)  # type: ignore[attr-defined]


def _read_first(data: bytes) -> int:
    seconds, nanoseconds = _STAMP[data[1] & 1].unpack_from(data, _OFFSET)
    return int(seconds) * NANOSECONDS_PER_SECOND + int(nanoseconds)
