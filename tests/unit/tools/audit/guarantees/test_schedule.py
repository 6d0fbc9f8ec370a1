"""Tests of ``tlcomm_tools.audit.guarantees.schedule``: every pair meets again and again."""

from collections.abc import Mapping, Sequence

import pytest

from support.hand_made_trio import hold, trio_scenario
from tlcomm_core.records import RunRecords
from tlcomm_core.scenario.model import Scenario
from tlcomm_tools.audit.evidence import Evidence
from tlcomm_tools.audit.guarantees.guarantee import Guarantee
from tlcomm_tools.audit.guarantees.schedule import keep_schedule

Agreed = Mapping[tuple[str, str], Sequence[int]]
FRONT, BACK, ENDS = ("bow", "mid"), ("mid", "stern"), ("bow", "stern")


def judge(agreed: Agreed, end_s: float = 65.0, scenario: Scenario | None = None) -> Guarantee:
    """Judge the schedule of what pairs have agreed on; six windows are complete."""
    records = RunRecords()
    for pair, windows in agreed.items():
        for window in windows:
            hold(records, 0.0, pair, window, pair)
    return keep_schedule(Evidence.gather(scenario or trio_scenario(), records, end_s))


@pytest.mark.parametrize(
    "agreed",
    [
        {FRONT: (1, 3, 5), BACK: (2, 4)},
        {FRONT: (1, 3, 5, 7), BACK: (2, 4, 6)},
        {FRONT: (0, 3), BACK: (1, 4), ENDS: (2, 5)},
    ],
)
def test_a_regular_schedule_is_kept(agreed: Agreed) -> None:
    """From whichever window on, and however far it is agreed on."""
    assert judge(agreed).violations == ()


@pytest.mark.parametrize(
    ("agreed", "end_s"),
    [({}, 19.0), ({FRONT: (1,)}, 19.0), ({FRONT: (1, 3)}, 25.0), ({FRONT: (1,), BACK: (2,)}, 30.0)],
)
def test_a_short_run_owes_only_what_it_had_time_for(agreed: Agreed, end_s: float) -> None:
    """Before the end of a cycle, not all pairs need have met, nor any again."""
    assert judge(agreed, end_s).violations == ()


def test_the_cycle_is_found() -> None:
    """It is what most pairs take to meet again; unknown where none does."""
    assert judge({FRONT: (1, 3, 5), BACK: (2, 6)}).figures["cycle_windows"] == 2
    assert judge({FRONT: (1,), BACK: (2,)}, 29.0).figures["cycle_windows"] is None


@pytest.mark.parametrize(
    ("agreed", "violations"),
    [
        (
            {FRONT: (1, 3, 5), BACK: (2,)},
            ["window 4: mid and stern aren't to meet, though due every 2 windows from 2 on"],
        ),
        (
            {FRONT: (1, 3, 5), BACK: (2, 4), ENDS: (2, 3, 4)},
            [
                "window 2: stern is to meet bow and mid",
                "window 3: bow is to meet mid and stern",
                "window 4: stern is to meet bow and mid",
                "window 3: bow and stern are to meet out of turn, every 2 windows from 2 on",
            ],
        ),
        (
            {FRONT: (1, 3, 5), BACK: (4,)},
            ["window 4: mid and stern are to meet for the first time, after a whole cycle"],
        ),
        ({FRONT: (1, 2, 3, 4, 5)}, ["stern: in no pair"]),
        ({}, ["bow, mid, stern: in no pair"]),
        (
            {FRONT: (1,), BACK: (2,)},
            [
                "window 3: bow and mid aren't to meet, though due every 2 windows from 1 on",
                "window 5: bow and mid aren't to meet, though due every 2 windows from 1 on",
                "window 4: mid and stern aren't to meet, though due every 2 windows from 2 on",
            ],
        ),
    ],
    ids=["missing", "double and out of turn", "late", "no partner", "nobody", "never again"],
)
def test_each_flaw_is_named(agreed: Agreed, violations: list[str]) -> None:
    """Window by window and pair by pair, and nothing else."""
    assert list(judge(agreed).violations) == violations


def test_two_halves_are_no_team() -> None:
    """Everybody meets somebody, and still nothing gets from one half to the other."""
    trio = trio_scenario()
    agents = {"aft": trio.agents["stern"], **trio.agents}
    found = judge(
        {FRONT: (1, 2, 3, 4, 5), ("aft", "stern"): (1, 2, 3, 4, 5)},
        scenario=trio.model_copy(update={"agents": agents}),
    )
    assert found.violations == ("the 2 pairs don't link the whole team",)
