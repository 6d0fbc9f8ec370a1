"""Audit a run from its bag alone: what its method promises, tasks, agreement and places."""

from argparse import ArgumentParser, Namespace
from typing import Final

from tlcomm_core.method import Method
from tlcomm_tools.audit.findings import Audit, audit_run
from tlcomm_tools.audit.tasks import TaskFinding
from tlcomm_tools.bag.origin import find_method, find_pace, find_scenario
from tlcomm_tools.bag.reader import read_run
from tlcomm_tools.collection import uncollected
from tlcomm_tools.status import Status
from tlcomm_tools.table import format_number, format_table
from tlcomm_tools.verbs.options import add_recorded_arguments, print_json

__all__ = ["EXAMPLE", "add_arguments", "run"]

EXAMPLE: Final = "tlcomm check runs/plant-team-20260101-120000"

_SHOWN_VIOLATIONS: Final = 30


def add_arguments(parser: ArgumentParser) -> None:
    """Add the verb's arguments."""
    add_recorded_arguments(parser)


def run(options: Namespace) -> Status:
    """Audit the run and show what was found."""
    with uncollected():
        recorded = read_run(options.run)
        audit = audit_run(
            find_scenario(options.run, recorded, options.scenario),
            find_method(options.run, recorded, options.method),
            recorded.records,
            recorded.end_ns,
            recorded.damage,
            find_pace(options.run, recorded, options.pace),
        )
    if options.json:
        print_json(audit.document())
    else:
        print(_format_audit(audit))
    return Status.PROPERTY_FAILED if audit.violations else Status.FINE


def _format_audit(audit: Audit) -> str:
    agreed = audit.strategies
    found = {label: text for own in audit.guarantees for label, text in own.shown.items()}
    if audit.method is not Method.NONE:
        found["strategies agreed"] = f"{agreed.equal} of {agreed.rounds} {_agreed_on(audit.method)}"
    if audit.equilibria is not None:
        own = audit.equilibria
        found["equilibria judged"] = f"{own.judged} of {own.strategies} strategies"
    rows = [
        (
            own.agent,
            format_number(own.satisfied, 0),
            str(own.claimed),
            format_number(own.longest_gap_s),
            _verdict(own),
        )
        for own in audit.tasks
    ]
    parts = [
        f"{audit.scenario}, method {audit.method}: audit of {audit.sim_s:.1f} s",
        *(f"  {label:17}  {text}" for label, text in found.items()),
        "",
        format_table(("agent", "satisfied", "claimed", "longest gap/s", "task"), rows),
        "",
    ]
    broken = [(name, str(len(lines))) for name, lines in audit.checks.items() if lines]
    if broken:
        parts += [format_table(("check", "violations"), broken), ""]
    if audit.note:
        parts.append(f"note: the bag was read only in part: {audit.note}")
    parts += [
        f"not available: {name}: {line}"
        for name, lines in audit.unavailable.items()
        for line in lines
    ]
    if not audit.violations:
        return "\n".join([*parts, "verdict: ok"])
    shown = [f"  - {line}" for line in audit.violations[:_SHOWN_VIOLATIONS]]
    if len(audit.violations) > _SHOWN_VIOLATIONS:
        shown.append(f"  … and {len(audit.violations) - _SHOWN_VIOLATIONS} more")
    return "\n".join([*parts, "verdict: FAILED", *shown])


def _agreed_on(method: Method) -> str:
    """Return what the method's strategies are for."""
    match method:
        case Method.PAIRWISE:
            return "meetings of pairs"
        case Method.ALL_TIME:
            return "turns"
        case _:
            return "rounds"


def _verdict(own: TaskFinding) -> str:
    """Return a task's verdict, and since when it is settled."""
    verdict = "–" if own.verdict is None else own.verdict
    return verdict if own.settled_s is None else f"{verdict} at {own.settled_s:.3f} s"
