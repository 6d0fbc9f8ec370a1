"""The optimal lasso of products made by hand."""

from fractions import Fraction

import numpy as np
import pytest

from tlcomm_core.planning.lasso import Lasso, Objective, optimal_lasso
from tlcomm_core.planning.product import Product, Reading


def product(size: int, *edges: tuple[int, int, int, bool], initial: int = 0) -> Product:
    """Return a product with edges (source, target, time, accepting)."""
    columns = np.array(edges, dtype=np.int64).reshape(-1, 4).T
    return Product(
        size=size,
        initial=np.array([initial]),
        source=columns[0],
        target=columns[1],
        step=np.arange(len(edges)),
        accepting=columns[3] > 0,
        time_ns=columns[2],
        initial_ns=np.array([0]),
        reading=Reading((), np.array([0]), np.arange(len(edges))),
    )


def test_no_accepting_cycle_means_no_lasso() -> None:
    """An accepting edge on no cycle and a cycle without acceptance don't make one."""
    assert optimal_lasso(product(2, (0, 1, 1, True), (1, 1, 1, False))) is None


def test_no_edges_at_all_mean_no_lasso() -> None:
    """Neither does a lone initial state."""
    assert optimal_lasso(product(1)) is None


def test_the_suffix_comes_first_in_cost() -> None:
    """A cheaper cycle wins at the end of however long a prefix."""
    graph = product(2, (0, 0, 5, True), (0, 1, 100, False), (1, 1, 4, True))
    assert optimal_lasso(graph) == Lasso((1,), (2,))


def test_of_equal_cycles_the_one_that_is_reached_first_is_taken() -> None:
    """Then the prefix decides."""
    graph = product(3, (0, 1, 9, False), (0, 2, 8, False), (1, 1, 4, True), (2, 2, 4, True))
    assert optimal_lasso(graph) == Lasso((1,), (3,))


def test_the_cycle_is_entered_where_that_is_cheapest() -> None:
    """Not where its accepting edge is."""
    graph = product(
        4, (0, 1, 9, False), (0, 2, 1, False), (1, 2, 1, True), (2, 3, 1, False), (3, 1, 1, False)
    )
    assert optimal_lasso(graph) == Lasso((1,), (3, 4, 2))


def test_a_slow_accepting_edge_is_taken_beside_a_fast_other() -> None:
    """Of two parallel edges the cycle takes the one that it needs."""
    graph = product(2, (0, 1, 1, False), (0, 1, 7, True), (1, 0, 1, False))
    assert optimal_lasso(graph) == Lasso((), (1, 2))


def test_edges_of_no_time_are_taken() -> None:
    """A cycle may hold steps that take no time."""
    graph = product(3, (0, 1, 0, False), (1, 2, 0, True), (2, 0, 3, False), (0, 0, 4, True))
    assert optimal_lasso(graph) == Lasso((), (0, 1, 2))


def test_times_beyond_single_precision_are_told_apart() -> None:
    """A nanosecond in a week decides."""
    week = 7 * 86_400 * 10**9
    graph = product(2, (0, 0, week + 1, True), (0, 1, 0, False), (1, 1, week, True))
    assert optimal_lasso(graph) == Lasso((1,), (2,))


def test_the_cycle_is_entered_so_that_it_is_satisfied_soon() -> None:
    """Entering just behind the accepting edge is quick, and would cost a whole pass."""
    graph = product(
        4, (0, 1, 1, False), (0, 2, 9, False), (1, 2, 50, False), (2, 3, 1, False), (3, 1, 1, True)
    )
    assert optimal_lasso(graph) == Lasso((1,), (3, 4, 2))


@pytest.mark.parametrize(
    ("gamma", "suffix"), [(Fraction(99), 0), (Fraction(101), 2), (Fraction(1, 3), 0)]
)
def test_gamma_weighs_the_suffix_against_the_first_satisfaction(
    gamma: Fraction, suffix: int
) -> None:
    """Here 100 ns until the first satisfaction stand against 1 ns per pass."""
    graph = product(2, (0, 0, 5, True), (0, 1, 101, False), (1, 1, 4, True))
    assert optimal_lasso(graph, Objective(gamma)).suffix == (suffix,)


def test_a_tie_by_gamma_is_exact() -> None:
    """With γ = 1/10, 100 + 100γ and 105 + 50γ are equal to the last digit: fewer steps decide."""
    graph = product(2, (0, 1, 55, False), (1, 1, 50, True), (0, 0, 100, True))
    assert optimal_lasso(graph, Objective(Fraction(1, 10))) == Lasso((), (2,))


def test_many_accepting_edges_are_told_apart() -> None:
    """In a ring where all edges accept, one chord makes the shortest cycle."""
    count = 50
    ring = [(place, (place + 1) % count, 1, True) for place in range(count)]
    graph = product(count, *ring, (30, 11, 1, False))
    found = optimal_lasso(graph)
    assert found == Lasso(tuple(range(11)), (*range(11, 30), count))
