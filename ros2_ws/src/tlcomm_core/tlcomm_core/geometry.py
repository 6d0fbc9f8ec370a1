"""Planar poses and angles (REP 103: metres, radians, counter-clockwise from +x)."""

import math
from dataclasses import dataclass

__all__ = ["Pose", "quaternion_from_yaw", "wrap_angle", "yaw_from_quaternion"]


@dataclass(frozen=True, slots=True)
class Pose:
    """Position and orientation in the frame ``map``."""

    x_m: float
    y_m: float
    yaw_rad: float

    def distance_m(self, x_m: float, y_m: float) -> float:
        """Euclidean distance to a point."""
        return math.hypot(self.x_m - x_m, self.y_m - y_m)

    def as_transmitted(self) -> "Pose":
        """Return this pose as an odometry message carries it: yaw through a quaternion and back.

        The world hands out only such poses, so that an agent reads the same bits in process and
        over ROS.
        """
        return Pose(self.x_m, self.y_m, yaw_from_quaternion(*quaternion_from_yaw(self.yaw_rad)))


def wrap_angle(angle_rad: float) -> float:
    """Return the equivalent angle in (-π, π]."""
    wrapped = math.remainder(angle_rad, math.tau)
    return math.pi if wrapped == -math.pi else wrapped


def quaternion_from_yaw(yaw_rad: float) -> tuple[float, float]:
    """Return (z, w) of the unit quaternion that turns by ``yaw_rad`` about z."""
    return math.sin(yaw_rad / 2.0), math.cos(yaw_rad / 2.0)


def yaw_from_quaternion(z: float, w: float) -> float:
    """Return the yaw in (-π, π] of a quaternion (0, 0, z, w); its norm needn't be 1."""
    return wrap_angle(2.0 * math.atan2(z, w))
