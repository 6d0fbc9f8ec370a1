"""Minimal conflicts against all subsets of the parts."""

import random
from itertools import combinations

import pytest

from tlcomm_core.ltl import Formula, Operator, atom, conflict, conjunction, conjuncts, translate

PARTS = [Operator.EVENTUALLY, Operator.ALWAYS, Operator.NEXT, Operator.UNTIL, Operator.OR]


def random_part(rng: random.Random, depth: int) -> Formula:
    """Return a small formula."""
    if depth == 0:
        leaf = atom(rng.choice("abc"))
        return leaf if rng.random() < 0.5 else Formula(Operator.NOT, (leaf,))
    operator = rng.choice(PARTS)
    return Formula(operator, tuple(random_part(rng, depth - 1) for _ in range(operator.arity)))


def is_satisfiable(parts: tuple[Formula, ...]) -> bool:
    """Return whether some word satisfies all."""
    return not translate(conjunction(parts)).is_empty()


@pytest.mark.parametrize("seed", range(6))
def test_no_subset_with_fewer_parts_conflicts(seed: int) -> None:
    """The parts found exclude each other, and brute force finds no smaller set that does."""
    rng = random.Random(seed)  # noqa: S311  nothing secret
    cases = 0
    while cases < 10:
        whole = conjunction([random_part(rng, rng.randint(0, 2)) for _ in range(6)])
        if not translate(whole).is_empty():
            continue
        cases += 1
        found = conflict(whole)
        assert not is_satisfiable(found)
        smaller = [c for n in range(len(found)) for c in combinations(conjuncts(whole), n)]
        assert all(is_satisfiable(parts) for parts in smaller), str(whole)


@pytest.mark.parametrize("seed", range(6))
def test_the_conjuncts_mean_the_formula(seed: int) -> None:
    """A formula and the conjunction of its parts differ on no word."""
    rng = random.Random(100 + seed)  # noqa: S311  nothing secret
    inner = [*PARTS, Operator.AND, Operator.AND, Operator.IMPLIES, Operator.NOT, Operator.ALWAYS]

    def formula(depth: int) -> Formula:
        if depth == 0:
            return atom(rng.choice("abc"))
        operator = rng.choice(inner)
        return Formula(operator, tuple(formula(depth - 1) for _ in range(operator.arity)))

    for _ in range(20):
        whole = formula(3)
        differ = Formula(
            Operator.NOT, (Formula(Operator.IFF, (whole, conjunction(conjuncts(whole)))),)
        )
        assert translate(differ).is_empty(), str(whole)
