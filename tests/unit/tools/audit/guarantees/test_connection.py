"""Tests of ``tlcomm_tools.audit.guarantees.connection``: the team is connected at every instant."""

import pytest

from support.hand_made_trio import by_turns, move, trio_scenario
from tlcomm_core.method import Method
from tlcomm_core.records import RunRecords
from tlcomm_core.units import nanoseconds
from tlcomm_tools.audit.findings import Audit, audit_run


def audit(records: RunRecords, end_s: float = 45.0) -> Audit:
    """Audit records of a team that is led by turns."""
    return audit_run(trio_scenario(), Method.ALL_TIME, records, nanoseconds(end_s))


def test_a_good_run_keeps_both_promises() -> None:
    """It is connected from its begin to its end, and its agents act by turns."""
    found = audit(by_turns())
    assert found.violations == ()
    connection, turns = found.guarantees
    assert connection.figures == {"connected_s": 45.0, "breaks": 0, "first_break_s": None}
    assert turns.figures == {"turns": 14, "steps": 14}
    assert (found.strategies.rounds, found.strategies.equal) == (14, 14)


def test_a_link_may_take_over_from_another() -> None:
    """Stern drives past mid from one end of the team to the other, always in range of one."""
    records = by_turns()
    move(records, "stern", [(0.0, 2.75), (10.0, 2.75), (13.0, 0.25), (45.0, 0.25)])
    assert audit(records).violations == ()


def test_a_break_is_told_exactly() -> None:
    """Between samples too: from the instant that the range is left to that of the return."""
    records = by_turns()
    move(records, "stern", [(0.0, 2.75), (10.0, 2.75), (10.9, 3.65), (11.8, 2.75), (45.0, 2.75)])
    assert audit(records).violations == ("not connected from 10.250 s to 11.550 s",)


def test_of_several_breaks_the_first_is_told_with_their_sum() -> None:
    """One at the begin, one in the middle, and one that lasts to the end."""
    records = by_turns()
    ways = [(0.0, 3.5), (1.0, 2.5), (20.0, 2.5), (21.0, 3.5), (22.0, 2.5), (44.0, 2.5)]
    move(records, "stern", [*ways, (45.0, 3.5)])
    found = audit(records)
    assert found.violations == (
        "not connected from 0.000 s to 0.500 s, the first of 3 breaks, 2.000 s together",
    )
    assert found.guarantees[0].figures["connected_s"] == pytest.approx(43.0)


def test_without_odometry_nothing_is_connected() -> None:
    """What isn't recorded isn't kept."""
    records = by_turns()
    records.odometry = [own for own in records.odometry if own.agent != "bow"]
    assert audit(records).violations == (
        "bow: no odometry",
        "not connected from 0.000 s to 45.000 s",
    )
