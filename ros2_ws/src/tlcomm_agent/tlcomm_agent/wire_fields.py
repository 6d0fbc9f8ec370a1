"""Fields that messages have in common, made.

``header``, ``time``  of nanoseconds
"""

from typing import Final

from builtin_interfaces.msg import Time
from std_msgs.msg import Header

from tlcomm_core.units import NANOSECONDS_PER_SECOND

__all__ = ["header", "time"]

_FRAME: Final = "map"


def header(stamp_ns: int, frame: str = _FRAME) -> Header:
    """Return a header in a frame, of a time in nanoseconds."""
    return Header(stamp=time(stamp_ns), frame_id=frame)


def time(stamp_ns: int) -> Time:
    """Return a time of nanoseconds."""
    sec, nanosec = divmod(stamp_ns, NANOSECONDS_PER_SECOND)
    return Time(sec=sec, nanosec=nanosec)
