"""Constant-velocity motion against circle geometry."""

import math

import numpy as np
import pytest

from tlcomm_core.geometry import Pose
from tlcomm_core.world.unicycle import integrate, positions


def test_a_straight_goes_along_the_heading() -> None:
    """2 s at 0.5 m/s facing +y is one metre in y."""
    pose = integrate(Pose(1.0, 2.0, math.pi / 2), 0.5, 0.0, 2.0)
    assert (pose.x_m, pose.y_m) == pytest.approx((1.0, 3.0), abs=1e-15)
    assert pose.yaw_rad == math.pi / 2


def test_turning_on_the_spot_keeps_the_position_to_the_bit() -> None:
    """At v = 0 only the yaw changes."""
    pose = integrate(Pose(0.1, 0.7, 0.3), 0.0, 1.5, 0.77)
    assert (pose.x_m, pose.y_m) == (0.1, 0.7)
    assert pose.yaw_rad == pytest.approx(0.3 + 1.5 * 0.77)


def test_a_quarter_circle_ends_beside_its_centre() -> None:
    """With v = ω the radius is 1 m: a quarter turn left from the origin ends at (1, 1)."""
    pose = integrate(Pose(0.0, 0.0, 0.0), 2.0, 2.0, math.pi / 4)
    assert (pose.x_m, pose.y_m, pose.yaw_rad) == pytest.approx((1.0, 1.0, math.pi / 2))


def test_a_full_circle_returns() -> None:
    """After 2π/ω the pose is the first again."""
    pose = integrate(Pose(3.0, 4.0, 1.0), 1.0, -1.5, math.tau / 1.5)
    assert (pose.x_m, pose.y_m, pose.yaw_rad) == pytest.approx((3.0, 4.0, 1.0))


@pytest.mark.parametrize("angular_radps", [1e-300, 1e-16, 1e-9, 1e-6, 1e-4])
def test_an_arc_tends_to_the_straight(angular_radps: float) -> None:
    """The end differs from the straight's by no more than the arc's own sagitta v·ω·t²/2."""
    straight = integrate(Pose(0.0, 0.0, 0.4), 1.0, 0.0, 3.0)
    arc = integrate(Pose(0.0, 0.0, 0.4), 1.0, angular_radps, 3.0)
    assert straight.distance_m(arc.x_m, arc.y_m) <= 4.5 * angular_radps + 1e-15


def test_the_yaw_is_wrapped_to_the_upper_end() -> None:
    """Half a turn from 0, either way, is +π."""
    assert integrate(Pose(0.0, 0.0, 0.0), 0.0, math.pi, 1.0).yaw_rad == math.pi
    assert integrate(Pose(0.0, 0.0, 0.0), 0.0, -math.pi, 1.0).yaw_rad == math.pi


def test_many_at_many_times_are_the_same_as_one_by_one() -> None:
    """The vectorised form agrees with the scalar one to rounding, straights and rests included."""
    poses = np.array([[1.0, 2.0, 0.5], [-1.0, 0.0, -3.0], [0.0, 5.0, 2.0], [4.0, 4.0, 1.0]])
    linear, angular = np.array([1.0, -0.5, 0.7, 0.0]), np.array([1.5, 0.0, -1e-9, 1.0])
    times = np.linspace(-1.0, 4.0, 7)[:, np.newaxis] + np.array([0.0, 0.1, 0.2, 0.3])
    found = positions(poses, linear, angular, times)
    for row, column in np.ndindex(7, 4):
        pose = integrate(Pose(*poses[column]), linear[column], angular[column], times[row, column])
        assert found[row, column] == pytest.approx((pose.x_m, pose.y_m), abs=1e-14)
