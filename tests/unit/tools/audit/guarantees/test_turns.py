"""Tests of ``tlcomm_tools.audit.guarantees.turns``: one acts at a time, in a turn of its own."""

from collections.abc import Callable
from dataclasses import replace

import pytest

from support.hand_made_run import task
from support.hand_made_trio import TRIO, by_turns, hold, move, trio_scenario
from tlcomm_core.agent.actions import TaskEventKind
from tlcomm_core.method import Method
from tlcomm_core.records import RunRecords
from tlcomm_core.units import nanoseconds
from tlcomm_tools.audit.findings import audit_run


def violations_of(records: RunRecords) -> list[str]:
    """Return what is wrong with a run that is led by turns."""
    return [*audit_run(trio_scenario(), Method.ALL_TIME, records, nanoseconds(45.0)).violations]


def act_early(records: RunRecords) -> None:
    """Let mid begin its action at 6.5 s before bow has finished its own at 4.5 s."""
    records.tasks = [
        replace(own, stamp_ns=nanoseconds(4.0))
        if (own.stamp_ns, own.event.kind) == (nanoseconds(6.5), TaskEventKind.ACTION_STARTED)
        else own
        for own in records.tasks
    ]


def take_anothers(records: RunRecords) -> None:
    """Let stern do what mid has done in turn 5, at 15.5 s."""
    records.tasks = [
        replace(own, agent="stern") if own.event.round == 5 else own for own in records.tasks
    ]


def go_back(records: RunRecords) -> None:
    """Let mid say that turn 5 was its turn 2."""
    records.tasks = [
        replace(own, event=replace(own.event, round=2)) if own.event.round == 5 else own
        for own in records.tasks
    ]


def visit(records: RunRecords) -> None:
    """Let bow visit a place in turn 5, when mid has done."""
    records.tasks.append(task(17.0, "bow", TaskEventKind.REGION_VISITED, round_=5))


def act_for_ever(records: RunRecords) -> None:
    """Let bow never finish its last action, from 39.5 s on."""
    records.tasks = [own for own in records.tasks if own.stamp_ns != nanoseconds(40.5)]


def lose_a_turn(records: RunRecords) -> None:
    """Let nobody hold turn 4, and stern not turn 6."""
    records.strategies = [
        own
        for own in records.strategies
        if own.strategy.round != 4 and (own.agent, own.strategy.round) != ("stern", 6)
    ]


def lose_the_last(records: RunRecords) -> None:
    """Let the run end while turn 15 is being agreed on."""
    hold(records, 45.0, ["bow"], 15, TRIO, comes_s=47.0)


@pytest.mark.parametrize(
    ("spoil", "violations"),
    [
        (act_early, ["4.000 s: mid acts while bow still does"]),
        (take_anothers, ["15.500 s: stern acts in turn 5, mid's"]),
        (go_back, ["15.500 s: turn 2 comes after turn 4"]),
        (visit, ["17.000 s: bow acts in turn 5, mid's"]),
        (act_for_ever, ["42.500 s: mid acts while bow still does"]),
        (
            lose_a_turn,
            [
                *(f"turn 4: {agent} holds no strategy" for agent in TRIO),
                "turn 6: stern holds no strategy",
            ],
        ),
        (lose_the_last, []),
    ],
    ids=lambda value: getattr(value, "__name__", ""),
)
def test_one_thing_wrong(spoil: Callable[[RunRecords], None], violations: list[str]) -> None:
    """Each kind of breach is named, and nothing else."""
    records = by_turns()
    spoil(records)
    assert violations_of(records) == violations


def test_a_failed_action_is_begun_anew_in_the_same_turn() -> None:
    """It ends with its failure, and what follows is the leader's still."""
    records = by_turns()
    detail = "action=pick attempt=1"
    records.tasks[1:2] = [
        task(4.0, "bow", TaskEventKind.FAULT, action="pick", round_=1, detail=detail),
        task(4.1, "bow", TaskEventKind.ACTION_STARTED, action="pick", round_=1),
        task(5.1, "bow", TaskEventKind.ACTION_FINISHED, action="pick", round_=1),
    ]
    assert violations_of(records) == []


def test_an_action_ends_with_its_failure() -> None:
    """Who gives up holds nobody up."""
    records = by_turns()
    fault = replace(
        records.tasks[1].event, kind=TaskEventKind.FAULT, detail="action=pick attempt=3"
    )
    records.tasks[1] = replace(records.tasks[1], event=fault)
    records.tasks = [own for own in records.tasks if own.agent != "bow" or own.event.round == 1]
    assert violations_of(records) == []


def test_each_has_its_share_of_the_time() -> None:
    """A task may take as many times longer as there are leaders: 90 s here, and no longer."""
    scenario = trio_scenario()
    agents = {
        name: own.model_copy(update={"task": "G F (dock & pick)"})
        for name, own in scenario.agents.items()
    }
    changed = scenario.model_copy(update={"agents": agents})
    for end_s, is_fine in ((89.0, True), (91.0, False)):
        records = by_turns()
        for agent, x_m in (("bow", 1.25), ("mid", 2.0), ("stern", 2.75)):
            move(records, agent, [(0.0, x_m), (end_s, x_m)])
        found = audit_run(changed, Method.ALL_TIME, records, nanoseconds(end_s))
        assert (found.violations == ()) is is_fine


def test_a_turn_may_be_without_a_step() -> None:
    """Who has nothing to do lets its turn pass; the next one's is as it was."""
    records = by_turns()
    records.tasks = [own for own in records.tasks if own.event.round != 5]
    assert violations_of(records) == []
