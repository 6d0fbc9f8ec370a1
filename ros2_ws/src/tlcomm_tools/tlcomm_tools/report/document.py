"""All that the page shows, ready for JSON.

``REPORT_FORMAT``    the document's ``format``
``report_document``  the document of a run
``finite``           a part of it, as JSON can say it
"""

import math
from collections.abc import Iterable, Mapping
from typing import Any, Final, Protocol

from tlcomm_core.method import Method
from tlcomm_core.metrics.run import run_metrics
from tlcomm_core.pace import Pace
from tlcomm_core.protocol.messages import BestResponse
from tlcomm_core.records import RunRecords
from tlcomm_core.scenario.model import Scenario
from tlcomm_core.units import seconds
from tlcomm_tools.audit.evidence import usable_parts
from tlcomm_tools.audit.findings import audit_run
from tlcomm_tools.bag.reader import RecordedRun
from tlcomm_tools.figures import reduction
from tlcomm_tools.report.links import link_spans
from tlcomm_tools.report.plans import NO_PLANS, Plans
from tlcomm_tools.report.rounds import round_documents
from tlcomm_tools.report.steps import done_steps, incidents

__all__ = ["REPORT_FORMAT", "finite", "report_document"]

REPORT_FORMAT: Final = "tlcomm-report/1"


def report_document(
    scenario: Scenario,
    method: Method,
    recorded: RecordedRun,
    said: Iterable[BestResponse] = (),
    plans: Mapping[str, Plans] = NO_PLANS,
    pace: Pace | None = None,
) -> dict[str, Any]:
    """Return what a page shows of a run; a number that isn't finite isn't available.

    Args:
        scenario: what was run.
        method: of coordination.
        recorded: what the bag holds.
        said: what agents told of their best responses.
        plans: the ways that agents had before them, as they were published.
        pace: how simulated time went on; by default as the bag says.

    Cost: about 4 s for 100 rounds of 8 agents, half of it the audit.
    """
    end_ns, end_s = recorded.end_ns, seconds(recorded.end_ns)
    pace = recorded.pace if pace is None else pace
    audit = audit_run(scenario, method, recorded.records, end_ns, recorded.damage, pace)
    # What isn't usable the audit names.
    records, _ = usable_parts(scenario, recorded.records)
    metrics = run_metrics(scenario, records, method, end_ns)
    document = {
        "format": REPORT_FORMAT,
        "run": _run(scenario, method, recorded.notes, end_s),
        "ground": _ground(scenario),
        "agents": _agents(scenario, records, end_s, plans),
        "links": link_spans(records.connectivity, len(scenario.agents), end_s),
        "rounds": round_documents(scenario, method, records, end_s, said),
        "incidents": incidents(records.tasks),
        "field": _dump(reduction.field(scenario, end_s)),
        "metrics": metrics.document(),
        "windows": [{"round": own.round, "satisfied": own.satisfied} for own in audit.windows],
        "audit": audit.document(),
    }
    return {name: finite(part) for name, part in document.items()}


def _run(
    scenario: Scenario, method: Method, notes: Mapping[str, str], end_s: float
) -> dict[str, Any]:
    return {
        "scenario": scenario.name,
        "method": method.value,
        "has_meetings": method.has_meetings,
        "keeps_windows": method.keeps_windows,
        "solver": notes.get("solver"),
        "seed": notes.get("seed"),
        "end_s": end_s,
        "range_m": scenario.communication.range_m,
        "period_s": scenario.communication.period_s,
        "duration_s": scenario.communication.duration_s,
    }


def _ground(scenario: Scenario) -> dict[str, Any]:
    changes = [own.model_dump(mode="json") for own in scenario.workspace.changes]
    return {**reduction.ground(scenario).model_dump(mode="json"), "changes": changes}


def _agents(
    scenario: Scenario, records: RunRecords, end_s: float, plans: Mapping[str, Plans]
) -> list[dict[str, Any]]:
    odometry = reduction.by_agent(scenario, records.odometry)
    tasks = reduction.by_agent(scenario, records.tasks)
    estimates = reduction.by_agent(scenario, records.estimates)
    return [
        {
            "name": name,
            "task": own.whole_task if own.automaton is None else "as its automaton says",
            "soft_task": None if own.soft is None else own.soft.task,
            "path": _dump(reduction.path(odometry[name])),
            "spans": [_dump(span) for span in reduction.spans(tasks[name], end_s)],
            "satisfied_s": reduction.satisfactions_s(tasks[name]),
            "steps": done_steps(tasks[name]),
            "estimates": _dump(reduction.estimates(estimates[name])),
            **plans.get(name, Plans()).document(),
        }
        for name, own in scenario.agents.items()
    ]


class _Model(Protocol):
    def model_dump(self, *, mode: str) -> dict[str, Any]: ...


def _dump(model: _Model | None) -> dict[str, Any] | None:
    return None if model is None else model.model_dump(mode="json")


def finite(value: Any) -> Any:  # noqa: ANN401 - any part of a document
    """Return a part of a document with None for what JSON has no number for; fresh."""
    if isinstance(value, float):
        return value if math.isfinite(value) else None
    if isinstance(value, Mapping):
        return {name: finite(own) for name, own in value.items()}
    if isinstance(value, list | tuple):
        return [finite(own) for own in value]
    return value
