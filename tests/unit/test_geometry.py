"""Poses and angles."""

import math

import pytest

from tlcomm_core.geometry import Pose, quaternion_from_yaw, wrap_angle, yaw_from_quaternion


@pytest.mark.parametrize(
    ("angle_rad", "wrapped_rad"),
    [
        (0.0, 0.0),
        (math.pi, math.pi),
        (-math.pi, math.pi),
        (3 * math.pi, math.pi),
        (-math.pi / 2, -math.pi / 2),
        (1.5 * math.pi, -math.pi / 2),
    ],
)
def test_angles_wrap_into_the_half_open_turn(angle_rad: float, wrapped_rad: float) -> None:
    """The result is in (-π, π]."""
    assert wrap_angle(angle_rad) == pytest.approx(wrapped_rad, abs=1e-12)
    assert -math.pi < wrap_angle(angle_rad) <= math.pi


@pytest.mark.parametrize("yaw_rad", [0.0, 0.3, math.pi / 2, -3.0, math.pi])
def test_a_yaw_survives_its_quaternion(yaw_rad: float) -> None:
    """Also scaled, as a quaternion from elsewhere may be."""
    z, w = quaternion_from_yaw(yaw_rad)
    assert yaw_from_quaternion(z, w) == pytest.approx(yaw_rad, abs=1e-15)
    assert yaw_from_quaternion(2.0 * z, 2.0 * w) == pytest.approx(yaw_rad, abs=1e-15)


def test_a_pose_as_transmitted_is_what_a_receiver_reads() -> None:
    """The yaw has the very bits that a receiver computes from the quaternion sent."""
    yaws_rad = [wrap_angle(0.0317 * step) for step in range(200)]
    sent = [Pose(1.0, 2.0, yaw_rad).as_transmitted() for yaw_rad in yaws_rad]
    read_rad = [yaw_from_quaternion(*quaternion_from_yaw(yaw_rad)) for yaw_rad in yaws_rad]
    assert [pose.yaw_rad for pose in sent] == read_rad
    assert read_rad != yaws_rad
    assert read_rad == pytest.approx(yaws_rad, abs=1e-14)


def test_distance_is_euclidean() -> None:
    """The hypotenuse of 3 and 4 is 5."""
    assert Pose(1.0, 1.0, 2.0).distance_m(4.0, 5.0) == pytest.approx(5.0)
