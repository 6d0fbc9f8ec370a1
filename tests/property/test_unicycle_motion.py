"""What holds for every constant-velocity motion."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tlcomm_core.geometry import Pose
from tlcomm_core.world.unicycle import integrate

coordinates = st.floats(-50.0, 50.0)
poses = st.builds(Pose, coordinates, coordinates, st.floats(-math.pi, math.pi))
speeds = st.one_of(st.floats(-2.0, 2.0), st.just(0.0), st.floats(-1e-9, 1e-9))
durations = st.floats(0.0, 20.0)


def assert_same(one: Pose, other: Pose, tolerance: float = 1e-12) -> None:
    """Assert equal poses up to rounding, yaws as angles."""
    assert one.distance_m(other.x_m, other.y_m) < tolerance
    assert abs(math.remainder(one.yaw_rad - other.yaw_rad, math.tau)) < tolerance


@given(poses, speeds, speeds, durations, durations)
def test_motions_compose(
    pose: Pose, linear_mps: float, angular_radps: float, first_s: float, second_s: float
) -> None:
    """Driving a while and then a while more is driving for both."""
    middle = integrate(pose, linear_mps, angular_radps, first_s)
    composed = integrate(middle, linear_mps, angular_radps, second_s)
    assert_same(composed, integrate(pose, linear_mps, angular_radps, first_s + second_s))


@given(poses, speeds, speeds, durations)
def test_time_reversed_is_velocity_reversed(
    pose: Pose, linear_mps: float, angular_radps: float, duration_s: float
) -> None:
    """Driving back with the opposite velocity returns to the start."""
    there = integrate(pose, linear_mps, angular_radps, duration_s)
    assert_same(integrate(there, -linear_mps, -angular_radps, duration_s), pose)


@given(poses, speeds, st.floats(0.05, 2.0), st.sampled_from([-1.0, 1.0]), durations)
def test_an_arc_stays_on_its_circle(
    pose: Pose, linear_mps: float, angular_radps: float, turn: float, duration_s: float
) -> None:
    """The end is the start turned about the centre, v/ω to the left, by ω·t."""
    angular_radps *= turn
    radius_m, angle_rad = linear_mps / angular_radps, angular_radps * duration_s
    centre_x = pose.x_m - radius_m * math.sin(pose.yaw_rad)
    centre_y = pose.y_m + radius_m * math.cos(pose.yaw_rad)
    yaw_rad = pose.yaw_rad + angle_rad
    expected = Pose(
        centre_x + radius_m * math.sin(yaw_rad), centre_y - radius_m * math.cos(yaw_rad), yaw_rad
    )
    assert_same(integrate(pose, linear_mps, angular_radps, duration_s), expected, 1e-11)


@given(poses, speeds, speeds)
def test_small_steps_tend_to_the_same_end(
    pose: Pose, linear_mps: float, angular_radps: float
) -> None:
    """Midpoint steps of 1 ms, made of the equations of motion alone, end at the same pose."""
    x_m, y_m, yaw_rad = pose.x_m, pose.y_m, pose.yaw_rad
    for _ in range(1000):
        heading_rad = yaw_rad + angular_radps * 5e-4
        x_m += linear_mps * 1e-3 * math.cos(heading_rad)
        y_m += linear_mps * 1e-3 * math.sin(heading_rad)
        yaw_rad += angular_radps * 1e-3
    assert_same(integrate(pose, linear_mps, angular_radps, 1.0), Pose(x_m, y_m, yaw_rad), 1e-6)


@given(poses, speeds, speeds, durations)
def test_the_yaw_is_in_its_range(
    pose: Pose, linear_mps: float, angular_radps: float, duration_s: float
) -> None:
    """Every yaw is in (-π, π]."""
    yaw_rad = integrate(pose, linear_mps, angular_radps, duration_s).yaw_rad
    assert -math.pi < yaw_rad <= math.pi
    assert yaw_rad == pytest.approx(math.remainder(yaw_rad, math.tau))
