"""Truth on finite words that grow."""

import pytest

from tlcomm_core.ltl import Formula, Operator, atom, parse
from tlcomm_core.ltl.finite import FiniteReading


@pytest.mark.parametrize(
    ("text", "word", "expected"),
    [
        ("X true", "-", False),
        ("X true", "--", True),
        ("!X true", "-", True),
        ("X G a", "-", False),
        ("X G a", "-aa", True),
        ("G X a", "a", False),
        ("F b", "aa", False),
        ("F b", "ab", True),
        ("a W b", "aaa", True),
        ("a U b", "aaa", False),
        ("b R a", "aaa", True),
        ("b M a", "aaa", False),
        ("!(b M a)", "aaa", True),
        ("G (a -> F b)", "ab", True),
        ("G (a -> F b)", "aba", False),
        ("a <-> X b", "ab", True),
        ("!(a <-> X b)", "aa", True),
    ],
)
def test_the_word_ends_after_its_last_letter(text: str, word: str, expected: bool) -> None:
    """A next letter must exist, an eventuality have come, an invariant have held so far."""
    reading = FiniteReading(parse(text))
    for character in word:
        reading.read(frozenset(character) - {"-"})
    assert reading.is_satisfied == expected


def test_before_the_first_letter_nothing_is_satisfied() -> None:
    """An empty word satisfies no formula."""
    assert not FiniteReading(parse("true")).is_satisfied


def test_deep_formulas_are_read() -> None:
    """A formula nested far beyond Python's own stack is."""
    formula = atom("a")
    for _ in range(5000):
        both = Formula(Operator.AND, (atom("a"), formula))
        formula = Formula(Operator.EVENTUALLY, (both,))
    reading = FiniteReading(formula)
    reading.read(frozenset("a"))
    assert reading.is_satisfied
