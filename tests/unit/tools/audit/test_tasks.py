"""Tests of ``tlcomm_tools.audit.tasks``: what becomes of a run's tasks."""

import pytest

from support.hand_made_run import END_S, hand_made_records, hand_made_scenario, task
from tlcomm_core.agent.actions import TaskEventKind
from tlcomm_core.method import Method
from tlcomm_core.records import RunRecords
from tlcomm_core.units import nanoseconds
from tlcomm_tools.audit.findings import Audit, audit_run


def audit_with(records: RunRecords, **changes: object) -> Audit:
    """Audit a run as if west, which picked at 5 s and at 15 s, had had another task."""
    scenario = hand_made_scenario()
    agent = scenario.agents["west"].model_copy(update=changes)
    changed = scenario.model_copy(update={"agents": {**scenario.agents, "west": agent}})
    return audit_run(changed, Method.TEAM, records, nanoseconds(END_S))


def without_claims() -> RunRecords:
    """Return the run's records without what west said of its task."""
    records = hand_made_records()
    records.tasks = [
        own
        for own in records.tasks
        if (own.agent, own.event.kind) != ("west", TaskEventKind.TASK_SATISFIED)
    ]
    return records


def test_other_forms_are_counted_by_their_automaton() -> None:
    """Where only one run is possible its accepting transitions are the satisfactions."""
    formula = "G F (left & pick) & G !right"
    records = hand_made_records()
    found = audit_with(records, task=formula)
    assert found.violations == ()
    assert found.document()["tasks"]["west"] == {
        "claimed": 2,
        "satisfied": 2,
        "longest_gap_s": None,
        "verdict": "kept",
        "settled_s": None,
    }
    records.tasks.append(task(24.0, "west", TaskEventKind.TASK_SATISFIED))
    assert audit_with(records, task=formula).violations == (
        "west: task claimed satisfied 3 times, by its steps it was 2 times",
    )


@pytest.mark.parametrize(
    ("formula", "verdict", "settled_s"),
    [
        ("F (left & pick)", "fulfilled", 5.0),
        ("F (left & X left)", "fulfilled", 15.0),
        ("F G left", "kept", None),
        ("F right", "pending", None),
        ("G F left & G F right", "pending", None),
        ("G (pick -> X !pick)", "violated", 15.0),
        ("G !left", "violated", 5.0),
        ("left | right", "violated", 0.0),
        ("G F left & F G !left & G pick", "violated", 0.0),
    ],
)
def test_every_task_has_a_verdict(formula: str, verdict: str, settled_s: float | None) -> None:
    """Each of the four, with the time at which it became final, and failing if violated."""
    found = audit_with(without_claims(), task=formula)
    own = found.tasks[1]
    assert (own.verdict, own.settled_s) == (verdict, pytest.approx(settled_s))
    of_verdict = [line for line in found.violations if "violated" in line]
    assert len(of_verdict) == (verdict == "violated")


def test_a_violation_says_who_when_and_by_what() -> None:
    """The line has the agent, the time, and what was true."""
    assert audit_with(without_claims(), task="G (left -> !pick)").violations == (
        "west: task violated at 5.000 s; what was true then: {left, pick}",
    )
    assert audit_with(without_claims(), task="F pick & G !pick").violations == (
        "west: task violated at 0.000 s; nothing satisfies it",
    )


AUTOMATON = """HOA: v1 Start: 0 AP: 2 "left" "pick" Acceptance: 1 Inf(0) --BODY--
State: 0 {} --END--"""


@pytest.mark.parametrize(
    ("edges", "verdict", "settled_s", "satisfied"),
    [
        ("[!0] 0 [0&!1] 0 [0&1] 0 {0}", "kept", None, 2),
        ("[!0] 0 [0&!1] 0 {0} [0&1] 0", "pending", None, 0),
        ("[!0] 0 {0} [0] 1 {0} State: 1 [!0] 1 {0}", "violated", 15.0, 1),
        ("[!0] 0 [0] 1 {0} State: 1 [t] 1 {0}", "fulfilled", 5.0, 2),
        ("[t] 0 [0] 1 State: 1 [0] 1 {0}", None, None, None),
    ],
)
def test_an_automaton_is_followed(
    edges: str, verdict: str | None, settled_s: float | None, satisfied: int | None
) -> None:
    """A given automaton has the same verdicts, and none where several runs leave it open."""
    found = audit_with(without_claims(), task=None, automaton=AUTOMATON.format(edges))
    own = found.tasks[1]
    assert (own.verdict, own.satisfied) == (verdict, satisfied)
    assert own.settled_s == pytest.approx(settled_s)


def test_only_what_the_events_say_is_judged() -> None:
    """Without west's steps its task is pending, though it stood at its region."""
    records = without_claims()
    records.tasks = [
        own
        for own in records.tasks
        if own.agent != "west" or own.event.kind is not TaskEventKind.ACTION_FINISHED
    ]
    assert audit_with(records, task="F left").tasks[1].verdict == "pending"


def test_a_task_with_an_intractable_negation_has_a_verdict() -> None:
    """The task's own automaton tells violations; what several runs leave open isn't told."""
    names = [f"a{number}" for number in range(13)]
    free = " | ".join(f"G !{name}" for name in names)
    violated = audit_with(without_claims(), task=f"({free}) & G !left")
    assert violated.tasks[1].verdict == "violated"
    own = audit_with(without_claims(), task=free).tasks[1]
    assert (own.verdict, own.satisfied, own.settled_s) == (None, None, None)


def test_a_visit_is_a_step_of_the_word() -> None:
    """A region that was visited without acting counts where the task asks for no more."""
    formula = "G F (left & F (left & !pick))"
    records = hand_made_records()
    assert audit_with(records, task=formula).tasks[1].satisfied == 0
    picked = next(r for r in records.tasks if r.event.kind is TaskEventKind.ACTION_FINISHED)
    visit = task(
        picked.stamp_ns * 1e-9, "west", TaskEventKind.REGION_VISITED, region="left", plan_index=1
    )
    records.tasks.insert(records.tasks.index(picked) + 1, visit)
    assert audit_with(records, task=formula).tasks[1].satisfied == 1


def test_claims_count_until_a_plan_begins_anew() -> None:
    """What another plan for the same task satisfies isn't what all steps do; the verdict stays."""
    records = hand_made_records()
    records.tasks.append(task(24.0, "west", TaskEventKind.TASK_SATISFIED))
    assert any("claimed satisfied" in line for line in audit_with(records).violations)
    records.tasks.insert(-1, task(23.5, "west", TaskEventKind.PLAN_CHANGED))
    found = audit_with(records)
    assert found.violations == ()
    assert found.tasks[1].verdict is not None
