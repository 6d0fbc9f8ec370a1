"""The search that makes edges as it goes against the one over the whole product."""

from fractions import Fraction

import numpy as np
import pytest

from tlcomm_core.errors import IntractableTaskError, UnreachableTaskError
from tlcomm_core.geometry import Pose
from tlcomm_core.ltl import BuchiAutomaton, Construction, Cube, Formula, Guard, Transition, parse
from tlcomm_core.planning import on_the_fly, product_rows, synthesis
from tlcomm_core.planning.lasso import Lasso, Objective, optimal_lasso
from tlcomm_core.planning.on_the_fly import essential_part
from tlcomm_core.planning.product import Product, build
from tlcomm_core.planning.transition_system import State, TransitionSystem

LABELS = (frozenset[str](), frozenset("a"), frozenset("b"), frozenset("ab"))
GAMMAS = [None, Fraction(1, 3), Fraction(7)]


def random_system(rng: np.random.Generator, most_s: int = 3) -> TransitionSystem:
    """Return up to eight states; steps of no time lead to higher numbers only."""
    size = int(rng.integers(2, 9))
    count = int(rng.integers(size, 4 * size))
    source = np.sort(rng.integers(0, size, count))
    target = rng.integers(0, size, count)
    drive_s = rng.integers(0, most_s + 1, count).astype(np.float64)
    drive_s[source >= target] += 1.0
    return TransitionSystem(
        states=tuple(State(number, Pose(0.0, 0.0, 0.0)) for number in range(size)),
        regions=dict.fromkeys(range(size), ()),
        actions=(None,),
        labels=LABELS,
        initial_label=0,
        source=source,
        target=target,
        action=np.zeros_like(source),
        label=rng.integers(0, len(LABELS), count),
        drive_s=drive_s,
        drive_m=drive_s,
        stay_s=np.zeros(count),
    )


def random_automaton(rng: np.random.Generator) -> BuchiAutomaton:
    """Return up to four states, with several runs on a word or none."""
    size = int(rng.integers(1, 5))
    cubes = (
        Cube(frozenset(), frozenset()),
        Cube(frozenset("a"), frozenset()),
        Cube(frozenset("b"), frozenset("a")),
        Cube(frozenset(), frozenset("b")),
    )

    def edge() -> Transition:
        guard = Guard((cubes[rng.integers(len(cubes))],))
        return Transition(guard, int(rng.integers(size)), bool(rng.random() < 0.3))

    rows = tuple(tuple(edge() for _ in range(rng.integers(1, 5))) for _ in range(size))
    return BuchiAutomaton(("a", "b"), 0, rows, Construction.GIVEN)


def cost(product: Product, lasso: Lasso | None, gamma: Fraction | None) -> tuple[object, ...]:
    """Return what is to be least, then the steps to the first satisfaction and in the suffix."""
    if lasso is None:
        return ()
    until = product.accepting[list(lasso.suffix)].argmax() + 1
    first = [*lasso.prefix, *lasso.suffix[:until]]
    times_ns = product.time_ns
    suffix_ns, first_ns = int(times_ns[list(lasso.suffix)].sum()), int(times_ns[first].sum())
    steps = len(first) + len(lasso.suffix)
    return (*Objective(gamma).key(first_ns, suffix_ns), steps)


@pytest.mark.parametrize("gamma", GAMMAS)
@pytest.mark.parametrize("most_at_once", [1, 300_000])
def test_costs_equal_the_whole_products(
    gamma: Fraction | None, most_at_once: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    """By either objective, then by steps, however many edges are in memory at a time."""
    monkeypatch.setattr(product_rows, "_MOST_AT_ONCE", most_at_once)
    found = 0
    for seed in range(300):
        rng = np.random.default_rng(seed)
        system, automaton = random_system(rng), random_automaton(rng)
        whole = build(system, automaton)
        part = essential_part(system, automaton, Objective(gamma))
        product = build(part, automaton)
        expected = cost(whole, optimal_lasso(whole, Objective(gamma)), gamma)
        assert cost(product, optimal_lasso(product, Objective(gamma)), gamma) == expected, seed
        assert len(part.source) <= len(system.source)
        found += bool(expected)
    assert 50 < found < 290


def test_only_steps_of_optimal_lassos_are_left() -> None:
    """The part has no more steps than its lasso, where only one is optimal."""
    rng = np.random.default_rng(1)
    systems = [random_system(rng, most_s=1000) for _ in range(50)]
    automaton = random_automaton(np.random.default_rng(0))
    for system in systems:
        part = essential_part(system, automaton, Objective())
        product = build(part, automaton)
        lasso = optimal_lasso(product, Objective())
        taken = set() if lasso is None else {*lasso.prefix, *lasso.suffix}
        assert len(part.source) == len({int(product.step[edge]) for edge in taken})


def test_plans_are_the_same(monkeypatch: pytest.MonkeyPatch) -> None:
    """A plan made without the whole product has the same times, and errors the same words."""
    formulas = [parse(text) for text in ("G F a & G F b", "F G a", "a U b", "G !a & G F b")]
    rng = np.random.default_rng(3)
    for system in [random_system(rng) for _ in range(20)]:
        for formula in formulas:
            monkeypatch.setattr(on_the_fly, "MOST_HELD", 10**6)
            whole = outcome(formula, system)
            monkeypatch.setattr(on_the_fly, "MOST_HELD", 0)
            assert outcome(formula, system) == whole


def outcome(formula: Formula, system: TransitionSystem) -> object:
    """Return a plan's times, or why there is none."""
    try:
        plan = synthesis.plan_task(formula, system)
    except UnreachableTaskError as error:
        return str(error)
    return plan.suffix_s, plan.first_s, len(plan.prefix), len(plan.suffix)


def test_limits_are_told(monkeypatch: pytest.MonkeyPatch) -> None:
    """Too many states, and too much to read, are refused with what to do."""
    rng = np.random.default_rng(0)
    system, automaton = random_system(rng), random_automaton(rng)
    monkeypatch.setattr(on_the_fly, "MOST_READ", 3)
    with pytest.raises(IntractableTaskError, match=r"reads more than 3 edges .*; split the task"):
        essential_part(system, automaton, Objective())
    monkeypatch.setattr(on_the_fly, "MOST_STATES", 3)
    with pytest.raises(IntractableTaskError, match="is larger than 3; split the task"):
        essential_part(system, automaton, Objective())
