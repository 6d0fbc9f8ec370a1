"""An agent's path as ``nav_msgs/Path``, in CDR.

``encode_plan``   the way ahead
``encode_trail``  the way behind

Paths are most of what is mirrored. A generic serializer takes twenty times as long for them, and a
``PoseStamped`` in this frame always has the same size.
"""

import struct
from collections.abc import Iterable, Sequence
from typing import Final

from tlcomm_core.geometry import Pose, quaternion_from_yaw
from tlcomm_core.units import NANOSECONDS_PER_SECOND
from tlcomm_core.world.observation import Odometry
from tlcomm_tools.mirror.elements import FRAME
from tlcomm_tools.mirror.way import Corner

__all__ = ["encode_plan", "encode_trail"]

# A string in CDR: its length with the zero behind it, then both.
_FRAME: Final = struct.pack("<I", len(FRAME) + 1) + FRAME.encode() + b"\0"
_LITTLE_ENDIAN: Final = b"\x00\x01\x00\x00"
_STAMP: Final = struct.Struct("<iI")
_COUNT: Final = struct.Struct("<I")
# stamp, frame, position and orientation: whole words of eight bytes, if the frame's text fits
_POSE: Final = struct.Struct(f"<iI{len(_FRAME)}s7d")
assert (_STAMP.size + len(_FRAME)) % 8 == 0
# Only before the first pose's numbers something must be filled up, since the count is odd.
_HEAD: Final = _STAMP.size + len(_FRAME)
_FILLING: Final = bytes(4)


def encode_trail(trail: Iterable[Odometry], now_ns: int) -> bytes:
    """Return where an agent has driven, each pose with its time."""
    return _path(now_ns, [(own.stamp_ns, own.pose) for own in trail])


def encode_plan(here: Odometry | None, corners: Sequence[Corner], now_ns: int) -> bytes:
    """Return where an agent will drive: from where it is, by some corners.

    Each pose's stamp is when the agent is expected to be done at the next stop. The path is empty
    if there is no corner.
    """
    ahead = [(corner.stamp_ns, corner.pose) for corner in corners]
    return _path(now_ns, [(now_ns, here.pose), *ahead] if here and ahead else [])


def _path(now_ns: int, poses: Sequence[tuple[int, Pose]]) -> bytes:
    stamp = _STAMP.pack(*divmod(now_ns, NANOSECONDS_PER_SECOND))
    begin = _LITTLE_ENDIAN + stamp + _FRAME + _COUNT.pack(len(poses))
    if not poses:
        return begin
    records = b"".join([_record(stamp_ns, pose) for stamp_ns, pose in poses])
    return begin + records[:_HEAD] + _FILLING + records[_HEAD:]


def _record(stamp_ns: int, pose: Pose) -> bytes:
    sec, nanosec = divmod(stamp_ns, NANOSECONDS_PER_SECOND)
    z, w = quaternion_from_yaw(pose.yaw_rad)
    return _POSE.pack(sec, nanosec, _FRAME, pose.x_m, pose.y_m, 0.0, 0.0, 0.0, z, w)
