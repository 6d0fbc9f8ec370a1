"""Tests of ``tlcomm_tools.audit.links`` and ``tracks``: connections from poses alone."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from tlcomm_core.geometry import Pose
from tlcomm_core.world.observation import Odometry
from tlcomm_tools.audit.links import judge_windows, link_intervals, team_intervals
from tlcomm_tools.audit.tracks import Track, build_tracks


def track(*samples: tuple[float, float, float]) -> Track:
    """Return a track through (t, x, y)."""
    array = np.array(samples)
    return Track("agent", array[:, 0], array[:, 1:])


STILL = track((0.0, 0.0, 0.0), (10.0, 0.0, 0.0))


def test_a_pass_through_the_disc_is_found_between_samples() -> None:
    """Of a straight past an agent, the chord inside the range is found exactly."""
    passing = track((0.0, -5.0, 0.6), (10.0, 5.0, 0.6))
    ((start_s, stop_s),) = link_intervals(STILL, passing, 1.0)
    assert (start_s, stop_s) == pytest.approx((5.0 - 0.8, 5.0 + 0.8))


def test_touching_the_range_is_no_connection() -> None:
    """A straight that only touches the disc gives no interval worth a window."""
    passing = track((0.0, -5.0, 1.0), (10.0, 5.0, 1.0))
    assert sum(stop - start for start, stop in link_intervals(STILL, passing, 1.0)) < 1e-3


def test_the_whole_time_in_range_is_one_interval() -> None:
    """Samples don't split an interval."""
    near = track((0.0, 0.5, 0.0), (3.0, 0.0, 0.5), (10.0, 0.5, 0.0))
    assert link_intervals(STILL, near, 1.0) == [(0.0, 10.0)]


def test_exactly_at_range_is_in_range() -> None:
    """The range belongs to the disc."""
    assert link_intervals(STILL, track((0.0, 0.6, 0.8), (10.0, 0.6, 0.8)), 1.0) == [(0.0, 10.0)]


PILLAR = (0.4, -0.1, 0.6, 0.1)


def test_an_obstacle_between_ends_a_link() -> None:
    """Driving past a pillar, the straight is hidden exactly from corner to corner."""
    passing = track((0.0, 1.0, -1.0), (10.0, 1.0, 1.0))
    first, second = link_intervals(STILL, passing, 1.2, [PILLAR])
    assert (first[1], second[0]) == pytest.approx((3.75, 6.25), abs=1e-4)
    assert link_intervals(STILL, passing, 1.2) == [
        pytest.approx((first[0], second[1])),
    ]


def test_along_a_wall_there_is_sight() -> None:
    """Two at one wall see each other, and two at opposite walls of a pillar don't."""
    along = track((0.0, 1.0, 0.0), (10.0, 0.5, 0.0))
    assert link_intervals(STILL, along, 1.0, [(0.0, 0.0, 1.0, 1.0)]) == [(0.0, 10.0)]
    assert link_intervals(STILL, along, 1.0, [(0.1, -0.1, 0.4, 0.1)]) == []


def test_a_moving_pair_passes_an_obstacle() -> None:
    """Both drive, a metre apart in line abreast: each corner counts at its own time."""
    one, other = (
        track((0.0, 0.0, 0.0), (10.0, 10.0, 0.0)),
        track((0.0, 0.0, 1.0), (10.0, 10.0, 1.0)),
    )
    first, second = link_intervals(one, other, 1.0, [(4.0, 0.4, 6.0, 0.6)])
    assert (first, second) == (
        pytest.approx((0.0, 4.0), abs=1e-5),
        pytest.approx((6.0, 10.0), abs=1e-5),
    )


POINTS = st.tuples(st.floats(-2, 2), st.floats(-2, 2))


@given(st.lists(POINTS, min_size=2, max_size=6), st.lists(POINTS, min_size=2, max_size=6))
def test_intervals_agree_with_sampling(
    ones: list[tuple[float, float]], others: list[tuple[float, float]]
) -> None:
    """At any time not near a border, being in an interval is being in range."""
    one, other = (
        track(*((10.0 * i / (len(points) - 1), x, y) for i, (x, y) in enumerate(points)))
        for points in (ones, others)
    )
    found = link_intervals(one, other, 1.0)
    for time_s in np.linspace(0.01, 9.99, 57):
        apart_m = math.dist(one.at(np.array([time_s]))[0], other.at(np.array([time_s]))[0])
        if abs(apart_m - 1.0) > 1e-6:
            assert any(a <= time_s <= b for a, b in found) is (apart_m < 1.0)


def test_a_chain_connects_the_team() -> None:
    """The team is connected while each is linked to some other, all in one piece."""
    middle = track((0.0, 0.9, 0.0), (10.0, 0.9, 0.0))
    leaving = track((0.0, 1.8, 0.0), (5.0, 1.8, 0.0), (7.0, 3.8, 0.0), (10.0, 3.8, 0.0))
    ((start_s, stop_s),) = team_intervals([STILL, middle, leaving], 1.0)
    assert (start_s, stop_s) == pytest.approx((0.0, 5.1))


def test_two_pairs_are_no_team() -> None:
    """Everyone having a neighbour isn't enough."""
    places = [0.0, 0.5, 3.0, 3.5]
    assert team_intervals([track((0.0, x, 0.0), (9.0, x, 0.0)) for x in places], 1.0) == []


def test_one_link_taking_over_from_another_keeps_the_team() -> None:
    """An agent that leaves one range at the instant at which it enters another stays connected."""
    chain = [(0.0, 0.0), (0.0, 1.0), (0.5, 1.8), (1.5, 1.8), (2.0, 1.0), (2.0, 0.0)]
    tracks = [track((0.0, x, y), (8.0, x, y)) for x, y in chain]
    moving = track((0.0, -1.0, 0.0), (8.0, 3.0, 0.0))
    assert team_intervals([*tracks, moving], 1.0) == [(0.0, 8.0)]


def test_a_single_agent_is_a_team() -> None:
    """One agent is always connected."""
    assert team_intervals([STILL], 1.0) == [(0.0, 10.0)]


def test_windows_are_judged_from_their_begin() -> None:
    """A window is kept by D_c from a time in it, across its end too; an open one isn't judged."""
    found = judge_windows([(0.0, 2.0), (19.0, 21.5)], 10.0, 2.0, 25.0)
    assert [(own.round, own.longest_s, own.satisfied) for own in found] == [
        (0, 2.0, True),
        (1, 2.5, True),
    ]
    assert [own.satisfied for own in judge_windows([(0.0, 2.0)], 10.0, 2.0, 20.0)] == [True, False]


def test_a_connection_cut_by_the_end_is_not_judged() -> None:
    """What the run didn't last to decide is left out."""
    assert judge_windows([(9.0, 10.5)], 10.0, 2.0, 10.5) == []


def odometry(time_s: float, x_m: float, speed_mps: float = 0.0, yaw_rad: float = 0.0) -> Odometry:
    """Return a sample."""
    return Odometry(round(time_s * 1e9), "one", Pose(x_m, 0.0, yaw_rad), speed_mps, 0.0)


def test_the_last_sample_is_carried_on() -> None:
    """After the last sample the agent goes on with the velocity it had."""
    ((one,), faults) = build_tracks([odometry(0.0, 0.0, 1.0, math.pi)], ["one"], 1.5)
    assert faults == []
    assert one.at(np.array([1.0]))[0] == pytest.approx([-1.0, 0.0])


def test_of_samples_at_one_time_the_last_holds() -> None:
    """A second sample of the same time replaces the first."""
    ((one,), _) = build_tracks([odometry(0.0, 3.0), odometry(0.0, 4.0)], ["one"], 1.0)
    assert one.positions_m[0, 0] == 4.0


def test_gaps_are_faults() -> None:
    """Odometry missing for more than two seconds, at the begin too, is told with its times."""
    samples = [odometry(2.5, 0.0), odometry(3.0, 0.0), odometry(6.0, 0.0)]
    _, faults = build_tracks(samples, ["one", "two"], 7.0)
    assert faults == [
        "two: no odometry",
        "one: no odometry from 0.000 s to 2.500 s",
        "one: no odometry from 3.000 s to 6.000 s",
    ]
