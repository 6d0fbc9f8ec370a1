"""Rivals of the optimal plan against all simple cycles of tiny products."""

from collections.abc import Iterator

import pytest

from support.random_system import PLACES, random_system
from tlcomm_core.ltl import Formula, parse, translate
from tlcomm_core.planning import product as products
from tlcomm_core.planning.explanation import Move, Rival, explain_plan
from tlcomm_core.planning.lasso import optimal_lasso
from tlcomm_core.planning.product import Product
from tlcomm_core.planning.transition_system import TransitionSystem

TASKS = ["G F (a & F b)", "G F a & G F b", "G F (a & w)", "F G !a", "F a & G F b", "G F a | G F b"]


def simple_cycles(product: Product) -> Iterator[list[int]]:
    """Yield the edges of every cycle that meets no state twice, from its lowest state on."""
    source, target = product.source.tolist(), product.target.tolist()

    def extend(start: int, states: list[int], edges: list[int]) -> Iterator[list[int]]:
        later = set(range(start + 1, product.size))
        for edge in range(len(source)):
            if source[edge] == states[-1] and target[edge] == start:
                yield [*edges, edge]
            elif source[edge] == states[-1] and target[edge] in later - {*states}:
                yield from extend(start, [*states, target[edge]], [*edges, edge])

    for start in range(product.size):
        yield from extend(start, [start], [])


def times_to_states(product: Product) -> list[int]:
    """Return the least time to each state, by relaxing every edge again and again."""
    far = 10**15
    times_ns = [0 if state in product.initial else far for state in range(product.size)]
    edges = list(
        zip(product.source.tolist(), product.target.tolist(), product.time_ns.tolist(), strict=True)
    )
    for _ in range(product.size):
        for source, target, time_ns in edges:
            times_ns[target] = min(times_ns[target], times_ns[source] + time_ns)
    return times_ns


def move(product: Product, system: TransitionSystem, edge: int) -> Move:
    """Return what an edge does."""
    step = product.step[edge]
    ends = (system.states[system.source[step]], system.states[system.target[step]])
    source, target = (PLACES[state.location] for state in ends)
    return Move(source, target, system.actions[system.action[step]])


def least(product: Product, system: TransitionSystem, without: Move) -> tuple[float, float] | None:
    """Return the least (C, T) in s of cycles that accept and don't make a move."""
    to_ns, times_ns = times_to_states(product), product.time_ns
    return min(
        (
            (times_ns[cycle].sum() * 1e-9, (to_ns[product.source[edge]] + times_ns[edge]) * 1e-9)
            for cycle in simple_cycles(product)
            if without not in {move(product, system, edge) for edge in cycle}
            for edge in cycle
            if product.accepting[edge]
        ),
        default=None,
    )


def told(rival: Rival) -> tuple[float, float] | None:
    """Return a rival's (C, T) in s."""
    return None if rival.plan is None else (rival.plan.suffix_s, rival.plan.first_s)


@pytest.mark.parametrize("task", TASKS)
def test_each_rival_is_the_best_without_its_move(task: str) -> None:
    """No cycle without the move is shorter, or as short and satisfied earlier; the second best is
    the best of all rivals.
    """
    formula: Formula = parse(task)
    seen = {True: 0, False: 0}
    for seed in range(60):
        system = random_system(seed)
        product = products.build(system, translate(formula))
        lasso = optimal_lasso(product)
        if lasso is None:
            continue
        found = explain_plan(formula, system)
        moves = dict.fromkeys(move(product, system, edge) for edge in lasso.suffix)
        assert [rival.without for rival in found.rivals] == list(moves)
        for rival in found.rivals:
            expected = least(product, system, rival.without)
            assert told(rival) == (expected and pytest.approx(expected)), (seed, rival.without)
            seen[rival.plan is None] += 1
        costs = [cost for cost in map(told, found.rivals) if cost]
        second_best = found.second_best and told(found.second_best)
        assert second_best == min(costs, default=None)
    assert min(seen.values()) > 3
