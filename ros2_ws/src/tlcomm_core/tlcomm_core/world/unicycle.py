"""Exact motion of a unicycle under constant velocity.

``integrate``  the pose after a while
``positions``  the positions of many unicycles at many times, vectorised
"""

import math

import numpy as np
from numpy.typing import NDArray

from tlcomm_core.geometry import Pose, wrap_angle

__all__ = ["integrate", "positions"]


def integrate(pose: Pose, linear_mps: float, angular_radps: float, duration_s: float) -> Pose:
    """Return the pose after driving with constant velocity.

    The chord form v·t·sin(ωt/2)/(ωt/2) along the mean heading holds for straights and arcs alike,
    without a threshold at ω = 0. At v = 0 the position keeps its bits.

    Args:
        pose: pose at the beginning.
        linear_mps: forward speed v, negative for backwards.
        angular_radps: turn rate ω, counter-clockwise.
        duration_s: how long t, of any sign.

    Returns:
        The pose, its yaw in (-π, π].
    """
    half_turn_rad = 0.5 * angular_radps * duration_s
    chord_m = linear_mps * duration_s
    if half_turn_rad != 0.0:
        chord_m *= math.sin(half_turn_rad) / half_turn_rad
    heading_rad = pose.yaw_rad + half_turn_rad
    return Pose(
        pose.x_m + chord_m * math.cos(heading_rad),
        pose.y_m + chord_m * math.sin(heading_rad),
        wrap_angle(pose.yaw_rad + angular_radps * duration_s),
    )


def positions(
    poses: NDArray[np.float64],
    linear_mps: NDArray[np.float64],
    angular_radps: NDArray[np.float64],
    duration_s: NDArray[np.float64],
) -> NDArray[np.float64]:
    """Return where unicycles are at several times, as ``integrate`` does up to rounding.

    Args:
        poses: x, y, yaw of each, float[N, 3].
        linear_mps: forward speeds, float[N].
        angular_radps: turn rates, float[N].
        duration_s: times since ``poses``; float[T, N], or float[T, 1] for the same for all.

    Returns:
        x and y, float[T, N, 2].
    """
    half_turn_rad = 0.5 * angular_radps * duration_s
    chord_m = linear_mps * duration_s * np.sinc(half_turn_rad / np.pi)
    heading_rad = poses[:, 2] + half_turn_rad
    steps = np.stack((np.cos(heading_rad), np.sin(heading_rad)), axis=-1)
    places_m: NDArray[np.float64] = poses[:, :2] + chord_m[..., np.newaxis] * steps
    return places_m
