"""The audit as one document.

``AUDIT_FORMAT``  the document's ``format``
``Audit``         everything that was found
``audit_run``     audits a recorded run
"""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any, Final

from tlcomm_core.scenario.model import Scenario
from tlcomm_tools.audit.conditions import audit_conditions
from tlcomm_tools.audit.links import WindowFinding, judge_windows, team_intervals
from tlcomm_tools.audit.meetings import audit_meetings
from tlcomm_tools.audit.strategies import StrategyFinding, audit_strategies
from tlcomm_tools.audit.tasks import TaskFinding, audit_task
from tlcomm_tools.audit.tracks import Track, build_tracks
from tlcomm_tools.audit.trespass import audit_trespass
from tlcomm_tools.bag.reader import RecordedRun

__all__ = ["AUDIT_FORMAT", "Audit", "audit_run"]

AUDIT_FORMAT: Final = "tlcomm-audit/1"


@dataclass(frozen=True, slots=True)
class Audit:
    """Everything that was found.

    Attributes:
        scenario: its name.
        sim_s: time that the bag spans.
        note: why it couldn't be read to its end, or "".
        windows: each window's outcome.
        tasks: each agent's task.
        strategies: what agents hold.
        violations: one line each, of all kinds.
    """

    scenario: str
    sim_s: float
    note: str
    windows: tuple[WindowFinding, ...]
    tasks: tuple[TaskFinding, ...]
    strategies: StrategyFinding
    violations: tuple[str, ...]

    def document(self) -> dict[str, Any]:
        """Return it ready for ``json.dumps``."""
        return {
            "format": AUDIT_FORMAT,
            "scenario": self.scenario,
            "sim_s": self.sim_s,
            "note": self.note or None,
            "windows": [
                {"round": own.round, "connected_s": own.longest_s, "satisfied": own.satisfied}
                for own in self.windows
            ],
            "tasks": {
                own.agent: {
                    "claimed": own.claimed,
                    "satisfied": own.satisfied,
                    "longest_gap_s": own.longest_gap_s,
                    "verdict": own.verdict,
                    "settled_s": own.settled_s,
                }
                for own in self.tasks
            },
            "strategies": {"rounds": self.strategies.rounds, "equal": self.strategies.equal},
            "verdict": list(self.violations) or "ok",
        }


def audit_run(scenario: Scenario, run: RecordedRun) -> Audit:
    """Audit a recorded run against its scenario."""
    end_s = run.end_ns * 1e-9
    agents = tuple(scenario.agents)
    tracks, faults = build_tracks(run.records.odometry, agents, end_s)
    links = scenario.communication
    walls = scenario.workspace.obstacles_m if scenario.radio.line_of_sight else ()
    is_complete = len(tracks) == len(agents)
    intervals = team_intervals(tracks, links.range_m, walls) if is_complete else []
    windows = judge_windows(intervals, links.period_s, links.duration_s, end_s)
    track_of = {track.agent: track for track in tracks}
    tasks = [
        audit_task(
            scenario,
            agent,
            [record for record in run.records.tasks if record.agent == agent],
            track_of.get(agent),
            end_s,
        )
        for agent in agents
    ]
    strategies = audit_strategies(run.records.strategies, run.records.tasks, agents, links.period_s)
    missed = [
        f"window {own.round}: connected for {own.longest_s:.3f} s from "
        f"[{own.round * links.period_s:g} s, {(own.round + 1) * links.period_s:g} s) on, "
        f"not {links.duration_s:g} s"
        for own in windows
        if not own.satisfied
    ]
    violations = [
        *([f"the bag is damaged: {run.damage}"] if run.damage else []),
        *faults,
        *missed,
        *(line for own in tasks for line in own.violations),
        *(line for own in agents for line in _breaches(scenario, own, run, track_of.get(own))),
        *strategies.violations,
        *audit_meetings(scenario, run.records.strategies),
    ]
    return Audit(
        scenario=scenario.name,
        sim_s=end_s,
        note=run.damage,
        windows=tuple(windows),
        tasks=tuple(tasks),
        strategies=strategies,
        violations=tuple(violations),
    )


def _breaches(
    scenario: Scenario, agent: str, run: RecordedRun, track: Track | None
) -> Iterator[str]:
    """Say where an agent was, or what it did, that it may not."""
    events = [record for record in run.records.tasks if record.agent == agent]
    yield from audit_trespass(scenario, agent, track)
    yield from audit_conditions(scenario, agent, events, track)
