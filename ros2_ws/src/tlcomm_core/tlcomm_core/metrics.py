"""Results of a run, ``result.json``, from its records alone.

``RESULT_FORMAT``    the document's ``format``
``RunFacts``         what the records don't say
``result_document``  the document
``connected_intervals``  when the team was connected, by the world's own account
``patience_s``       how long a task may go without being satisfied
"""

import re
from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Any, Final

from tlcomm_core.agent.actions import TaskEventKind
from tlcomm_core.agent.timing import RoundTiming
from tlcomm_core.game.strategy import TeamStrategy
from tlcomm_core.records import RunRecords
from tlcomm_core.scenario.model import Scenario
from tlcomm_core.scenario.task import read_automaton
from tlcomm_core.units import nanoseconds, seconds
from tlcomm_core.windows import Window, judge_windows
from tlcomm_core.world.observation import Connectivity

__all__ = [
    "RESULT_FORMAT",
    "RunFacts",
    "connected_intervals",
    "patience_s",
    "result_document",
]

RESULT_FORMAT: Final = "tlcomm-result/1"

_SPARE_WINDOWS: Final = 2


@dataclass(frozen=True, slots=True)
class RunFacts:
    """What the records of a run don't say.

    Attributes:
        method: of coordination.
        solver: of the round problem.
        seed: of all that was random.
        pace: "lockstep" or the real-time factor asked for.
        sim_s: simulated time at the end.
        wall_s: wall time of the run, or ``None`` if unknown.
        failures: what broke the run, for the verdict.
    """

    method: str
    solver: str
    seed: int
    pace: str | float
    sim_s: float
    wall_s: float | None
    failures: tuple[str, ...] = ()


def result_document(scenario: Scenario, records: RunRecords, facts: RunFacts) -> dict[str, Any]:
    """Return a run's results, ready for ``json.dumps``.

    Rounds are those whose meeting took place or whose window went by. Their ``t_c`` is the
    realised start of the meeting, max(max_i t_i, r·T_c) over the agents' arrivals as reported,
    and ``planned_t_c`` the predicted one; ``additional_time`` is the planned detour δ_i and the
    realised wait t_c − t_i; ``coordination_wall_s`` runs from the moment when the last agent made
    its first offer, so that the team was complete, to the last agent's agreement.
    The makespan is the longest time between consecutive satisfactions of an agent's task.

    Args:
        scenario: what was run.
        records: what happened, each list in order of time.
        facts: the rest.

    Source: Section III-C for ξ, equation (5) for the additional times, equation (6) for Φ and t_c.
    """
    end_ns = nanoseconds(facts.sim_s)
    timing = scenario.communication
    windows = judge_windows(
        connected_intervals(records.connectivity, end_ns),
        timing.period_s,
        timing.duration_s,
        end_ns,
    )
    failures = [
        *facts.failures,
        *(_missed(window, timing.duration_s) for window in windows if not window.satisfied),
        *_unsatisfied(scenario, records, end_ns),
        *_disagreements(scenario, records),
        *_faults(records),
    ]
    wall_s = facts.wall_s
    return {
        "format": RESULT_FORMAT,
        "scenario": scenario.name,
        "method": facts.method,
        "solver": facts.solver,
        "seed": facts.seed,
        "pace": facts.pace,
        "sim_s": facts.sim_s,
        "wall_s": wall_s,
        "realtime_factor": facts.sim_s / wall_s if wall_s else None,
        "rounds": _rounds(scenario, records, end_ns),
        "communication": {
            "windows": len(windows),
            "satisfied": sum(window.satisfied for window in windows),
            "missed": sum(not window.satisfied for window in windows),
            "missed_rounds": [window.round for window in windows if not window.satisfied],
        },
        "agents": {name: _agent(name, records) for name in scenario.agents},
        "verdict": failures or "ok",
    }


def connected_intervals(connectivity: Sequence[Connectivity], end_ns: int) -> list[tuple[int, int]]:
    """Return [from, to) of each connection of the whole team; the last state holds to the end."""
    intervals: list[tuple[int, int]] = []
    since_ns: int | None = None
    for seen in connectivity:
        if seen.connected and since_ns is None:
            since_ns = seen.stamp_ns
        elif not seen.connected and since_ns is not None:
            intervals.append((since_ns, seen.stamp_ns))
            since_ns = None
    if since_ns is not None:
        intervals.append((since_ns, end_ns))
    return intervals


def patience_s(scenario: Scenario, agent: str) -> float:
    """Return the longest that an agent's task may go without being satisfied, if nothing fails.

    Every window leaves time for at least one more action of the task; two windows are spare. A
    given automaton is taken to need an action per state.
    """
    own = scenario.agents[agent]
    if own.automaton is not None:
        actions = read_automaton(own.automaton).state_count
    else:
        words = re.findall(r"\w+", own.whole_task)
        actions = sum(word in scenario.actions_of(agent) for word in words)
    return (actions + _SPARE_WINDOWS) * scenario.communication.period_s


def _rounds(scenario: Scenario, records: RunRecords, end_ns: int) -> list[dict[str, Any]]:
    held: dict[int, TeamStrategy] = {}
    for record in records.strategies:
        held.setdefault(record.strategy.round, record.strategy)
    arrivals = _arrivals_s(records)
    timings: dict[int, list[RoundTiming]] = defaultdict(list)
    for timing in records.timings:
        timings[timing.round].append(timing)
    period_s = scenario.communication.period_s
    return [
        _round(scenario, strategy, arrivals[number], timings[number])
        for number, strategy in sorted(held.items())
        if len(arrivals[number]) == len(scenario.agents)
        or nanoseconds((number + 1) * period_s) <= end_ns
    ]


def _round(
    scenario: Scenario,
    strategy: TeamStrategy,
    arrivals_s: Mapping[str, float],
    timings: Sequence[RoundTiming],
) -> dict[str, Any]:
    period_s = scenario.communication.period_s
    opens_s = strategy.round * period_s
    met = len(arrivals_s) == len(scenario.agents)
    starts_s = max(opens_s, *arrivals_s.values()) if met else None
    additional_s = {
        own.agent: own.extra_travel_s + (starts_s - arrivals_s[own.agent])
        if starts_s is not None
        else None
        for own in strategy.strategies
    }
    return {
        "round": strategy.round,
        "window": [opens_s, opens_s + period_s],
        "t_c": starts_s,
        "planned_t_c": strategy.communication_s,
        "initial_potential": strategy.initial_potential_s,
        "potential": strategy.potential_s,
        "bound": strategy.bound_s,
        "iterations": strategy.iteration,
        "solve_wall_s": max((timing.solve_wall_s for timing in timings), default=None),
        "coordination_wall_s": _coordination_wall_s(timings, len(scenario.agents)),
        "additional_time": additional_s,
    }


def _coordination_wall_s(timings: Sequence[RoundTiming], team: int) -> float | None:
    if len(timings) < team:
        return None
    complete_s = max(timing.offered_wall_s for timing in timings)
    return max(timing.agreed_wall_s for timing in timings) - complete_s


def _arrivals_s(records: RunRecords) -> dict[int, dict[str, float]]:
    """Return per round when each agent reached its place."""
    arrivals: dict[int, dict[str, float]] = defaultdict(dict)
    for record in records.tasks:
        if record.event.kind is TaskEventKind.MEETING_REACHED:
            # The last: an agent that was cut off from its place may have waited elsewhere first.
            arrivals[record.event.round][record.agent] = seconds(record.stamp_ns)
    return arrivals


def _agent(name: str, records: RunRecords) -> dict[str, Any]:
    satisfied_ns = list(_satisfied_ns(name, records))
    gaps_ns = [later - earlier for earlier, later in pairwise(satisfied_ns)]
    poses = (seen.pose for seen in records.odometry if seen.agent == name)
    return {
        "tasks_satisfied": len(satisfied_ns),
        "makespan_s": seconds(max(gaps_ns)) if gaps_ns else None,
        "distance_m": sum(
            earlier.distance_m(later.x_m, later.y_m) for earlier, later in pairwise(poses)
        ),
        "messages_sent": records.messages_sent.get(name),
        "bytes_sent": records.bytes_sent.get(name),
        "messages_undelivered": _undelivered(name, records),
    }


def _undelivered(agent: str, records: RunRecords) -> dict[str, int] | None:
    """Return how many messages an agent's radio didn't let through, by reason; None: unknown."""
    counts = records.messages_undelivered.get(agent)
    return None if counts is None else dict(sorted(counts.items()))


def _satisfied_ns(agent: str, records: RunRecords) -> Iterator[int]:
    return (
        record.stamp_ns
        for record in records.tasks
        if record.agent == agent and record.event.kind is TaskEventKind.TASK_SATISFIED
    )


def _failed_ns(agent: str, records: RunRecords) -> Iterator[int]:
    return (
        record.stamp_ns
        for record in records.tasks
        if record.agent == agent and record.event.is_failed_attempt
    )


def _missed(window: Window, duration_s: float) -> str:
    longest_s = seconds(window.longest_ns)
    return (
        f"window {window.round} missed: connected for {longest_s:.3f} s at most, "
        f"not {duration_s:g} s"
    )


def _unsatisfied(scenario: Scenario, records: RunRecords, end_ns: int) -> Iterator[str]:
    """Say whose task went unsatisfied too long; each failed attempt may have cost a window.

    How long another task than the scenario's may take isn't known.
    """
    changed = {r.agent for r in records.tasks if r.event.kind is TaskEventKind.TASK_CHANGED}
    for agent in (name for name in scenario.agents if name not in changed):
        moments_ns = [0, *_satisfied_ns(agent, records), end_ns]
        start_ns, stop_ns = max(pairwise(moments_ns), key=lambda gap: gap[1] - gap[0])
        failed = sum(start_ns < time_ns <= stop_ns for time_ns in _failed_ns(agent, records))
        limit_s = patience_s(scenario, agent) + failed * scenario.communication.period_s
        if stop_ns - start_ns > nanoseconds(limit_s):
            yield (
                f"{agent}: task not satisfied from {seconds(start_ns):.3f} s "
                f"to {seconds(stop_ns):.3f} s"
            )


def _disagreements(scenario: Scenario, records: RunRecords) -> Iterator[str]:
    """Say which rounds not all agents hold the same strategy of; a last one may be incomplete.

    Who reported that it lacks the others' confirmations does as all do, and holds nothing.
    """
    reported = {(r.event.round + 1, r.agent) for r in records.tasks if r.event.is_disagreement}
    held: dict[int, dict[str, set[TeamStrategy]]] = defaultdict(lambda: defaultdict(set))
    for record in records.strategies:
        held[record.strategy.round][record.agent].add(record.strategy)
    for number, by_agent in sorted(held.items()):
        if len(set[TeamStrategy]().union(*by_agent.values())) > 1:
            yield f"round {number}: agents hold different strategies"
        missing = _names(
            name
            for name in scenario.agents
            if name not in by_agent and (number, name) not in reported
        )
        if missing and number < max(held):
            yield f"round {number}: not held by {missing}"


def _faults(records: RunRecords) -> Iterator[str]:
    for record in records.tasks:
        if record.event.kind is TaskEventKind.FAULT and not record.event.is_coped_with:
            time_s = seconds(record.stamp_ns)
            yield f"{record.agent}: fault at {time_s:.3f} s: {record.event.detail}"


def _names(names: Iterable[str]) -> str:
    return ", ".join(names)
