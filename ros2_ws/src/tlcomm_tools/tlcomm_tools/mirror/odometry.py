"""``nav_msgs/Odometry`` from CDR, without what nobody draws.

``decode_odometry``  pose and velocity of a message

A third of what a run says is odometry, and most of each message are covariances.
"""

import struct
from typing import Final

from tlcomm_core.geometry import Pose, yaw_from_quaternion
from tlcomm_core.units import NANOSECONDS_PER_SECOND
from tlcomm_core.world.observation import Odometry

__all__ = ["decode_odometry"]

_LITTLE_ENDIAN: Final = b"\x00\x01"
_ENCAPSULATION: Final = 4
_STAMP: Final = struct.Struct("<iI")
_LENGTH: Final = struct.Struct("<I")
# position and orientation; behind 36 covariances, linear and angular velocity
_NUMBERS: Final = struct.Struct("<7d288x6d")


def decode_odometry(data: bytes, agent: str) -> Odometry:
    """Return an agent's odometry.

    Raises:
        ValueError: it isn't little-endian CDR, or too short.
    """
    if data[:2] != _LITTLE_ENDIAN:
        raise ValueError(f"no little-endian CDR: it begins with {data[:2]!r}")
    try:
        sec, nanosec = _STAMP.unpack_from(data, _ENCAPSULATION)
        end = _string_end(data, _ENCAPSULATION + _STAMP.size)
        end = _string_end(data, end + -end % 4)
        begin = end + -(end - _ENCAPSULATION) % 8
        x_m, y_m, _, _, _, z, w, linear_mps, _, _, _, _, angular_radps = _NUMBERS.unpack_from(
            data, begin
        )
    except struct.error as error:
        raise ValueError(f"{len(data)} bytes are no odometry") from error
    return Odometry(
        stamp_ns=sec * NANOSECONDS_PER_SECOND + nanosec,
        agent=agent,
        pose=Pose(x_m, y_m, yaw_from_quaternion(z, w)),
        linear_mps=linear_mps,
        angular_radps=angular_radps,
    )


def _string_end(data: bytes, offset: int) -> int:
    length: int = _LENGTH.unpack_from(data, offset)[0]
    return offset + _LENGTH.size + length
