"""``nav_msgs/Odometry`` from CDR, without what nobody draws.

``decode_odometry``  pose and velocity of a message

A third of what a run says is odometry, and most of each message are covariances.
"""

import struct
from typing import Final

from tlcomm_core.geometry import Pose, yaw_from_quaternion
from tlcomm_core.world.observation import Odometry
from tlcomm_tools.bag.cdr import Cursor

__all__ = ["decode_odometry"]

# position and orientation; behind 36 covariances, linear and angular velocity
_NUMBERS: Final = struct.Struct("<7d288x6d")
_WIDTH: Final = 8


def decode_odometry(data: bytes, agent: str) -> Odometry:
    """Return an agent's odometry.

    Raises:
        ValueError: it isn't little-endian CDR, or too short.
    """
    cursor = Cursor(data)
    stamp_ns = cursor.take_stamp_ns()
    # The frames of pose and velocity.
    cursor.skip_text()
    cursor.skip_text()
    x_m, y_m, _, _, _, z, w, linear_mps, _, _, _, _, angular_radps = cursor.take(_NUMBERS, _WIDTH)
    return Odometry(
        stamp_ns=stamp_ns,
        agent=agent,
        pose=Pose(x_m, y_m, yaw_from_quaternion(z, w)),
        linear_mps=linear_mps,
        angular_radps=angular_radps,
    )
