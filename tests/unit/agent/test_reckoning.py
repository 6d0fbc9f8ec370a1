"""Where an agent is between two odometries."""

import math

import pytest

from tlcomm_core.agent.events import OdometryReceived
from tlcomm_core.agent.reckoning import DeadReckoning
from tlcomm_core.errors import LocalMisuseError
from tlcomm_core.geometry import Pose


def test_it_drives_on_from_the_last_odometry() -> None:
    """With the velocity that it tells, to the time that is asked for."""
    reckoning = DeadReckoning()
    reckoning.take(OdometryReceived(1.0, Pose(0.0, 0.0, 0.0), 1.0, 0.0))
    reckoning.take(OdometryReceived(2.0, Pose(1.0, 0.0, math.pi / 2.0), 0.5, 0.0))
    pose = reckoning.pose_at(4.0)
    assert (pose.x_m, pose.y_m) == pytest.approx((1.0, 1.0))


def test_a_clock_that_is_behind_changes_nothing() -> None:
    """An odometry from a moment ahead is the pose now."""
    reckoning = DeadReckoning()
    reckoning.take(OdometryReceived(2.0, Pose(1.0, 0.0, 0.0), 1.0, 0.0))
    assert reckoning.pose_at(1.9) == Pose(1.0, 0.0, 0.0)


def test_without_odometry_it_knows_nothing() -> None:
    """To ask then is a bug."""
    with pytest.raises(LocalMisuseError, match="first odometry"):
        DeadReckoning().pose_at(0.0)
