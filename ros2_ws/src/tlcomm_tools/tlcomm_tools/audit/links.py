"""When the whole team was connected, from the agents' tracks alone.

``Interval``         a stretch of time
``link_intervals``   when two agents were in range of each other, and in sight if need be
``team_intervals``   when the graph of all agents was connected
``reaches_all``      whether a graph is connected
``WindowFinding``    one window's outcome
``judge_windows``    every window's outcome
"""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import combinations

import numpy as np
from numpy.typing import NDArray

from tlcomm_tools.audit.sight import Box, Ways, corner_passages_s, hidden
from tlcomm_tools.audit.tracks import Track

__all__ = [
    "Interval",
    "WindowFinding",
    "judge_windows",
    "link_intervals",
    "reaches_all",
    "team_intervals",
]

# Rounding of positions and times, far below anything physical.
_RANGE_SLACK_M = 1e-9
_TIME_SLACK_S = 1e-6

Interval = tuple[float, float]
"""From and to, in seconds."""


def link_intervals(
    one: Track, other: Track, range_m: float, walls: Sequence[Box] = ()
) -> list[Interval]:
    """Return when two agents were within range, exactly for piecewise linear tracks.

    Between two samples the squared distance is a quadratic in time, and so is what tells that a
    corner is in line with both; their roots and the samples bound stretches in each of which the
    middle decides.

    Args:
        one: an agent.
        other: another.
        range_m: R.
        walls: the obstacles that mustn't be between them.
    """
    reach_m = range_m + _RANGE_SLACK_M
    begin_s = max(one.times_s[0], other.times_s[0])
    end_s = min(one.times_s[-1], other.times_s[-1])
    times_s = np.union1d(one.times_s, other.times_s)
    times_s = times_s[(times_s >= begin_s) & (times_s <= end_s)]
    ways = Ways(times_s, one.at(times_s), other.at(times_s))
    bounds_s = np.union1d(times_s, _crossings(times_s, ways.one_m - ways.other_m, reach_m))
    bounds_s = np.union1d(bounds_s, corner_passages_s(ways, walls, reach_m))
    middles_s = (bounds_s[:-1] + bounds_s[1:]) / 2.0
    one_m, other_m = one.at(middles_s), other.at(middles_s)
    inside = np.hypot(*(one_m - other_m).T) <= reach_m
    inside[inside] = ~hidden(one_m[inside], other_m[inside], walls)
    changes = np.flatnonzero(np.diff(np.concatenate([[0], inside.astype(np.int8), [0]])))
    return [
        (float(bounds_s[start]), float(bounds_s[stop]))
        for start, stop in zip(changes[::2], changes[1::2], strict=True)
    ]


def _crossings(
    times_s: NDArray[np.float64], apart_m: NDArray[np.float64], reach_m: float
) -> NDArray[np.float64]:
    """Return the times at which |d + s·e| is the reach for an s in (0, 1) of some segment."""
    start_m, step_m = apart_m[:-1], np.diff(apart_m, axis=0)
    square = (step_m**2).sum(axis=1)
    half = (start_m * step_m).sum(axis=1)
    rest = (start_m**2).sum(axis=1) - reach_m**2
    discriminant = half**2 - square * rest
    moving = (square > 0.0) & (discriminant >= 0.0)
    root = np.sqrt(discriminant[moving])
    shares = np.stack([(-half[moving] - root), (-half[moving] + root)]) / square[moving]
    crossings_s = times_s[:-1][moving] + shares * np.diff(times_s)[moving]
    crossed: NDArray[np.float64] = crossings_s[(shares > 0.0) & (shares < 1.0)]
    return crossed


def team_intervals(
    tracks: Sequence[Track], range_m: float, walls: Sequence[Box] = ()
) -> list[Interval]:
    """Return when the graph of all agents was connected, past the walls.

    Cost: O(N²·S) for the links and O(N) per change of a link.
    """
    changes: list[tuple[float, bool, int, int]] = []
    for (i, one), (j, other) in combinations(enumerate(tracks), 2):
        for start_s, stop_s in link_intervals(one, other, range_m, walls):
            changes += [(start_s, True, i, j), (stop_s, False, i, j)]
    begin_s = max(track.times_s[0] for track in tracks)
    end_s = min(track.times_s[-1] for track in tracks)
    if len(tracks) == 1:
        return [(float(begin_s), float(end_s))]
    # Of changes at one instant a link's begin comes first: what takes over leaves no gap.
    changes.sort(key=lambda change: (change[0], not change[1]))
    return _connected(changes, len(tracks))


def _connected(changes: Sequence[tuple[float, bool, int, int]], agents: int) -> list[Interval]:
    neighbours = [0] * agents
    intervals: list[Interval] = []
    since_s: float | None = None
    for time_s, appears, i, j in changes:
        mask = (1 << j), (1 << i)
        for agent, bit in zip((i, j), mask, strict=True):
            neighbours[agent] = neighbours[agent] | bit if appears else neighbours[agent] & ~bit
        connected = reaches_all(neighbours)
        if connected and since_s is None:
            since_s = time_s
        elif not connected and since_s is not None:
            intervals.append((since_s, time_s))
            since_s = None
    return intervals


def reaches_all(neighbours: Sequence[int]) -> bool:
    """Return whether each node, given by a bit mask of its neighbours, reaches every other."""
    reached = frontier = min(1, len(neighbours))
    while frontier:
        agent = frontier.bit_length() - 1
        frontier &= ~(1 << agent)
        new = neighbours[agent] & ~reached
        reached |= new
        frontier |= new
    return reached == (1 << len(neighbours)) - 1


@dataclass(frozen=True, slots=True)
class WindowFinding:
    """A window's outcome.

    Attributes:
        round: r.
        longest_s: the longest connection from a time in [r·T_c, (r+1)·T_c) on.
        satisfied: whether that is D_c.
    """

    round: int
    longest_s: float
    satisfied: bool


def judge_windows(
    intervals: Sequence[Interval], period_s: float, duration_s: float, end_s: float
) -> list[WindowFinding]:
    """Return the outcome of every window that the run lasted to decide.

    Args:
        intervals: when the team was connected, ascending.
        period_s: T_c.
        duration_s: D_c.
        end_s: end of the run.
    """
    findings = []
    for number in range(int(end_s / period_s + _TIME_SLACK_S) + 1):
        opens_s, closes_s = number * period_s, (number + 1) * period_s
        inside = [
            (max(start_s, opens_s), stop_s)
            for start_s, stop_s in intervals
            if start_s < closes_s - _TIME_SLACK_S and stop_s > opens_s
        ]
        longest_s = max((stop_s - start_s for start_s, stop_s in inside), default=0.0)
        satisfied = longest_s >= duration_s - _TIME_SLACK_S
        undecided = closes_s > end_s + _TIME_SLACK_S or any(
            stop_s >= end_s - _TIME_SLACK_S for _, stop_s in inside
        )
        if satisfied or not undecided:
            findings.append(WindowFinding(number, longest_s, satisfied))
    return findings
