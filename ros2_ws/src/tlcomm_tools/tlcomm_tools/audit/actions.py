"""Whether actions were done in the regions that they claim, and for as long as they take.

``audit_actions``  which were not
"""

import math
from collections.abc import Iterator, Sequence
from typing import Final

import numpy as np

from tlcomm_core.agent.actions import TaskEventKind
from tlcomm_core.records import TaskRecord
from tlcomm_core.scenario.model import Region, Scenario
from tlcomm_tools.audit.tracks import Track

__all__ = ["audit_actions"]

# An agent stands at a cell's centre to within its position tolerance; floating point beyond that.
_PLACE_SLACK_M: Final = 1e-6
_TIME_SLACK_S: Final = 1e-6
_PLACED: Final = (
    TaskEventKind.ACTION_STARTED,
    TaskEventKind.ACTION_FINISHED,
    TaskEventKind.REGION_VISITED,
)


def audit_actions(
    scenario: Scenario, agent: str, events: Sequence[TaskRecord], track: Track | None
) -> Iterator[str]:
    """Say which actions an agent didn't do where, and for as long as, it should have.

    Args:
        scenario: regions and durations.
        agent: whose.
        events: its own, in order of time.
        track: where it was, if that is known.
    """
    if track is not None:
        yield from _misplaced(scenario, events, track)
        yield from _left(scenario, events, track)
    yield from _hasty(scenario, agent, events)


def _misplaced(scenario: Scenario, events: Sequence[TaskRecord], track: Track) -> Iterator[str]:
    """Say which actions and visits were not in the regions that they claim."""
    placed = [own for own in events if own.event.kind in _PLACED and own.event.region]
    places_m = track.at(np.array([own.stamp_ns for own in placed]) * 1e-9).tolist()
    for record, place_m in zip(placed, places_m, strict=True):
        event, time_s = record.event, record.stamp_ns * 1e-9
        region = scenario.workspace.regions.get(event.region)
        if region is None:
            yield f"{track.agent}: {time_s:.3f} s: no region {event.region!r}"
            continue
        away_m = math.dist(region.at_m, place_m)
        if away_m > _most_m(scenario, track, region):
            yield (
                f"{track.agent}: {time_s:.3f} s: {event.action or 'visit'!r} done {away_m:.3f} m "
                f"from {event.region!r}, whose radius is {region.radius_m:g} m"
            )


def _left(scenario: Scenario, events: Sequence[TaskRecord], track: Track) -> Iterator[str]:
    """Say during which actions an agent left the region in which it began and ended them."""
    for start, end in _spans(events):
        region = scenario.workspace.regions.get(start.event.region)
        if region is None:
            continue
        start_s, end_s = start.stamp_ns * 1e-9, end.stamp_ns * 1e-9
        most_m = _most_m(scenario, track, region)
        away_m = _distances_m(track, region, start_s, end_s)
        if max(away_m) > most_m >= max(away_m[0], away_m[-1]):
            yield (
                f"{track.agent}: {start_s:.3f} s: leaves {start.event.region!r} during "
                f"{start.event.action!r}, and is {max(away_m):.3f} m away until {end_s:.3f} s"
            )


def _spans(events: Sequence[TaskRecord]) -> Iterator[tuple[TaskRecord, TaskRecord]]:
    """Yield the start and the end of each action that was finished."""
    started: dict[str, TaskRecord] = {}
    for record in events:
        if record.event.kind is TaskEventKind.ACTION_STARTED:
            started[record.event.action] = record
        elif record.event.kind is TaskEventKind.ACTION_FINISHED:
            start = started.pop(record.event.action, None)
            if start is not None:
                yield start, record


def _hasty(scenario: Scenario, agent: str, events: Sequence[TaskRecord]) -> Iterator[str]:
    """Say which actions took less time than they take, or were finished without a start."""
    durations_s = scenario.actions_of(agent)
    started_s: dict[str, float] = {}
    for record in events:
        event, time_s = record.event, record.stamp_ns * 1e-9
        if event.kind is TaskEventKind.ACTION_STARTED:
            started_s[event.action] = time_s
        elif event.kind is TaskEventKind.ACTION_FINISHED and event.action:
            since_s = started_s.pop(event.action, None)
            if event.action not in durations_s:
                yield f"{agent}: {time_s:.3f} s: no action {event.action!r}"
            elif since_s is None:
                yield f"{agent}: {time_s:.3f} s: {event.action!r} finished, but never started"
            elif time_s - since_s < durations_s[event.action] - _TIME_SLACK_S:
                yield (
                    f"{agent}: {time_s:.3f} s: {event.action!r} took {time_s - since_s:.3f} s, "
                    f"not {durations_s[event.action]:g} s"
                )


def _most_m(scenario: Scenario, track: Track, region: Region) -> float:
    """Return how far from its middle counts as in a region."""
    tolerance_m = scenario.drive_of(track.agent).position_tolerance_m
    return region.radius_m + tolerance_m + _PLACE_SLACK_M


def _distances_m(track: Track, region: Region, from_s: float, to_s: float) -> list[float]:
    """Return how far an agent was from a region's middle: at the ends and its samples between."""
    first, last = np.searchsorted(track.times_s, (from_s, to_s), side="right")
    times_s = np.array([from_s, *track.times_s[first:last], to_s])
    return [math.dist(region.at_m, place_m) for place_m in track.at(times_s).tolist()]
