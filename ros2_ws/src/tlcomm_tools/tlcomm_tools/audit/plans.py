"""Whether the meetings that agents agree on can be held: connected, in their windows, in time.

``audit_plans``  what is wrong with them
"""

import math
from bisect import bisect_right
from collections.abc import Iterator, Sequence
from itertools import combinations
from typing import Final

import numpy as np

from tlcomm_core.agent.actions import TaskEventKind
from tlcomm_core.game.strategy import Strategy, TeamStrategy
from tlcomm_tools.audit.clearance import obstacles_of
from tlcomm_tools.audit.evidence import Evidence
from tlcomm_tools.audit.links import reaches_all
from tlcomm_tools.audit.sight import Box, hidden

__all__ = ["audit_plans"]

_SLACK_S: Final = 1e-6
_SLACK_M: Final = 1e-6
_BEGINNINGS: Final = (TaskEventKind.MEETING_REACHED, TaskEventKind.MEETING_STARTED)


def audit_plans(evidence: Evidence) -> Iterator[str]:
    """Say which agreed meetings aren't connected, in their windows, or to be had at their cost."""
    begins_ns = {agent: _begins_ns(evidence, agent) for agent in evidence.agents}
    first_ns: dict[TeamStrategy, int] = {}
    for record in evidence.records.strategies:
        first_ns.setdefault(record.strategy, record.stamp_ns)
    for held, agreed_ns in first_ns.items():
        yield from _untimely(held, evidence.scenario.communication.period_s)
        yield from _implausible(held)
        yield from _apart(held, evidence, agreed_ns * 1e-9)
        yield from _closed(held, evidence, agreed_ns * 1e-9)
        for own in held.strategies:
            earlier_ns = begins_ns.get(own.agent, [])
            before = bisect_right(earlier_ns, agreed_ns)
            begin_s = earlier_ns[before - 1] * 1e-9 if before else 0.0
            yield from _too_soon(held.round, own, evidence, begin_s)


def _untimely(held: TeamStrategy, period_s: float) -> Iterator[str]:
    """Say if t_c isn't in [r·T_c, (r+1)·T_c)."""
    opens_s, closes_s = held.round * period_s, (held.round + 1) * period_s
    if not opens_s - _SLACK_S <= held.communication_s < closes_s:
        yield (
            f"round {held.round}: t_c is {held.communication_s:.3f} s, not in its window "
            f"[{opens_s:g} s, {closes_s:g} s)"
        )


def _implausible(held: TeamStrategy) -> Iterator[str]:
    """Say which costs can't be: a detour that saves time, or a game that lost."""
    for own in held.strategies:
        if own.extra_travel_s < -_SLACK_S:
            yield f"round {held.round}: {own.agent}'s δ is {own.extra_travel_s:.6f} s, less than 0"
    if held.potential_s > held.initial_potential_s + _SLACK_S:
        yield (
            f"round {held.round}: Φ is {held.potential_s:.6f} s, more than at first, "
            f"{held.initial_potential_s:.6f} s"
        )
    if held.bound_s is not None and held.potential_s < held.bound_s - _SLACK_S:
        yield (
            f"round {held.round}: Φ is {held.potential_s:.6f} s, less than its bound, "
            f"{held.bound_s:.6f} s"
        )


def _apart(held: TeamStrategy, evidence: Evidence, agreed_s: float) -> Iterator[str]:
    """Say if the places aren't connected by the range that places are planned with."""
    scenario = evidence.scenario
    reach_m = scenario.communication.range_m - 2.0 * scenario.position_tolerance_m
    walls = _known_maps(evidence, agreed_s) if scenario.radio.line_of_sight else ()
    neighbours = [0] * len(held.strategies)
    for (i, one), (j, other) in combinations(enumerate(held.strategies), 2):
        apart_m = math.dist((one.x_m, one.y_m), (other.x_m, other.y_m))
        if apart_m <= reach_m + _SLACK_M and not _is_hidden(one, other, walls):
            neighbours[i] |= 1 << j
            neighbours[j] |= 1 << i
    if not reaches_all(neighbours):
        yield f"round {held.round}: its places aren't connected by links of {reach_m:g} m"


def _is_hidden(one: Strategy, other: Strategy, walls: Sequence[Sequence[Box]]) -> bool:
    """Tell whether two places are out of sight on every map; on no map none is."""
    from_m, to_m = (np.array([(own.x_m, own.y_m)]) for own in (one, other))
    return bool(walls) and all(bool(hidden(from_m, to_m, boxes)[0]) for boxes in walls)


def _closed(held: TeamStrategy, evidence: Evidence, agreed_s: float) -> Iterator[str]:
    """Say which places are in an obstacle, whichever map they were chosen on."""
    maps = _known_maps(evidence, agreed_s)
    for own in held.strategies:
        if all(_is_in_any(own, boxes) for boxes in maps):
            yield (
                f"round {held.round}: {own.agent} is to meet in an obstacle, "
                f"at ({own.x_m:.3f}, {own.y_m:.3f}) m"
            )


def _is_in_any(own: Strategy, boxes: Sequence[Box]) -> bool:
    return any(
        x_min + _SLACK_M < own.x_m < x_max - _SLACK_M
        and y_min + _SLACK_M < own.y_m < y_max - _SLACK_M
        for x_min, y_min, x_max, y_max in boxes
    )


def _known_maps(evidence: Evidence, agreed_s: float) -> tuple[tuple[Box, ...], ...]:
    """Return the obstacles of all maps that a round may have been planned on."""
    maps = obstacles_of(evidence.scenario.workspace)
    return tuple(boxes for at_s, boxes in maps if at_s <= agreed_s)


def _begins_ns(evidence: Evidence, agent: str) -> list[int]:
    """Return when meetings began for an agent, ascending."""
    events = evidence.events_of(agent)
    return [record.stamp_ns for record in events if record.event.kind in _BEGINNINGS]


def _too_soon(number: int, own: Strategy, evidence: Evidence, begins_s: float) -> Iterator[str]:
    """Say if an agent is to arrive before it can, straight from the meeting where it agreed."""
    track = evidence.track_of.get(own.agent)
    if track is None or own.agent not in evidence.scenario.agents:
        return
    way_m = math.dist(track.at(np.array([begins_s]))[0], (own.x_m, own.y_m))
    earliest_s = begins_s + way_m / evidence.scenario.drive_of(own.agent).linear_mps
    if own.arrival_s < earliest_s - _SLACK_S:
        yield (
            f"round {number}: {own.agent} is to arrive at {own.arrival_s:.3f} s, but the "
            f"{way_m:.3f} m from its last meeting take it until {earliest_s:.3f} s"
        )
