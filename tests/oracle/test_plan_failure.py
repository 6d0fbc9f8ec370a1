"""Parts of a task that can't be had together, against planning for all subsets of them."""

import random
import re
from itertools import combinations

import pytest

from support.random_system import random_system
from tlcomm_core.errors import UnreachableTaskError, UnsatisfiableTaskError
from tlcomm_core.ltl import Formula, conjunction, conjuncts, parse, translate
from tlcomm_core.planning import product as products
from tlcomm_core.planning.lasso import optimal_lasso
from tlcomm_core.planning.quotient import quotient
from tlcomm_core.planning.synthesis import plan_task
from tlcomm_core.planning.transition_system import TransitionSystem

PARTS = ["G F a", "G F b", "F c", "G !b", "G F (a & w)", "F G !a", "X b", "G (a -> X !a)", "F w"]


def is_possible(parts: tuple[Formula, ...], system: TransitionSystem) -> bool:
    """Return whether there is a plan."""
    product = products.build(system, translate(conjunction(parts)))
    return optimal_lasso(product) is not None


def test_a_failure_names_a_smallest_set_of_parts() -> None:
    """They can't be had together, and any smaller set of the task's can."""
    rng = random.Random(1)  # noqa: S311  nothing secret
    sizes = []
    for seed in range(80):
        system = random_system(seed)
        task = conjunction([parse(text) for text in rng.sample(PARTS, 4)])
        try:
            plan_task(task, system)
        except UnsatisfiableTaskError:
            continue
        except UnreachableTaskError as error:
            named = re.findall(r"'([^']*)'", str(error).split(" can't be done")[0])
            parts = tuple(map(parse, named))
            assert not is_possible(parts, system)
            smaller = combinations(conjuncts(task), len(parts) - 1)
            assert all(is_possible(chosen, system) for chosen in smaller)
            sizes.append(len(parts))
    assert {1, 2} <= set(sizes)


@pytest.mark.parametrize("text", [*PARTS, "a & X (b | c) & X X w", "F (w & X (w & X w))"])
def test_the_quotient_has_the_same_words(text: str) -> None:
    """A task has a plan there exactly if it has one in the system, which is larger now and then."""
    task, merged = (parse(text),), 0
    for seed in range(60):
        system = random_system(seed)
        small = quotient(system)
        assert is_possible(task, small) == is_possible(task, system)
        assert len(small.states) <= len(system.states)
        merged += len(small.states) < len(system.states)
    assert merged > 3
