"""The small parts of standard messages, as the ``rosbags`` library has them.

``FRAME``          of all mirrors
``Colour``         red, green, blue and opacity, from 0 to 1
``agent_colour``   an agent's
``make_header``, ``make_time``, ``make_point``, ``make_pose``
"""

from typing import Final

from rosbags.typesys.stores import ros2_jazzy as ros

from tlcomm_core.geometry import Pose, quaternion_from_yaw
from tlcomm_core.units import NANOSECONDS_PER_SECOND

__all__ = [
    "FRAME",
    "Colour",
    "agent_colour",
    "make_header",
    "make_point",
    "make_pose",
    "make_time",
]

FRAME: Final = "map"

Colour = tuple[float, float, float, float]

# Told apart by the colour-blind, too (Okabe and Ito 2008); on white and on black.
_PALETTE: Final[tuple[Colour, ...]] = (
    (0.00, 0.45, 0.70, 1.0),
    (0.90, 0.62, 0.00, 1.0),
    (0.00, 0.62, 0.45, 1.0),
    (0.80, 0.47, 0.65, 1.0),
    (0.34, 0.71, 0.91, 1.0),
    (0.84, 0.37, 0.00, 1.0),
    (0.94, 0.89, 0.26, 1.0),
    (0.60, 0.60, 0.60, 1.0),
)


def agent_colour(number: int) -> Colour:
    """Return the colour of the agent with this number in the scenario."""
    return _PALETTE[number % len(_PALETTE)]


def make_time(stamp_ns: int) -> ros.builtin_interfaces__msg__Time:
    """Return a time."""
    sec, nanosec = divmod(stamp_ns, NANOSECONDS_PER_SECOND)
    return ros.builtin_interfaces__msg__Time(sec, nanosec)


def make_header(stamp_ns: int) -> ros.std_msgs__msg__Header:
    """Return a header in the frame of all mirrors."""
    return ros.std_msgs__msg__Header(make_time(stamp_ns), FRAME)


def make_point(x_m: float, y_m: float, z_m: float = 0.0) -> ros.geometry_msgs__msg__Point:
    """Return a point."""
    return ros.geometry_msgs__msg__Point(x_m, y_m, z_m)


def make_pose(pose: Pose, z_m: float = 0.0) -> ros.geometry_msgs__msg__Pose:
    """Return a pose, at a height."""
    z, w = quaternion_from_yaw(pose.yaw_rad)
    turn = ros.geometry_msgs__msg__Quaternion(0.0, 0.0, z, w)
    return ros.geometry_msgs__msg__Pose(make_point(pose.x_m, pose.y_m, z_m), turn)
