"""The monitor against the definitions: all continuations up to a bound, and finite semantics."""

import random
from collections.abc import Callable, Iterator
from functools import cache
from itertools import product

import pytest

from support.lasso_semantics import holds
from tlcomm_core.ltl import Formula, Monitor, Operator, Verdict, atom

LETTERS = [frozenset(), frozenset("a"), frozenset("b"), frozenset("ab")]
INNER = [operator for operator in Operator if operator.arity]
Word = tuple[frozenset[str], ...]


def random_formula(rng: random.Random, depth: int) -> Formula:
    """Return a formula at most that many operators deep."""
    if depth == 0 or rng.random() < 0.1:
        return atom(rng.choice("ab"))
    operator = rng.choice(INNER)
    return Formula(operator, tuple(random_formula(rng, depth - 1) for _ in range(operator.arity)))


@cache
def lassos() -> list[tuple[Word, Word]]:
    """Return every stem of up to two letters with every loop of up to two."""
    return [
        (stem, loop)
        for ahead in range(3)
        for around in range(1, 3)
        for stem in product(LETTERS, repeat=ahead)
        for loop in product(LETTERS, repeat=around)
    ]


def until(ends: list[bool], stays: list[bool], place: int) -> bool:
    """Return whether something ends the wait from a place on, and the other holds before."""
    return any(ends[end] and all(stays[place:end]) for end in range(place, len(ends)))


def both(one: list[bool], other: list[bool]) -> list[bool]:
    """Return where both hold."""
    return [x and y for x, y in zip(one, other, strict=True)]


# The truth at a place from the operands' truth at every place (FLTL).
MEANING: dict[Operator, Callable[[list[bool], list[bool], int], bool]] = {
    Operator.NOT: lambda x, _, i: not x[i],
    Operator.AND: lambda x, y, i: x[i] and y[i],
    Operator.OR: lambda x, y, i: x[i] or y[i],
    Operator.IMPLIES: lambda x, y, i: y[i] or not x[i],
    Operator.IFF: lambda x, y, i: x[i] == y[i],
    Operator.NEXT: lambda x, _, i: i + 1 < len(x) and x[i + 1],
    Operator.EVENTUALLY: lambda x, _, i: any(x[i:]),
    Operator.ALWAYS: lambda x, _, i: all(x[i:]),
    Operator.UNTIL: lambda x, y, i: until(y, x, i),
    Operator.WEAK_UNTIL: lambda x, y, i: until(y, x, i) or all(x[i:]),
    Operator.STRONG_RELEASE: lambda x, y, i: until(both(x, y), y, i),
    Operator.RELEASE: lambda x, y, i: until(both(x, y), y, i) or all(y[i:]),
}


def finite_truth(formula: Formula, word: Word) -> list[bool]:
    """Return at which places of a finite word its rest satisfies the formula."""
    if formula.operator is Operator.ATOM:
        return [formula.name in letter for letter in word]
    operands = [finite_truth(child, word) for child in formula.children]
    meaning = MEANING[formula.operator]
    return [meaning(operands[0], operands[-1], place) for place in range(len(word))]


def words(rng: random.Random) -> Iterator[Word]:
    """Yield a few words of one to four letters."""
    for _ in range(4):
        yield tuple(rng.choices(LETTERS, k=rng.randint(1, 4)))


@pytest.mark.parametrize("seed", range(8))
def test_verdicts_agree_with_their_definition(seed: int) -> None:
    """A final verdict holds for every short continuation, an open one has proof of both kinds,
    and what is presumed is the truth on the word so far.
    """
    rng = random.Random(seed)  # noqa: S311  nothing secret
    for _ in range(20):
        formula = random_formula(rng, 3)
        for word in words(rng):
            monitor = Monitor(formula)
            for letter in word:
                monitor.read(letter)
            check(formula, word, monitor)


def check(formula: Formula, word: Word, monitor: Monitor) -> None:
    """Compare a monitor that has read a word with the definitions."""
    case = (str(formula), word)
    if monitor.verdict.is_final:
        expected = monitor.verdict is Verdict.TRUE
        truths = {holds(formula, [*word, *stem], loop) for stem, loop in lassos()}
        assert truths == {expected}, case
        return
    good, bad = monitor.satisfying(), monitor.violating()
    assert good is not None, case
    assert bad is not None, case
    assert holds(formula, [*word, *good.stem], good.loop), case
    assert not holds(formula, [*word, *bad.stem], bad.loop), case
    presumed = monitor.verdict is Verdict.PRESUMABLY_TRUE
    assert presumed == finite_truth(formula, word)[0], case
