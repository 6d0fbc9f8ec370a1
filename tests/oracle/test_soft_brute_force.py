"""Plans with a soft task against all cycles of tiny relaxed products, built by definition."""

from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from functools import cache
from itertools import chain, combinations
from itertools import product as pairs

import numpy as np
import pytest

from support.lasso_semantics import holds
from tlcomm_core.errors import PlanningError
from tlcomm_core.geometry import Pose
from tlcomm_core.ltl import BuchiAutomaton, Guard, parse, translate
from tlcomm_core.planning.lasso import Lasso, Objective, optimal_lasso
from tlcomm_core.planning.plan import PlanStep
from tlcomm_core.planning.product import Product, build
from tlcomm_core.planning.relaxation import SoftTask, soft_task
from tlcomm_core.planning.synthesis import plan_task
from tlcomm_core.planning.transition_system import State, TransitionSystem

Label = frozenset[str]

HARD = ["G F a", "G F (a & F b)", "F G !c & G F b", "G F a & G F b", "a U (b & X !b) | G c", "G !b"]
SOFT = [
    "G F c",
    "G F (b & X c)",
    "G !a",
    "F G b",
    "G (a -> X !a) & G F c",
    "G (a <-> X b)",
    "a & X (b & X c)",
    "G F (a & c & F b)",
    "(a & b & c) | X G !b",
]
LETTERS = [frozenset(s) for s in chain(*(combinations("abc", n) for n in range(4)))]
SEEDS = range(500)


def random_system(seed: int) -> TransitionSystem:
    """Return up to five states with random labels and times, each with a way on."""
    rng = np.random.default_rng(seed)
    size = int(rng.integers(2, 6))
    count = int(rng.integers(size, 3 * size))
    source = np.sort(np.append(np.arange(size), rng.integers(0, size, count)))
    target = rng.integers(0, size, len(source))
    labels = tuple(LETTERS[int(number)] for number in rng.integers(0, len(LETTERS), size))
    return TransitionSystem(
        states=tuple(State(state, Pose(float(state), 0.0, 0.0)) for state in range(size)),
        regions={state: tuple(sorted(labels[state])) for state in range(size)},
        actions=(None,),
        labels=labels,
        initial_label=0,
        source=source,
        target=target,
        action=np.zeros_like(source),
        label=target,
        drive_s=rng.integers(1, 6, len(source)).astype(np.float64),
        drive_m=np.zeros(len(source)),
        stay_s=np.zeros(len(source)),
    )


def problem(seed: int) -> tuple[TransitionSystem, str, str, float]:
    """Return a system, a task, a soft task and its weight."""
    rng = np.random.default_rng(seed)
    hard, soft = HARD[seed % len(HARD)], str(rng.choice(SOFT))
    return random_system(seed), hard, soft, float(rng.choice([0.5, 1.0, 3.0, 1000.0]))


@cache
def automaton(text: str) -> BuchiAutomaton:
    """Return a formula's automaton."""
    return translate(parse(text))


def distance(guard: Guard, label: Label) -> int:
    """Return how many atoms of a letter differ at least from one that passes a guard."""
    return min(len(label ^ letter) for letter in LETTERS if guard.holds(letter))


@dataclass(frozen=True)
class Relaxation:
    """All pairs of moves.

    Attributes:
        size: number of pairs of automata's states with a state of the system.
        initial: price of the first letter by state.
        edges: source, target, cost, and whether the task and the soft task accept.
    """

    size: int
    initial: dict[int, float]
    edges: list[tuple[int, int, float, bool, bool]]

    def lassos(self) -> Iterator[tuple[float, float]]:
        """Yield first satisfaction and cycle of the best lasso by what accepts on its cycle."""
        between = np.full((self.size, self.size), np.inf)
        np.fill_diagonal(between, 0.0)
        for source, target, cost, *_ in self.edges:
            between[source, target] = min(between[source, target], cost)
        for middle in range(self.size):
            np.minimum(between, between[:, [middle]] + between[[middle]], out=between)
        entry = np.min([cost + between[state] for state, cost in self.initial.items()], axis=0)
        for one, other in pairs(self.edges, self.edges):
            if one[3] and other[4]:
                cycle = one[2] + between[one[1], one[0]]
                if one is not other:
                    there, back = between[one[1], other[0]], between[other[1], one[0]]
                    cycle = one[2] + there + other[2] + back
                yield entry[one[0]] + one[2], cycle

    def best_key(self, gamma: Fraction | None) -> tuple[float, ...]:
        """Return the best value of the objective."""
        lassos = self.lassos() if self.initial else iter(())
        keys = [
            (cycle, first) if gamma is None else (first + float(gamma) * cycle,)
            for first, cycle in lassos
            if first + cycle < np.inf
        ]
        return min(keys, default=(np.inf,))


def relaxation(
    system: TransitionSystem, hard: BuchiAutomaton, soft: BuchiAutomaton, weight_s: float
) -> Relaxation:
    """Return the relaxed product by its definition, every letter tried for every guard."""
    counts = len(system.states), hard.state_count, soft.state_count

    def moves(h: int, q: int, label: Label) -> list[tuple[int, int, bool, bool, float]]:
        return [
            (one.target, other.target, one.accepting, other.accepting, price)
            for one in hard.transitions[h]
            if one.guard.holds(label)
            for other in soft.transitions[q]
            for price in [weight_s * distance(other.guard, label)]
        ]

    def number(s: int, h: int, q: int) -> int:
        return int(np.ravel_multi_index((s, h, q), counts))

    initial: dict[int, float] = {}
    for h, q, _, _, price in moves(hard.initial, soft.initial, system.labels[0]):
        state = number(0, h, q)
        initial[state] = min(price, initial.get(state, np.inf))
    edges = [
        (number(s, h, q), number(t, *ends), time + price, is_hard, is_soft)
        for s, t, time in zip(
            system.source.tolist(), system.target.tolist(), system.time_s.tolist(), strict=True
        )
        for h, q in np.ndindex(*counts[1:])
        for *ends, is_hard, is_soft, price in moves(h, q, system.labels[t])
    ]
    return Relaxation(int(np.prod(counts)), initial, edges)


@pytest.mark.parametrize("seed", SEEDS)
def test_no_run_is_better(seed: int) -> None:
    """Time and price are the least of all lassos, in whatever order task and soft task accept."""
    system, hard_text, soft_text, weight_s = problem(seed)
    hard, soft = automaton(hard_text), automaton(soft_text)
    expected = relaxation(system, hard, soft, weight_s)
    relaxed = build(system, hard, SoftTask(soft, weight_s))
    for gamma in (None, Fraction(1, 3), Fraction(7)):
        lasso = optimal_lasso(relaxed, Objective(gamma))
        key = (np.inf,) if lasso is None else key_of(relaxed, lasso, gamma)
        assert key == pytest.approx(expected.best_key(gamma), abs=1e-6)


def key_of(product: Product, lasso: Lasso, gamma: Fraction | None) -> tuple[float, ...]:
    """Return a lasso's value of the objective, in s."""
    suffix = list(lasso.suffix)
    satisfies = [product.reading.moves[move].satisfies for move in product.reading.edge[suffix]]
    first = [*lasso.prefix, *suffix[: satisfies.index(True) + 1]]
    entry_ns = product.initial_ns[product.initial == product.source[first[0]]].sum()
    cycle_s = product.time_ns[suffix].sum() * 1e-9
    first_s = (product.time_ns[first].sum() + entry_ns) * 1e-9
    return (cycle_s, first_s) if gamma is None else (first_s + float(gamma) * cycle_s,)


def corrected(label: Label, wanted: tuple[str, ...]) -> Label:
    """Return a letter in which what was wanted is true."""
    return (label | {name for name in wanted if name[0] != "!"}) - {name[1:] for name in wanted}


@pytest.mark.parametrize("seed", SEEDS)
def test_a_plan_says_what_it_violates(seed: int) -> None:
    """Its word satisfies the task; with what was wanted put right, the soft task as well."""
    system, hard, text, weight_s = problem(seed)
    try:
        plan = plan_task(parse(hard), system, soft=soft_task(parse(text), weight_s))
    except PlanningError:
        assert optimal_lasso(build(system, automaton(hard))) is None
        return
    stem, loop = plan.word
    assert holds(parse(hard), list(stem), list(loop))

    def right(steps: tuple[PlanStep, ...]) -> list[Label]:
        return [corrected(step.label, step.wanted) for step in steps]

    start = corrected(plan.initial_label, plan.initial_wanted)
    assert holds(parse(text), [start, *right(plan.prefix)], right(plan.suffix))
    changed = [step for step in (*plan.prefix, *plan.suffix) if step.wanted]
    assert all(
        len(step.label ^ corrected(step.label, step.wanted)) == len(step.wanted) for step in changed
    )
    assert plan.prefix_price_s == plan.prefix_violation * weight_s
    assert any(step.satisfies for step in plan.suffix)


def test_the_random_problems_cover_the_cases() -> None:
    """Among them are plans that violate nothing, in the prefix alone, and in the suffix."""
    plans = []
    for seed in SEEDS:
        system, hard, text, weight_s = problem(seed)
        if optimal_lasso(build(system, automaton(hard))) is not None:
            soft = SoftTask(automaton(text), weight_s)
            plans.append(plan_task(parse(hard), system, soft=soft))
    assert 100 < len(plans) < 490
    assert sum(plan.prefix_violation + plan.suffix_violation == 0 for plan in plans) > 20
    assert sum(plan.suffix_violation == 0 < plan.prefix_violation for plan in plans) > 5
    assert sum(plan.suffix_violation > 0 for plan in plans) > 50
