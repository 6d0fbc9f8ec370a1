"""Good prefixes and restarts against brute force over all short ultimately periodic words."""

import random
from collections.abc import Iterator
from functools import cache
from itertools import product

import pytest

from tlcomm_core.ltl import (
    Formula,
    Operator,
    atom,
    good_prefix_automaton,
    parse,
    restarted,
)

Word = tuple[frozenset[str], ...]
OPERATORS = [
    Operator.NEXT,
    Operator.EVENTUALLY,
    Operator.AND,
    Operator.OR,
    Operator.UNTIL,
    Operator.STRONG_RELEASE,
]


def satisfies(formula: Formula, letters: Word, loop: int) -> bool:
    """Return whether the word that repeats from ``loop`` on satisfies a co-safe formula.

    An eventuality that comes at all comes within the positions that are still ahead, each once.
    """

    @cache
    def holds(node: Formula, position: int) -> bool:
        operands = node.children
        match node.operator:
            case Operator.ATOM:
                return node.name in letters[position]
            case Operator.NOT:
                return not holds(operands[0], position)
            case Operator.AND:
                return all(holds(operand, position) for operand in operands)
            case Operator.OR:
                return any(holds(operand, position) for operand in operands)
            case _:
                return holds_later(node, position)

    def holds_later(node: Formula, position: int) -> bool:
        ahead = [*range(position, len(letters)), *range(loop, position)]
        first, last = node.children[0], node.children[-1]
        match node.operator:
            case Operator.NEXT:
                return holds(first, position + 1 if position + 1 < len(letters) else loop)
            case Operator.EVENTUALLY:
                return any(holds(first, place) for place in ahead)
            case Operator.UNTIL:
                done = [holds(last, place) for place in ahead]
                stays = [holds(first, place) for place in ahead]
            case _:
                done = [holds(first, place) and holds(last, place) for place in ahead]
                stays = [holds(last, place) for place in ahead]
        return any(now and all(stays[:index]) for index, now in enumerate(done))

    return holds(formula, 0)


def letters_over(names: str) -> list[frozenset[str]]:
    """Return all letters over the atoms."""
    choices = product([False, True], repeat=len(names))
    return [frozenset(n for n, v in zip(names, row, strict=True) if v) for row in choices]


def words(alphabet: list[frozenset[str]], longest: int) -> Iterator[Word]:
    """Yield all finite words up to a length."""
    for length in range(longest + 1):
        yield from product(alphabet, repeat=length)


def is_good(formula: Formula, prefix: Word, alphabet: list[frozenset[str]], longest: int) -> bool:
    """Return whether no continuation that is described by few letters violates the formula."""
    return all(
        satisfies(formula, (*prefix, *rest), len(prefix) + loop)
        for rest in words(alphabet, longest)
        for loop in range(len(rest))
    )


def seeded(seed: int | str) -> random.Random:
    """Return a generator that gives the same cases in every run."""
    return random.Random(seed)  # noqa: S311  nothing secret


def random_formula(rng: random.Random, depth: int, names: str) -> Formula:
    """Return a co-safe formula in negation normal form."""
    if depth == 0 or rng.random() < 0.15:
        leaf = atom(rng.choice(names))
        return leaf if rng.random() < 0.6 else Formula(Operator.NOT, (leaf,))
    operator = rng.choice(OPERATORS)
    children = (random_formula(rng, depth - 1, names) for _ in range(operator.arity))
    return Formula(operator, tuple(children))


CASES = [("a", 4, 4), ("ab", 3, 2)]


@pytest.mark.parametrize(("names", "longest", "rest"), CASES, ids=["one atom", "two atoms"])
def test_good_prefixes_are_those_that_settle_the_formula(
    names: str, longest: int, rest: int
) -> None:
    """A prefix leads to the satisfied state exactly if every continuation tried satisfies φ."""
    rng = seeded(names)
    alphabet = letters_over(names)
    good = bad = 0
    for _ in range(25):
        formula = random_formula(rng, 3, names)
        automaton = good_prefix_automaton(formula)
        for prefix in words(alphabet, longest):
            expected = is_good(formula, prefix, alphabet, rest)
            assert automaton.is_good(prefix) == expected, (str(formula), prefix)
            good, bad = good + expected, bad + (not expected)
    assert min(good, bad) > 200


@pytest.mark.parametrize(("names", "length", "rest"), [("a", 9, 3), ("ab", 7, 2)])
def test_restarts_begin_anew_after_each_good_prefix(names: str, length: int, rest: int) -> None:
    """Transitions accept exactly at the letters that complete a good prefix of F φ, counted from
    the letter after the last one that did.
    """
    rng = seeded(f"restarted {names}")
    alphabet = letters_over(names)
    completed = 0
    for _ in range(100):
        formula = random_formula(rng, 3, names)
        eventually = Formula(Operator.EVENTUALLY, (formula,))
        automaton = restarted(formula)
        word = tuple(rng.choice(alphabet) for _ in range(length))
        state, begun = automaton.initial, 0
        for position, letter in enumerate(word):
            ((state, accepting),) = automaton.successors(state, letter)
            stretch = word[begun : position + 1]
            expected = is_good(eventually, stretch, alphabet, rest)
            assert accepting == expected, (str(formula), word, begun, position)
            if expected:
                completed += 1
                begun = position + 1
    assert completed > 100


def test_a_task_counts_its_steps_in_order() -> None:
    """For F-chains a restart needs a, then b, then c; together in one letter they do at once."""
    automaton = restarted(parse("a & F (b & F c)"))
    word = ["c", "b", "a", "c", "b", "a", "c", "abc", "b", "c", "a", "bc"]
    state, accepted = automaton.initial, []
    for position, letter in enumerate(word):
        ((state, accepting),) = automaton.successors(state, frozenset(letter))
        if accepting:
            accepted.append(position)
    assert accepted == [6, 7, 11]
