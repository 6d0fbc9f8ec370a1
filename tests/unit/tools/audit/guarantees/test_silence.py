"""Tests of ``tlcomm_tools.audit.guarantees.silence``: nobody meets."""

from support.hand_made_run import task
from support.hand_made_trio import hold, lone, move, trio_scenario
from tlcomm_core.agent.actions import TaskEventKind
from tlcomm_core.method import Method
from tlcomm_core.records import RunRecords
from tlcomm_core.units import nanoseconds
from tlcomm_tools.audit.findings import Audit, audit_run


def audit(records: RunRecords) -> Audit:
    """Audit records of agents by themselves."""
    return audit_run(trio_scenario(), Method.NONE, records, nanoseconds(45.0))


def test_who_is_never_connected_keeps_the_promise() -> None:
    """Windows are counted, and not owed."""
    records = lone()
    move(records, "stern", [(0.0, 7.0), (45.0, 7.0)])
    found = audit(records)
    assert found.violations == ()
    assert [own.satisfied for own in found.windows] == [False] * 4
    assert found.guarantees[0].figures == {"meetings": 0, "strategies": 0}
    assert (found.strategies.rounds, found.strategies.equal) == (0, 0)


def test_meetings_and_agreements_are_named() -> None:
    """Whoever comes to a meeting or holds a strategy."""
    records = lone()
    records.tasks.append(task(10.0, "mid", TaskEventKind.MEETING_STARTED, round_=1))
    hold(records, 11.0, ["bow"], 2, ["bow", "mid"])
    assert audit(records).violations == (
        "mid: 10.000 s: MEETING_STARTED, though nobody meets",
        "bow: holds a strategy for round 2, though nobody meets",
    )
