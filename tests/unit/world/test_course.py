"""Reading a body's course."""

import pytest

from tlcomm_core.geometry import Pose
from tlcomm_core.world.course import Course

HALF_SECOND_NS = 500_000_000


def test_the_pose_is_counted_from_the_anchor() -> None:
    """Half a second after the anchor at 1 m/s is half a metre on."""
    course = Course(2 * HALF_SECOND_NS, Pose(1.0, 1.0, 0.0), 1.0)
    assert course.pose_at(2 * HALF_SECOND_NS) == Pose(1.0, 1.0, 0.0)
    assert course.pose_at(3 * HALF_SECOND_NS) == Pose(1.5, 1.0, 0.0)


@pytest.mark.parametrize(
    ("linear_mps", "angular_radps", "moving", "curved"),
    [
        (0.0, 0.0, False, False),
        (1.0, 0.0, True, False),
        (0.0, 1.0, True, False),
        (-1.0, 0.1, True, True),
    ],
)
def test_the_kind_of_motion(
    linear_mps: float, angular_radps: float, moving: bool, curved: bool
) -> None:
    """Only v and ω together make an arc; either makes it move."""
    course = Course(0, Pose(0.0, 0.0, 0.0), linear_mps, angular_radps)
    assert (course.moving, course.curved) == (moving, curved)
