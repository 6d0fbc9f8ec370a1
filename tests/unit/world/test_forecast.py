"""Link changes foretold from constant velocities."""

import math

import numpy as np
import pytest

from tlcomm_core.geometry import Pose
from tlcomm_core.world.course import Course
from tlcomm_core.world.forecast import Forecast
from tlcomm_core.world.reach import Reach

SECOND_NS = 1_000_000_000
FAR_NS = 3600 * SECOND_NS
ORIGIN = Course(0, Pose(0.0, 0.0, 0.0))


def forecast(*courses: Course, linked: bool, from_ns: int = 0) -> Forecast:
    """Look ahead for two bodies, R = 1 m."""
    return Forecast(courses, np.array([linked]), Reach(1.0), from_ns)


def test_driving_apart_ends_a_link() -> None:
    """From 0.5 m at 0.25 m/s the range of 1 m is left right after 2 s."""
    leaving = Course(0, Pose(0.5, 0.0, 0.0), 0.25)
    change = forecast(ORIGIN, leaving, linked=True).until(FAR_NS)
    assert change is not None
    assert change.time_ns == 2 * SECOND_NS + 1
    assert change.linked.tolist() == [False]


def test_driving_closer_makes_a_link() -> None:
    """From 3 m, closing at 2 m/s, a range of 1 m is entered at 1 s exactly."""
    others = Course(0, Pose(3.0, 0.0, math.pi), 1.0), Course(0, Pose(0.0, 0.0, 0.0), 1.0)
    change = forecast(*others, linked=False).until(FAR_NS)
    assert change is not None
    assert change.time_ns == SECOND_NS
    assert change.linked.tolist() == [True]


def test_a_change_beyond_the_limit_is_kept_for_later() -> None:
    """It isn't told before the limit reaches it."""
    coming = forecast(ORIGIN, Course(0, Pose(3.0, 0.0, math.pi), 1.0), linked=False)
    assert coming.until(2 * SECOND_NS - 1) is None
    change = coming.until(2 * SECOND_NS)
    assert change is not None
    assert change.time_ns == 2 * SECOND_NS


@pytest.mark.parametrize(
    "other",
    [
        Course(0, Pose(1.0, 0.0, 0.0)),
        Course(0, Pose(1.0, 0.0, 0.0), 0.0, 1.5),
        Course(0, Pose(3.0, 0.0, 0.0), 1.0),
    ],
)
def test_nothing_is_foretold_where_nothing_changes(other: Course) -> None:
    """At rest or turning exactly R apart, or driving away from beyond: no change, no loop."""
    linked = other.anchor.x_m <= 1.0
    assert forecast(ORIGIN, other, linked=linked).until(FAR_NS) is None


def test_driving_abreast_exactly_at_range_keeps_the_link() -> None:
    """Two that keep their distance R while driving stay linked."""
    abreast = Course(0, Pose(0.0, 0.0, 0.0), 1.0), Course(0, Pose(0.0, 1.0, 0.0), 1.0)
    assert forecast(*abreast, linked=True).until(FAR_NS) is None


def test_circling_exactly_at_range_ends() -> None:
    """A circle of radius R around another agent: whatever rounding shows, each answer ends."""
    circling = Course(0, Pose(1.0, 0.0, math.pi / 2), 1.0, 1.0)
    linked, from_ns, changes = True, 0, 0
    while from_ns < SECOND_NS:
        change = forecast(ORIGIN, circling, linked=linked, from_ns=from_ns).until(SECOND_NS)
        if change is None:
            break
        assert change.time_ns > from_ns
        linked, from_ns = bool(change.linked[0]), change.time_ns
        changes += 1
    assert changes < 60


def test_a_grazing_pass_is_no_change_or_a_short_one() -> None:
    """Passing at distance R exactly touches the range in one point."""
    passing = Course(0, Pose(-2.0, 1.0, 0.0), 1.0)
    assert forecast(ORIGIN, passing, linked=False).until(FAR_NS) is None
    closer = Course(0, Pose(-2.0, 1.0 - 1e-12, 0.0), 1.0)
    change = forecast(ORIGIN, closer, linked=False).until(FAR_NS)
    assert change is not None
    assert change.time_ns == pytest.approx(2 * SECOND_NS, abs=2e3)


def test_a_wrong_belief_is_mended_at_once() -> None:
    """If the links are others than thought at the start, that is the next change."""
    change = forecast(ORIGIN, Course(7, Pose(0.5, 0.0, 0.0)), linked=False, from_ns=7).until(7)
    assert change is not None
    assert (change.time_ns, change.linked.tolist()) == (7, [True])


def test_an_arc_leaves_the_range_when_its_chord_says() -> None:
    """From the centre along a circle of radius 1 m, R = 1 m is passed at an angle of 60°."""
    leaving = Course(0, Pose(0.0, 0.0, 0.3), 1.0, 1.0)
    change = forecast(ORIGIN, leaving, linked=True).until(FAR_NS)
    assert change is not None
    assert change.time_ns == pytest.approx(math.pi / 3 * 1e9, abs=2)


@pytest.mark.parametrize(("speed_mps", "seconds", "left"), [(0.5, math.pi / 3, 0), (2.0, 0.5, 5)])
def test_of_an_arc_and_a_straight_the_earlier_counts(
    speed_mps: float, seconds: float, left: int
) -> None:
    """Pairs with and without arcs are looked at together, in order of time."""
    arc = Course(0, Pose(0.0, 0.0, 0.3), 1.0, 1.0)
    far = Course(0, Pose(9.0, 0.0, 0.0))
    straight = Course(0, Pose(9.0, 0.0, -2.5), speed_mps)
    linked = np.array([True, False, False, False, False, True])
    change = Forecast((ORIGIN, arc, far, straight), linked, Reach(1.0), 0).until(FAR_NS)
    assert change is not None
    assert change.time_ns == pytest.approx(seconds * 1e9, abs=2)
    assert np.flatnonzero(change.linked != linked).tolist() == [left]
