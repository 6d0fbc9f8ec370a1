"""A soft task beside a hard one: what it costs, and when it is paid."""

import pytest

from support.small_plant import SmallPlant
from tlcomm_core.errors import (
    IntractableTaskError,
    LocalMisuseError,
    UnreachableTaskError,
    UnsatisfiableTaskError,
)
from tlcomm_core.ltl import parse, translate
from tlcomm_core.planning.plan import LocalPlan
from tlcomm_core.planning.relaxation import Relaxed, Strict, soft_task
from tlcomm_core.planning.synthesis import plan_task

SYSTEM = SmallPlant().system()
TASK = "G F (p & collect)"


def plan(soft: str, weight_s: float, task: str = TASK) -> LocalPlan:
    """Return the plan for a task with a soft one."""
    return plan_task(parse(task), SYSTEM, soft=soft_task(parse(soft), weight_s))


def test_a_soft_task_is_satisfied_where_that_is_cheaper_than_its_price() -> None:
    """A detour is taken exactly if it takes less than the violation costs."""
    alone_s = plan_task(parse(TASK), SYSTEM).suffix_s
    both_s = plan_task(parse(f"{TASK} & G F r"), SYSTEM).suffix_s
    detour_s = both_s - alone_s
    assert detour_s > 1.0
    for weight_s, violation, suffix_s in (
        (detour_s - 0.01, 1, alone_s),
        (detour_s + 0.01, 0, both_s),
    ):
        found = plan("G F r", weight_s)
        assert (found.suffix_violation, found.prefix_violation) == (violation, 0)
        assert found.suffix_s == pytest.approx(suffix_s)
        assert found.suffix_price_s == violation * weight_s


def test_a_violation_is_told_where_it_is() -> None:
    """The steps on which the soft task is violated say what it wanted."""
    found = plan("G !p", 2.0)
    assert all(step.wanted == (("!p",) if "p" in step.label else ()) for step in found.suffix)
    assert found.suffix_price_s == 2.0 * found.suffix_violation > 0.0


def test_the_first_letter_has_its_price() -> None:
    """What is wrong at the start is counted once."""
    found = plan("r & unload & !p", 1.5)
    assert found.initial_wanted == ("r", "unload")
    assert (found.prefix_violation, found.suffix_violation) == (2, 0)
    assert found.prefix_price_s == 3.0


def test_the_nearest_cube_of_a_guard_counts() -> None:
    """Of two ways to be satisfied, the one with fewer changes is missed."""
    assert plan("p & r & m | hall", 1.0).initial_wanted == ("hall",)


def test_a_soft_task_never_costs_the_hard_one() -> None:
    """However large the weight, what contradicts the task is paid for, and the task is done."""
    found = plan("G !collect", 1e5)
    assert any(step.satisfies and step.action == "collect" for step in found.suffix)
    assert found.suffix_violation == 1
    assert plan("G !(p & collect) & G F r", 1e5).suffix_violation == 1


def test_an_impossible_task_stays_impossible() -> None:
    """A soft task makes no plan for a hard one that has none."""
    with pytest.raises(UnreachableTaskError):
        plan("G F r", 1.0, "G F vault")


def test_a_soft_task_needs_a_word_and_a_price() -> None:
    """One that nothing satisfies is refused; one that costs nothing is none."""
    with pytest.raises(UnsatisfiableTaskError, match="soft task 'G !p & F p' contradicts itself"):
        soft_task(parse("G !p & F p"), 1.0)
    assert soft_task(parse("false"), 0.0) is None
    with pytest.raises(LocalMisuseError, match=r"-1\.0"):
        soft_task(parse("p"), -1.0)


def test_a_product_that_is_too_large_is_refused() -> None:
    """The message gives the sizes; the same task without a soft one is planned."""
    many = SmallPlant().system(actions={f"a{number}": 1.0 for number in range(400)})
    soft = soft_task(parse(" & ".join(f"F a{number}" for number in range(8))), 1.0)
    task = parse("G F (p & a1)")
    with pytest.raises(IntractableTaskError, match=r"256 of the soft task's .* too large"):
        plan_task(task, many, soft=soft)
    assert plan_task(task, many).suffix


def test_without_a_soft_task_nothing_is_priced() -> None:
    """The plan says that there is no weight, and every step wants nothing."""
    found = plan_task(parse(TASK), SYSTEM)
    assert found.weight_s is None
    assert found.prefix_price_s == found.suffix_price_s == 0.0
    assert not any(step.wanted for step in (*found.prefix, *found.suffix))


def test_the_prefix_is_no_longer_than_the_run_needs() -> None:
    """The run is told from where its steps repeat, wherever the soft automaton's turn is over."""
    found = plan("G F collect", 0.5, "G F (p & collect & F (r & unload))")
    assert len(found.prefix) == 1


def test_a_strict_reader_has_the_automatons_transitions() -> None:
    """Each is accepting exactly if it satisfies, and wants nothing."""
    automaton = translate(parse("G F (p & F r)"))
    strict = Strict(automaton)
    for state in range(automaton.state_count):
        for label in (frozenset(), frozenset("p"), frozenset("pr")):
            moves = list(strict.moves(state, label))
            assert [move[:2] for move in moves] == list(automaton.successors(state, label))
            assert all(move.accepting == move.satisfies for move in moves)
            assert not any(move.wanted for move in moves)


def test_a_relaxed_reader_waits_for_the_soft_task_after_accepting() -> None:
    """The task's acceptance alone leads to waiting, in which it is not enough any more."""
    relaxed = Relaxed(translate(parse("G F p")), translate(parse("G F r")))
    p, r, both = frozenset("p"), frozenset("r"), frozenset("pr")

    def after(state: int, label: frozenset[str]) -> dict[bool, int]:
        free = [move for move in relaxed.moves(state, label) if not move.wanted]
        return {move.accepting: move.target for move in free}

    waiting = after(relaxed.initial, p)[True]
    assert after(waiting, p) == {False: waiting}
    assert after(waiting, r) == {False: relaxed.initial}
    assert after(relaxed.initial, both) == {True: relaxed.initial}
    assert after(relaxed.initial, frozenset()) == {False: relaxed.initial}
