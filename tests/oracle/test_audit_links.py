"""The audit's own account of links against the world's."""

from itertools import combinations, pairwise

import pytest

from support.random_world import PILLARS, played, random_commands, random_pillars
from tlcomm_core.world.observation import Connectivity, Observation, Odometry
from tlcomm_tools.audit.links import link_intervals
from tlcomm_tools.audit.tracks import build_tracks

COUNT = 5
RANGE_M = 3.0
NAMES = tuple(f"agent_{index}" for index in range(COUNT))


def linked_s(seen: list[Observation], pair: tuple[int, int], end_s: float) -> float:
    """Return how long the world says that a pair is linked."""
    links = [one for one in seen if isinstance(one, Connectivity)]
    states = [(one.stamp_ns * 1e-9, pair in one.edges) for one in links]
    return sum(after_s - at_s for (at_s, on), (after_s, _) in pairwise([*states, (end_s, 0)]) if on)


@pytest.mark.parametrize("seed", range(8))
def test_the_audit_sees_what_the_world_sees(seed: int) -> None:
    """Among pillars, each pair is in range and in sight as long by its tracks as by the world."""
    commands = list(random_commands(seed, COUNT, 30, arcs=False))
    seen = played(random_pillars(seed, COUNT), commands)
    end_s = commands[-1].time_ns * 1e-9
    odometry = [one for one in seen if isinstance(one, Odometry)]
    tracks, faults = build_tracks(odometry, NAMES, end_s)
    assert faults == []
    for i, j in combinations(range(COUNT), 2):
        found = link_intervals(tracks[i], tracks[j], RANGE_M, PILLARS)
        total_s = sum(stop_s - start_s for start_s, stop_s in found)
        assert total_s == pytest.approx(linked_s(seen, (i, j), end_s), abs=1e-3)
