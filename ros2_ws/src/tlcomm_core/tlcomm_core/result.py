"""Results of a run, ``result.json``, from its records alone.

``RESULT_FORMAT``    the document's ``format``
``RunFacts``         what the records don't say
``result_document``  the document

What its figures mean is defined in ``metrics``.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Final

from tlcomm_core.agent.timing import RoundTiming
from tlcomm_core.method import Method
from tlcomm_core.metrics.connection import windows_of
from tlcomm_core.metrics.coordination import (
    coordination_wall_s,
    indexed,
    solve_wall_s,
    timings_of,
)
from tlcomm_core.metrics.meeting import Meeting, meetings
from tlcomm_core.metrics.run import run_metrics
from tlcomm_core.metrics.summary import AgentMetrics
from tlcomm_core.records import RunRecords
from tlcomm_core.scenario.model import Scenario
from tlcomm_core.units import nanoseconds
from tlcomm_core.verdict import failures

__all__ = ["RESULT_FORMAT", "RunFacts", "result_document"]

RESULT_FORMAT: Final = "tlcomm-result/1"


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

    method: Method
    solver: str
    seed: int
    pace: str | float
    sim_s: float
    wall_s: float | None
    failures: tuple[str, ...] = ()


def result_document(scenario: Scenario, records: RunRecords, facts: RunFacts) -> dict[str, Any]:
    """Return a run's results, ready for ``json.dumps``.

    Rounds are those whose meeting took place or whose window went by. Their ``t_c`` is the
    realised start of the meeting and ``planned_t_c`` the predicted one.

    Args:
        scenario: what was run.
        records: what happened, each list in order of time.
        facts: the rest.
    """
    end_ns = nanoseconds(facts.sim_s)
    windows = windows_of(scenario, records, end_ns)
    wrong = [*facts.failures, *failures(scenario, records, facts.method, windows, end_ns)]
    metrics = run_metrics(scenario, records, facts.method, end_ns)
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
        "rounds": _rounds(scenario, records, facts),
        "communication": {
            "windows": len(windows),
            "satisfied": sum(window.satisfied for window in windows),
            "missed": sum(not window.satisfied for window in windows),
            "missed_rounds": [window.round for window in windows if not window.satisfied],
        },
        "agents": {name: _agent(name, records, own) for name, own in metrics.agents.items()},
        "metrics": metrics.document(),
        "verdict": wrong or "ok",
    }


def _rounds(scenario: Scenario, records: RunRecords, facts: RunFacts) -> list[dict[str, Any]]:
    if not facts.method.has_meetings:
        return []
    timings = indexed(records.timings)
    period_s, end_s = scenario.communication.period_s, facts.sim_s
    return [
        _round(meeting, period_s, timings_of(meeting, timings))
        for meeting in meetings(scenario, records)
        if meeting.took_place_by(end_s) or meeting.opens_s + period_s <= end_s
    ]


def _round(meeting: Meeting, period_s: float, timings: Sequence[RoundTiming]) -> dict[str, Any]:
    strategy = meeting.strategy
    nobodys = dict.fromkeys(meeting.members)
    return {
        "round": meeting.round,
        "members": list(meeting.members),
        "window": [meeting.opens_s, meeting.opens_s + period_s],
        "t_c": meeting.starts_s,
        "planned_t_c": strategy.communication_s,
        "initial_potential": strategy.initial_potential_s,
        "potential": strategy.potential_s,
        "bound": strategy.bound_s,
        "iterations": strategy.iteration,
        "solve_wall_s": solve_wall_s(timings),
        "coordination_wall_s": coordination_wall_s(timings, len(meeting.members)),
        "detour": meeting.detour_s,
        "wait": meeting.wait_s or nobodys,
        "additional_time": meeting.additional_s or nobodys,
    }


def _agent(name: str, records: RunRecords, metrics: AgentMetrics) -> dict[str, Any]:
    return {
        "tasks_satisfied": metrics.tasks_satisfied,
        "makespan_s": metrics.makespan_s,
        "distance_m": metrics.distance_m,
        "messages_sent": metrics.messages,
        "bytes_sent": metrics.bytes,
        "messages_undelivered": _undelivered(name, records),
    }


def _undelivered(agent: str, records: RunRecords) -> dict[str, int] | None:
    """Return how many messages an agent's radio didn't let through, by reason; None: unknown."""
    counts = records.messages_undelivered.get(agent)
    return None if counts is None else dict(sorted(counts.items()))
