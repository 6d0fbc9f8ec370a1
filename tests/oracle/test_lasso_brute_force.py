"""The optimal lasso against all simple lassos of tiny products."""

from collections.abc import Iterator
from fractions import Fraction

import numpy as np
import pytest

from tlcomm_core.planning.lasso import Lasso, Objective, optimal_lasso
from tlcomm_core.planning.product import Product, Reading


def random_product(seed: int) -> Product:
    """Return up to seven states, all reachable; edges of no time lead to higher numbers only."""
    rng = np.random.default_rng(seed)
    size = int(rng.integers(2, 8))
    count = int(rng.integers(size, 3 * size))
    source, target = rng.integers(0, size, (2, count))
    time_ns = rng.integers(0, 4, count)
    time_ns[source >= target] += 1
    accepting = rng.random(count) < rng.choice([0.1, 0.2, 1.0])
    initial = np.unique(rng.integers(0, size, int(rng.integers(1, 3))))
    initial_ns = rng.integers(0, 3, len(initial))
    step = np.arange(count)
    unread = Reading((), initial, step)
    return reachable_part(
        Product(size, initial, source, target, step, accepting, time_ns, initial_ns, unread)
    )


def reachable_part(product: Product) -> Product:
    """Return a product without the states that no run reaches."""
    edges = list(zip(product.source.tolist(), product.target.tolist(), strict=True))
    reached = set(product.initial.tolist())
    while more := {target for source, target in edges if source in reached} - reached:
        reached |= more
    states = np.array(sorted(reached))
    kept = np.isin(product.source, states)
    return Product(
        size=len(states),
        initial=np.searchsorted(states, product.initial),
        source=np.searchsorted(states, product.source[kept]),
        target=np.searchsorted(states, product.target[kept]),
        step=product.step[kept],
        accepting=product.accepting[kept],
        time_ns=product.time_ns[kept],
        initial_ns=product.initial_ns,
        reading=product.reading,
    )


def simple_lassos(product: Product) -> Iterator[Lasso]:
    """Yield every simple path from an initial state with every edge back into it."""
    source, target = product.source.tolist(), product.target.tolist()

    def extend(states: list[int], edges: list[int]) -> Iterator[Lasso]:
        for edge in range(len(source)):
            if source[edge] != states[-1]:
                continue
            if target[edge] in states:
                entry = states.index(target[edge])
                yield Lasso(tuple(edges[:entry]), (*edges[entry:], edge))
            else:
                yield from extend([*states, target[edge]], [*edges, edge])

    for initial in product.initial.tolist():
        yield from extend([initial], [])


def cost(product: Product, lasso: Lasso, gamma: Fraction | None) -> tuple[Fraction | int, ...]:
    """Return what is to be least, then the steps to the first satisfaction and in the suffix."""
    times_ns = product.time_ns
    until = product.accepting[list(lasso.suffix)].argmax() + 1
    first = [*lasso.prefix, *lasso.suffix[:until]]
    entry = product.initial == product.source[first[0]]
    first_ns = int(times_ns[first].sum()) + int(product.initial_ns[entry].sum())
    suffix_ns = int(times_ns[list(lasso.suffix)].sum())
    steps = len(first) + len(lasso.suffix)
    if gamma is None:
        return suffix_ns, first_ns, steps
    return first_ns + gamma * suffix_ns, steps


def assert_is_accepting_run(product: Product, lasso: Lasso) -> None:
    """Check that the edges follow one another, close and accept."""
    edges = [*lasso.prefix, *lasso.suffix, lasso.suffix[0]]
    assert product.source[edges[0]] in product.initial
    assert (product.source[edges[1:]] == product.target[edges[:-1]]).all()
    assert product.accepting[list(lasso.suffix)].any()


@pytest.mark.parametrize("gamma", [None, Fraction(1, 3), Fraction(7)])
@pytest.mark.parametrize("seed", range(500))
def test_the_lasso_costs_what_the_best_simple_lasso_costs(
    seed: int, gamma: Fraction | None
) -> None:
    """By either objective, then by steps, no simple lasso is better than the one found."""
    product = random_product(seed)
    accepting = [
        lasso for lasso in simple_lassos(product) if product.accepting[list(lasso.suffix)].any()
    ]
    found = optimal_lasso(product, Objective(gamma))
    if found is None:
        assert not accepting
    else:
        assert_is_accepting_run(product, found)
        assert cost(product, found, gamma) == min(
            cost(product, lasso, gamma) for lasso in accepting
        )


def test_the_random_products_cover_the_cases() -> None:
    """Among them are products with and without accepting runs, prefixes and long suffixes."""
    found = [optimal_lasso(random_product(seed)) for seed in range(500)]
    lassos = [lasso for lasso in found if lasso]
    assert 40 < len(lassos) < 480
    assert sum(bool(lasso.prefix) for lasso in lassos) > 40
    assert sum(len(lasso.suffix) > 2 for lasso in lassos) > 30
