"""Link changes of a whole world against dense sampling of its poses."""

from bisect import bisect_right

import numpy as np
import pytest

from support.random_world import (
    PILLARS,
    SIZE_M,
    Command,
    played,
    random_commands,
    random_pillars,
    random_world,
)
from tlcomm_core.workspace.grid import Grid
from tlcomm_core.workspace.sight import sightlines
from tlcomm_core.world.observation import Connectivity, Observation, Odometry
from tlcomm_core.world.radio import links
from tlcomm_core.world.unicycle import integrate

COUNT = 5
RANGE_M = 1.5
SAMPLE_NS = 1_000_000
# Crossings that are shorter than the world's sampling of arcs may be missing, with depths below.
SLACK_M = {False: 1e-8, True: 2e-4}
SIGHT_SLACK_M = {False: 1e-8, True: 2e-4}
SIGHT_RANGE_M = 3.0
SIGHT_SEEDS = range(4)
GRID = Grid((SIZE_M, SIZE_M), 0.5, PILLARS)


def places_m(seen: list[Observation], times_ns: list[int]) -> np.ndarray:
    """Return all positions at times, float[T, N, 2], from the odometry alone."""
    found = np.empty((len(times_ns), COUNT, 2))
    for index in range(COUNT):
        own = [one for one in seen if isinstance(one, Odometry) and one.agent == f"agent_{index}"]
        stamps = [one.stamp_ns for one in own]
        for row, time_ns in enumerate(times_ns):
            last = own[bisect_right(stamps, time_ns) - 1]
            duration_s = (time_ns - last.stamp_ns) * 1e-9
            pose = integrate(last.pose, last.linear_mps, last.angular_radps, duration_s)
            found[row, index] = pose.x_m, pose.y_m
    return found


def edges_at(seen: list[Observation], times_ns: list[int]) -> list[set[tuple[int, int]]]:
    """Return the links that the connectivity messages claim."""
    messages = [one for one in seen if isinstance(one, Connectivity)]
    stamps = [one.stamp_ns for one in messages]
    return [set(messages[bisect_right(stamps, time_ns) - 1].edges) for time_ns in times_ns]


@pytest.mark.parametrize("arcs", [False, True])
@pytest.mark.parametrize("seed", range(6))
def test_links_are_right_at_every_millisecond(seed: int, arcs: bool) -> None:
    """At each sample exactly the pairs within range are linked, but for grazing by a hair."""
    commands: list[Command] = list(random_commands(seed, COUNT, 25, arcs=arcs))
    seen = played(random_world(seed, COUNT), commands)
    times_ns = list(range(0, commands[-1].time_ns, SAMPLE_NS))
    places = places_m(seen, times_ns)
    claimed = edges_at(seen, times_ns)
    for place_m, edges in zip(places, claimed, strict=True):
        assert set(links(place_m, RANGE_M - SLACK_M[arcs])) <= edges
        assert edges <= set(links(place_m, RANGE_M + SLACK_M[arcs]))


def pairs_in_sight(place_m: np.ndarray, slack_m: float) -> set[tuple[int, int]]:
    """Return the pairs within range and in sight; fewer with a negative slack, or more."""
    near = np.array(links(place_m, SIGHT_RANGE_M + slack_m), dtype=int).reshape(-1, 2)
    seen = sightlines(GRID, place_m[near[:, 0]], place_m[near[:, 1]], -slack_m)
    return {(i, j) for i, j in near[seen].tolist()}


@pytest.mark.parametrize("arcs", [False, True])
@pytest.mark.parametrize("seed", SIGHT_SEEDS)
def test_links_in_sight_are_right_at_every_millisecond(seed: int, arcs: bool) -> None:
    """Among pillars exactly the pairs within range and in sight are linked."""
    commands: list[Command] = list(random_commands(seed, COUNT, 25, arcs=arcs))
    seen = played(random_pillars(seed, COUNT), commands)
    times_ns = list(range(0, commands[-1].time_ns, SAMPLE_NS))
    places = places_m(seen, times_ns)
    claimed = edges_at(seen, times_ns)
    for place_m, edges in zip(places, claimed, strict=True):
        assert pairs_in_sight(place_m, -SIGHT_SLACK_M[arcs]) <= edges
        assert edges <= pairs_in_sight(place_m, SIGHT_SLACK_M[arcs])


def test_the_pillars_hide_agents() -> None:
    """Over the seeds pairs within range are hidden, and links come and go: it isn't vacuous."""
    hidden, edge_sets = 0, set()
    for seed in SIGHT_SEEDS:
        commands = list(random_commands(seed, COUNT, 25, arcs=False))
        seen = played(random_pillars(seed, COUNT), commands)
        stamps = [one.stamp_ns for one in seen if isinstance(one, Connectivity)]
        for place_m, edges in zip(places_m(seen, stamps), edges_at(seen, stamps), strict=True):
            hidden += len(set(links(place_m, SIGHT_RANGE_M - 1e-6)) - edges)
            edge_sets.add(frozenset(edges))
    assert hidden > 10
    assert len(edge_sets) > 10


@pytest.mark.parametrize("arcs", [False, True])
def test_a_change_shows_when_told_and_not_before(arcs: bool) -> None:
    """At a change's time the poses show it; 2 ns before they don't."""
    changes = 0
    for seed in range(10):
        commands = list(random_commands(seed, COUNT, 40, arcs=arcs))
        seen = played(random_world(seed, COUNT), commands)
        stamps = [one.stamp_ns for one in seen if isinstance(one, Connectivity)][1:]
        before = edges_at(seen, [stamp_ns - 1 for stamp_ns in stamps])
        after = edges_at(seen, stamps)
        now, earlier = (places_m(seen, [at - gap for at in stamps]) for gap in (0, 2))
        for row, (old, new) in enumerate(zip(before, after, strict=True)):
            for pair in old ^ new:
                distance_m = np.linalg.norm(now[row, pair[0]] - now[row, pair[1]])
                before_m = np.linalg.norm(earlier[row, pair[0]] - earlier[row, pair[1]])
                sign = 1.0 if pair in new else -1.0
                assert sign * (RANGE_M - distance_m) >= -1e-14
                assert sign * (before_m - RANGE_M) >= -1e-14
                changes += 1
    assert changes >= 20
