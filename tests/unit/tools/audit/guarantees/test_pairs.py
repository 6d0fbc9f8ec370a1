"""Tests of ``tlcomm_tools.audit.guarantees.pairs``: pairs that agreed to meet do."""

from collections.abc import Callable

import pytest

from support.hand_made_trio import by_pairs, hold, move, trio_scenario
from tlcomm_core.method import Method
from tlcomm_core.records import RunRecords
from tlcomm_core.units import nanoseconds
from tlcomm_tools.audit.findings import Audit, audit_run


def audit(records: RunRecords, end_s: float = 45.0) -> Audit:
    """Audit records of pairs."""
    return audit_run(trio_scenario(), Method.PAIRWISE, records, nanoseconds(end_s))


def test_a_good_run_keeps_both_promises() -> None:
    """Pairs meet by the poses, in a schedule; that the whole team never does is no violation."""
    found = audit(by_pairs())
    assert found.violations == ()
    meetings, schedule = found.guarantees
    # Mid leaves bow at 13 s and comes to it again at 24 s; from 1.25 m it is in range at 23.75 s.
    assert meetings.figures["shortest_s"] == pytest.approx(3.25)
    assert (meetings.figures["meetings"], meetings.figures["meetings_kept"]) == (4, 4)
    assert schedule.figures == {"pairs": 2, "cycle_windows": 2}
    assert (found.strategies.rounds, found.strategies.equal) == (6, 6)
    assert [own.satisfied for own in found.windows] == [False] * 4


def test_a_window_that_the_run_ends_in_is_owed_by_nobody() -> None:
    """Neither the meeting that was under way, nor those agreed on for later."""
    records = by_pairs()
    for entries in (records.odometry, records.tasks, records.strategies):
        entries[:] = [entry for entry in entries if entry.stamp_ns <= nanoseconds(41.0)]
    found = audit(records, 41.0)
    assert found.violations == ()
    assert found.guarantees[0].figures["meetings"] == 3


def stay_away(records: RunRecords) -> None:
    """Let mid be late for bow in window 3."""
    ways = [(0.0, 2.0), (13.0, 2.0), (14.0, 3.0), (31.5, 3.0), (32.5, 2.0), (33.0, 2.0)]
    move(records, "mid", [*ways, (34.0, 3.0), (45.0, 3.0)])


def lose(records: RunRecords, agent: str, window: int) -> None:
    """Let an agent not hold the strategy of a window."""
    records.strategies = [
        own for own in records.strategies if (own.agent, own.strategy.round) != (agent, window)
    ]


def lose_one(records: RunRecords) -> None:
    """Let bow not hold what mid does for window 3."""
    lose(records, "bow", 3)


def lose_the_last(records: RunRecords) -> None:
    """Let bow not hold what mid does for window 5, where the run ends before they part."""
    lose(records, "bow", 5)
    records.tasks = [own for own in records.tasks if own.stamp_ns < nanoseconds(31.0)]


def differ(records: RunRecords) -> None:
    """Let stern hold another strategy than mid for window 2."""
    lose(records, "stern", 2)
    hold(records, 0.5, ["stern"], 2, ["mid", "stern"], extra_s=0.5)


def join(records: RunRecords) -> None:
    """Let stern hold what bow and mid have agreed on for window 3."""
    hold(records, 11.0, ["stern"], 3, ["bow", "mid"])


def be_three(records: RunRecords) -> None:
    """Let all three agree on window 4."""
    hold(records, 11.0, ["bow", "mid", "stern"], 4, ["bow", "mid", "stern"])


@pytest.mark.parametrize(
    ("spoil", "violations"),
    [
        (
            stay_away,
            ["window 3: bow and mid are in range of each other for 1.000 s, not 2 s"],
        ),
        (lose_one, ["window 3, bow and mid: bow holds no strategy"]),
        (lose_the_last, []),
        (differ, ["window 2, mid and stern: stern holds another strategy than mid"]),
        (join, ["window 3, bow and mid: stern holds a strategy, but isn't one of them"]),
        (
            be_three,
            ["window 4: strategies of ['bow', 'mid', 'stern'], not of two agents"],
        ),
    ],
    ids=lambda value: getattr(value, "__name__", ""),
)
def test_one_thing_wrong(spoil: Callable[[RunRecords], None], violations: list[str]) -> None:
    """Each kind of breach is named, and nothing else."""
    records = by_pairs()
    spoil(records)
    assert list(audit(records).violations) == violations
