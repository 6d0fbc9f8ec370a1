"""The audit as one document.

``AUDIT_FORMAT``  the document's ``format``
``Audit``         everything that was found
``audit_run``     audits a run from its records, be they from a bag or from memory
"""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any, Final

from tlcomm_core.method import Method
from tlcomm_core.pace import LOCK_STEP, Pace
from tlcomm_core.records import RunRecords
from tlcomm_core.scenario.model import Scenario
from tlcomm_tools.audit.actions import audit_actions
from tlcomm_tools.audit.clearance import audit_clearance
from tlcomm_tools.audit.conditions import audit_conditions
from tlcomm_tools.audit.equilibria.finding import EquilibriumFinding, audit_equilibria
from tlcomm_tools.audit.evidence import Evidence
from tlcomm_tools.audit.guarantees.guarantee import Guarantee
from tlcomm_tools.audit.guarantees.methods import audit_guarantees
from tlcomm_tools.audit.hearing import audit_hearing, unheard
from tlcomm_tools.audit.links import WindowFinding
from tlcomm_tools.audit.meetings import audit_meetings
from tlcomm_tools.audit.motion import audit_motion
from tlcomm_tools.audit.plans import audit_plans
from tlcomm_tools.audit.strategies import StrategyFinding, audit_strategies
from tlcomm_tools.audit.tasks import TaskFinding, audit_task
from tlcomm_tools.audit.trespass import audit_trespass

__all__ = ["AUDIT_FORMAT", "Audit", "audit_run"]

AUDIT_FORMAT: Final = "tlcomm-audit/1"


@dataclass(frozen=True, slots=True)
class Audit:
    """Everything that was found.

    Attributes:
        scenario: its name.
        method: of coordination.
        sim_s: time that the records span.
        note: why they couldn't be read to their end, or "".
        guarantees: what the method promises, and what was found of it.
        windows: each window's outcome for the whole team, whether or not that is promised.
        tasks: each agent's task.
        strategies: what agents hold.
        equilibria: whether anybody could gain alone; ``None`` if the method leaves no choice.
        checks: by what was checked, what is wrong, a line each.
        unavailable: by what would have been checked, what the records don't tell, a line each.
    """

    scenario: str
    method: Method
    sim_s: float
    note: str
    guarantees: tuple[Guarantee, ...]
    windows: tuple[WindowFinding, ...]
    tasks: tuple[TaskFinding, ...]
    strategies: StrategyFinding
    equilibria: EquilibriumFinding | None
    checks: Mapping[str, tuple[str, ...]]
    unavailable: Mapping[str, tuple[str, ...]]

    @property
    def violations(self) -> tuple[str, ...]:
        """What is wrong, a line each, of all checks."""
        return tuple(line for lines in self.checks.values() for line in lines)

    def document(self) -> dict[str, Any]:
        """Return it ready for ``json.dumps``."""
        return {
            "format": AUDIT_FORMAT,
            "scenario": self.scenario,
            "method": self.method.value,
            "sim_s": self.sim_s,
            "note": self.note or None,
            "guarantees": [own.document() for own in self.guarantees],
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
            "equilibria": self.equilibria and self.equilibria.document(),
            "checks": {
                name: None if name in self.unavailable and not lines else list(lines)
                for name, lines in self.checks.items()
            },
            "unavailable": {name: list(lines) for name, lines in self.unavailable.items()},
            "verdict": list(self.violations) or "ok",
        }


def audit_run(
    scenario: Scenario,
    method: Method,
    records: RunRecords,
    end_ns: int,
    damage: str = "",
    pace: Pace | None = LOCK_STEP,
) -> Audit:
    """Audit a run against its scenario, and against what its method promises.

    Args:
        scenario: what was asked for.
        method: of coordination.
        records: what was recorded, from a bag or in memory.
        end_ns: end of the run.
        damage: why the records couldn't be read to their end, or "".
        pace: how simulated time went on; ``None`` if that isn't known.

    Cost: about 1 s for 100 rounds of 8 agents.
    """
    evidence = Evidence.gather(scenario, records, end_ns * 1e-9)
    guarantees = audit_guarantees(method, evidence)
    tasks = [audit_task(method, evidence, agent) for agent in evidence.agents]
    strategies = audit_strategies(method, evidence)
    equilibria = audit_equilibria(method, evidence, pace)
    checks = {
        "bag": (f"the bag is damaged: {damage}",) if damage else (),
        "records": (*evidence.faults, *_silent(method, evidence)),
        "method": tuple(line for own in guarantees for line in own.violations),
        **_deeds(evidence),
        "tasks": tuple(line for own in tasks for line in own.violations),
        "strategies": strategies.violations,
        "meetings": tuple(_meetings(method, evidence)),
        "equilibria": () if equilibria is None else equilibria.violations,
        "hearing": tuple(audit_hearing(evidence, pace)),
    }
    unavailable = {
        "equilibria": () if equilibria is None else equilibria.unavailable,
        "hearing": unheard(evidence, pace),
    }
    return Audit(
        scenario=scenario.name,
        method=method,
        sim_s=evidence.end_s,
        note=damage,
        guarantees=guarantees,
        windows=tuple(evidence.windows),
        tasks=tuple(tasks),
        strategies=strategies,
        equilibria=equilibria,
        checks=checks,
        unavailable={name: lines for name, lines in unavailable.items() if lines},
    )


def _silent(method: Method, evidence: Evidence) -> Iterator[str]:
    """Say who told nothing of what it did: whoever meets tells at least that."""
    period_s = evidence.scenario.communication.period_s
    if method.has_meetings and evidence.end_s >= period_s:
        for agent in evidence.agents:
            if not evidence.events_of(agent):
                yield f"{agent}: no task events in {evidence.end_s:.3f} s"


def _deeds(evidence: Evidence) -> dict[str, tuple[str, ...]]:
    """Say, by check, what agents did that they can't or may not."""
    found: dict[str, list[str]] = {name: [] for name in ("motion", "clearance", "actions")}
    scenario = evidence.scenario
    for agent in evidence.agents:
        track, events = evidence.track_of.get(agent), evidence.events_of(agent)
        found["motion"] += audit_motion(scenario, agent, evidence.samples_of(agent))
        found["clearance"] += audit_clearance(scenario.workspace, track)
        found["clearance"] += audit_trespass(scenario, agent, track)
        found["actions"] += audit_actions(scenario, agent, events, track)
        found["actions"] += audit_conditions(scenario, agent, events, track)
    return {name: tuple(lines) for name, lines in found.items()}


def _meetings(method: Method, evidence: Evidence) -> Iterator[str]:
    """Say what is wrong with the meetings that were agreed on."""
    if method.has_meetings:
        yield from audit_plans(evidence)
    if method.chooses_places:
        yield from audit_meetings(evidence.scenario, evidence.records.strategies)
