"""From a run's records to what is drawn of them.

``ground``            the workspace
``field``             what was measured in it, as it truly was
``path``              an agent's way, thinned
``spans``             what an agent did when
``Doings``            the same, as it goes on
``satisfactions_s``   when its task was satisfied
``meetings``          where was met, and who was linked
``agreements``        what the agreed team strategies cost
``additional_times``  what rounds cost, by the results
``estimates``         what an agent took the field for
``add_estimate``      the same, as it goes on
``by_agent``          records, each agent's own
"""

from bisect import bisect_right
from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Any, Final, Protocol, TypeVar

import numpy as np
from numpy.typing import NDArray

from tlcomm_core.agent.actions import TaskEventKind
from tlcomm_core.game.strategy import TeamStrategy
from tlcomm_core.records import EstimateRecord, RunRecords, TaskRecord
from tlcomm_core.scenario.model import Scenario
from tlcomm_core.units import nanoseconds, seconds
from tlcomm_core.world.observation import Connectivity, Odometry
from tlcomm_tools.figures.elements import (
    Activity,
    AdditionalTime,
    Agreement,
    Ground,
    Meeting,
    Path,
    Profile,
    Series,
    Span,
)

__all__ = [
    "Doings",
    "add_estimate",
    "additional_times",
    "agreements",
    "by_agent",
    "estimates",
    "field",
    "ground",
    "meetings",
    "path",
    "satisfactions_s",
    "spans",
]

# What nobody sees in a figure: places and times are kept to a millimetre and a millisecond, and a
# way is straight where it is off by no more than this.
_DIGITS: Final = 3
_FINE_DIGITS: Final = 5
_STRAIGHT_M: Final = 0.02
# Estimates that follow each other faster than this are one step, to the last of them.
_STEP_S: Final = 0.5


def ground(scenario: Scenario) -> Ground:
    """Return the workspace as it is at the beginning."""
    workspace = scenario.workspace
    return Ground(
        origin_m=workspace.origin_m,
        size_m=workspace.size_m,
        cell_m=workspace.cell_m,
        obstacles_m=workspace.obstacles_m,
        regions_m={name: (*own.at_m, own.radius_m) for name, own in workspace.regions.items()},
    )


def field(scenario: Scenario, end_s: float) -> Profile | None:
    """Return ν(t) from the beginning to the end of a run; ``None`` if nothing is measured."""
    if scenario.field is None:
        return None
    times_s, values = np.array(scenario.field.profile).T
    bends_s = [0.0, *(time_s for time_s in times_s.tolist() if 0.0 < time_s < end_s), end_s]
    at_bends = np.interp(bends_s, times_s, values)
    return Profile(times_s=tuple(bends_s), values=tuple(at_bends.tolist()))


def path(odometry: Iterable[Odometry]) -> Path:
    """Return one agent's way, without the samples that lie on a straight line between others.

    Args:
        odometry: of this agent, in order of time.
    """
    samples = [(seconds(seen.stamp_ns), seen.pose.x_m, seen.pose.y_m) for seen in odometry]
    kept = np.round(_thinned(np.array(samples, dtype=np.float64).reshape(-1, 3)), _DIGITS)
    times_s, x_m, y_m = (tuple(column) for column in kept.T.tolist())
    return Path(times_s=times_s, x_m=x_m, y_m=y_m)


def spans(tasks: Iterable[TaskRecord], end_s: float) -> tuple[Span, ...]:
    """Return what one agent did when, by its own account; what goes on at the end ends there."""
    course = Doings()
    for record in tasks:
        course.follow(record)
    return tuple(sorted([*course.closed, *course.open(end_s)], key=lambda span: span.start_s))


def satisfactions_s(tasks: Iterable[TaskRecord]) -> tuple[float, ...]:
    """Return when one agent's task was satisfied."""
    return tuple(
        _rounded(seconds(record.stamp_ns))
        for record in tasks
        if record.event.kind is TaskEventKind.TASK_SATISFIED
    )


def meetings(scenario: Scenario, records: RunRecords, end_s: float) -> tuple[Meeting, ...]:
    """Return the meetings that were agreed on and took place, in order of time.

    Links are those of the world in the middle of a meeting, or when it was to begin if its agents
    didn't say that it did.
    """
    begun_s = _begun_s(records.tasks)
    air = _Air(tuple(scenario.agents), records.connectivity)
    found = []
    for strategy in _agreed(records):
        members = [own.agent for own in strategy.strategies]
        starts_s = [begun_s[who] for name in members if (who := (name, strategy.round)) in begun_s]
        start_s = max(starts_s, default=strategy.communication_s)
        middle_s = start_s + scenario.communication.duration_s / 2.0 if starts_s else start_s
        if start_s <= end_s:
            found.append(_meeting(strategy, start_s, air.links(members, middle_s)))
    return tuple(sorted(found, key=lambda meeting: meeting.start_s))


def agreements(records: RunRecords) -> tuple[Agreement, ...]:
    """Return what the agreed team strategies cost, in the order of rounds."""
    return tuple(
        Agreement(
            round=strategy.round,
            initial_s=strategy.initial_potential_s,
            agreed_s=strategy.potential_s,
        )
        for strategy in sorted(_agreed(records), key=lambda own: own.round)
    )


def additional_times(rounds: Iterable[Mapping[str, Any]]) -> tuple[AdditionalTime, ...]:
    """Return what rounds cost each agent, in all its meetings of a round together.

    Args:
        rounds: those of a result document; the ones in which nobody met are left out.
    """
    by_round: dict[int, dict[str, float]] = {}
    for own in rounds:
        for name, time_s in own["additional_time"].items():
            if time_s is not None:
                known_s = by_round.setdefault(own["round"], {})
                known_s[name] = known_s.get(name, 0.0) + time_s
    return tuple(
        AdditionalTime(round=number, by_agent_s=known_s)
        for number, known_s in sorted(by_round.items())
    )


def estimates(records: Iterable[EstimateRecord]) -> Series:
    """Return what one agent took the field for.

    Args:
        records: of this agent, in order of time.
    """
    steps: list[tuple[float, float]] = []
    for record in records:
        add_estimate(steps, record)
    return Series(
        times_s=tuple(time_s for time_s, _ in steps), values=tuple(value for _, value in steps)
    )


def add_estimate(steps: list[tuple[float, float]], record: EstimateRecord) -> None:
    """Add the next estimate to an agent's steps (s, value); only the last one may change."""
    step = (_rounded(seconds(record.stamp_ns)), round(record.value, _FINE_DIGITS))
    if steps and step[0] - steps[-1][0] < _STEP_S:
        # The estimates of one exchange are told apart by nobody; where it leads to counts.
        step = (steps.pop()[0], step[1])
    if not steps or steps[-1][1] != step[1]:
        steps.append(step)


class Doings:
    """Follows one agent's task events: an action, or waiting for a meeting, then the meeting.

    Attributes:
        closed: what it has done, in the order of its end.
    """

    def __init__(self) -> None:
        self.closed: list[Span] = []
        self._open: dict[Activity, tuple[str, float]] = {}

    def follow(self, record: TaskRecord) -> None:
        """Take one event."""
        time_s, event = seconds(record.stamp_ns), record.event
        match event.kind:
            case TaskEventKind.ACTION_STARTED:
                self._end(Activity.WAIT, time_s)
                self._begin(Activity.ACTION, event.action, time_s)
            case TaskEventKind.ACTION_FINISHED:
                self._end(Activity.ACTION, time_s)
            case TaskEventKind.FAULT if event.is_failed_attempt:
                self._end(Activity.ACTION, time_s)
            case TaskEventKind.MEETING_REACHED:
                self._begin(Activity.WAIT, "", time_s)
            case TaskEventKind.MEETING_STARTED:
                self._end(Activity.WAIT, time_s)
                self._begin(Activity.MEETING, "", time_s)
            case TaskEventKind.MEETING_ENDED:
                self._end(Activity.WAIT, time_s)
                self._end(Activity.MEETING, time_s)
            case _:
                pass

    def open(self, end_s: float) -> Iterator[Span]:
        """Yield what goes on, as if it ended now."""
        for activity, (action, start_s) in self._open.items():
            yield from _span(activity, action, start_s, end_s)

    def _begin(self, activity: Activity, action: str, time_s: float) -> None:
        self._end(activity, time_s)
        self._open[activity] = (action, time_s)

    def _end(self, activity: Activity, time_s: float) -> None:
        if activity not in self._open:
            return
        action, start_s = self._open.pop(activity)
        self.closed += _span(activity, action, start_s, time_s)


def _span(activity: Activity, action: str, start_s: float, end_s: float) -> Iterator[Span]:
    """Yield a span, unless it is too short to be one."""
    start_s, end_s = _rounded(start_s), _rounded(end_s)
    if start_s < end_s:
        yield Span(activity=activity, action=action, start_s=start_s, end_s=end_s)


class _Air:
    """Who heard whom at a time."""

    def __init__(self, agents: Sequence[str], connectivity: Sequence[Connectivity]) -> None:
        self._agents = agents
        self._seen = connectivity
        self._stamps_ns = [seen.stamp_ns for seen in connectivity]

    def links(self, members: Iterable[str], time_s: float) -> tuple[tuple[str, str], ...]:
        """Return the links between some agents."""
        last = bisect_right(self._stamps_ns, nanoseconds(time_s)) - 1
        if last < 0:
            return ()
        named = ((self._agents[i], self._agents[j]) for i, j in self._seen[last].edges)
        present = frozenset(members)
        return tuple(pair for pair in named if present.issuperset(pair))


def _meeting(strategy: TeamStrategy, start_s: float, links: tuple[tuple[str, str], ...]) -> Meeting:
    return Meeting(
        round=strategy.round,
        start_s=_rounded(start_s),
        places_m={own.agent: (_rounded(own.x_m), _rounded(own.y_m)) for own in strategy.strategies},
        links=links,
    )


def _agreed(records: RunRecords) -> Iterable[TeamStrategy]:
    """Return each agreed team strategy once, whoever holds it, in the order of agreement."""
    return dict.fromkeys(record.strategy for record in records.strategies)


def _begun_s(tasks: Iterable[TaskRecord]) -> Mapping[tuple[str, int], float]:
    """Return when each agent's meeting of each round began."""
    return {
        (record.agent, record.event.round): seconds(record.stamp_ns)
        for record in tasks
        if record.event.kind is TaskEventKind.MEETING_STARTED
    }


def _thinned(samples: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the rows (t, x, y) that an interpolation in between is right within a tolerance.

    Source: the algorithm of Ramer, Douglas and Peucker, with the distance at the same time.
    Cost: O(N log N) on ways of even bends, O(N²) at worst.
    """
    if not len(samples):
        return samples
    kept = np.zeros(len(samples), dtype=np.bool_)
    kept[[0, -1]] = True
    stretches = [(0, len(samples) - 1)]
    while stretches:
        first, last = stretches.pop()
        if last - first <= 1:
            # Of two at the same time, a jump, no third one is worse.
            continue
        times_s, start, stop = samples[first : last + 1, 0], samples[first], samples[last]
        share = (times_s - start[0]) / max(stop[0] - start[0], 1e-12)
        straight_m = start[1:] + share[:, None] * (stop[1:] - start[1:])
        off_m = np.hypot(*(samples[first : last + 1, 1:] - straight_m).T)
        worst = 1 + int(np.argmax(off_m[1:-1]))
        if off_m[worst] > _STRAIGHT_M:
            kept[first + worst] = True
            stretches += [(first, first + worst), (first + worst, last)]
    return samples[kept]


def _rounded(value: float) -> float:
    return round(value, _DIGITS)


class _Owned(Protocol):
    @property
    def agent(self) -> str: ...


_T = TypeVar("_T", bound=_Owned)


def by_agent(scenario: Scenario, records: Iterable[_T]) -> dict[str, list[_T]]:
    """Return what there is of each agent, in the scenario's order and the records'."""
    owned = defaultdict[str, list[_T]](list)
    for record in records:
        owned[record.agent].append(record)
    return {name: owned[name] for name in scenario.agents}
