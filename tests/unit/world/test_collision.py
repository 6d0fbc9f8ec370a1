"""Contacts of points with boxes and the border."""

import math

import pytest

from tlcomm_core.geometry import Pose
from tlcomm_core.workspace.grid import Grid
from tlcomm_core.world.collision import Obstacles
from tlcomm_core.world.course import Course

OBSTACLES = Obstacles(Grid((10.0, 10.0), 0.5, [(3.0, 3.0, 4.0, 5.0), (4.0, 3.0, 6.0, 4.0)]))
UNTIL_NS = 500_000_000


def contact_ns(pose: Pose, linear_mps: float, angular_radps: float = 0.0) -> int | None:
    """Return the contact of a course from a pose at t = 0."""
    return OBSTACLES.contact_ns(Course(0, pose, linear_mps, angular_radps), 0, UNTIL_NS)


@pytest.mark.parametrize(
    ("pose", "linear_mps", "seconds"),
    [
        (Pose(1.0, 4.0, 0.0), 1.0, 2.0),
        (Pose(1.0, 4.0, 0.0), 0.25, 8.0),
        (Pose(8.0, 3.5, math.pi), 1.0, 2.0),
        (Pose(8.0, 3.5, 0.0), -1.0, 2.0),
        (Pose(2.0, 2.0, math.pi / 4), 1.0, math.sqrt(2.0)),
        (Pose(9.0, 9.0, 0.0), 1.0, 1.0),
        (Pose(9.0, 9.0, math.pi / 2), 1.0, 1.0),
        (Pose(1.0, 1.0, math.pi), 0.5, 2.0),
        (Pose(1.0, 1.0, -math.pi / 2), 0.5, 2.0),
    ],
)
def test_a_straight_meets_a_box_or_the_border_in_time(
    pose: Pose, linear_mps: float, seconds: float
) -> None:
    """The contact is at most a few nanoseconds before the edge is reached, never after."""
    found_ns = contact_ns(pose, linear_mps)
    assert found_ns is not None
    assert 0.0 <= seconds * 1e9 - found_ns <= 10.0


@pytest.mark.parametrize("offset_m", [0.0, 1e-15, 1e-9, 1e-3])
def test_driving_along_an_edge_meets_only_the_border(offset_m: float) -> None:
    """Beside the boxes, even at no distance at all, the way is free up to the border."""
    found_ns = contact_ns(Pose(3.0 - offset_m, 1.0, math.pi / 2), 1.0)
    assert found_ns is not None
    assert 0.0 <= 9e9 - found_ns <= 10.0


@pytest.mark.parametrize("angular_radps", [0.0, 0.8, -0.8])
def test_at_a_wall_only_the_way_into_it_is_closed(angular_radps: float) -> None:
    """A point on the edge stops at once if it drives into the box, and may back away."""
    at_wall = Pose(3.0 - 1e-9, 4.0, 0.0)
    assert contact_ns(at_wall, 1.0, angular_radps) == pytest.approx(0, abs=5)
    away_ns = contact_ns(at_wall, -1.0, angular_radps)
    assert away_ns is None or away_ns > UNTIL_NS


def test_turning_on_the_spot_meets_nothing() -> None:
    """At v = 0 there is no contact, wherever it stands."""
    assert contact_ns(Pose(3.0, 4.0, 0.0), 0.0, 1.0) is None


@pytest.mark.parametrize("angular_radps", [0.5, -1.5, 1e-6])
def test_an_arc_stops_right_before_the_edge(angular_radps: float) -> None:
    """At the contact the point is outside by a nanometre at most per nanosecond and skin."""
    course = Course(0, Pose(2.7, 4.0, 0.0), 1.0, angular_radps)
    found_ns = OBSTACLES.contact_ns(course, 0, UNTIL_NS)
    assert found_ns is not None
    assert 0.0 <= 3.0 - course.pose_at(found_ns).x_m < 3e-9


def test_an_arc_beside_a_box_meets_nothing() -> None:
    """A circle that fits between box and border goes on for ever."""
    assert contact_ns(Pose(1.5, 1.0, 0.0), 1.0, 1.5) is None


def test_an_arc_is_followed_as_far_as_asked() -> None:
    """A contact after ``until_ns`` isn't reported, and is found from there."""
    course = Course(0, Pose(2.3, 4.0, 0.0), 1.0, 0.1)
    assert OBSTACLES.contact_ns(course, 0, UNTIL_NS) is None
    found_ns = OBSTACLES.contact_ns(course, UNTIL_NS, 2 * UNTIL_NS)
    assert found_ns is not None
    assert 0.0 <= 3.0 - course.pose_at(found_ns).x_m < 3e-9


def test_an_arc_into_a_corner_stops_at_the_nearer_wall() -> None:
    """Where a sample lies in two boxes the earlier contact counts."""
    obstacles = Obstacles(Grid((9.0, 9.0), 1.0, [(3.0, 0.0, 9.0, 9.0), (3.005, 0.0, 9.0, 9.0)]))
    course = Course(0, Pose(2.8999, 4.0, 0.0), 1.0, 0.1)
    found_ns = obstacles.contact_ns(course, 0, UNTIL_NS)
    assert found_ns is not None
    assert 0.0 <= 3.0 - course.pose_at(found_ns).x_m < 3e-9


def test_edges_are_not_inside() -> None:
    """A point in a box or beyond the border is contained, one on an edge isn't."""
    assert OBSTACLES.contain(3.5, 4.0)
    assert OBSTACLES.contain(-0.1, 4.0)
    assert not OBSTACLES.contain(3.0, 4.0)
    assert not OBSTACLES.contain(0.0, 10.0)
    assert not OBSTACLES.contain(4.5, 4.5)
