"""The shortest lasso words."""

import pytest

from tlcomm_core.ltl import parse
from tlcomm_core.ltl.short_words import shortest_lasso


@pytest.mark.parametrize(
    ("text", "word"),
    [
        ("true", "(–) for ever"),
        ("G F a & G F !a", "(a ; –) for ever"),
        ("a & X G b & X !a", "a ; (b) for ever"),
        ("G (a <-> X !a) & (b | true)", "(a ; –) for ever"),
        ("!a & X (a U b)", "(b) for ever"),
        ("a W b & !b & X !a", "a ; (b) for ever"),
        ("(a R b) & F (a & X !b)", "a & b ; (–) for ever"),
        ("a M b & X !b", "a & b ; (–) for ever"),
        ("X X (a -> b) & a & X a & !b & X !b", "a ; a ; (–) for ever"),
    ],
)
def test_it_has_the_fewest_letters_then_atoms(text: str, word: str) -> None:
    """Also where a word with more letters has fewer atoms."""
    assert str(shortest_lasso(parse(text), 5)) == word


def test_longer_words_are_left_out() -> None:
    """Five letters are needed, four allowed."""
    formula = parse("a & X (a & X (a & X (a & X !a)))")
    assert shortest_lasso(formula, 4) is None
    assert shortest_lasso(formula, 5) is not None


def test_too_many_words_are_not_read() -> None:
    """With thirty atoms there are a thousand million letters."""
    assert shortest_lasso(parse(" & ".join(f"a{index}" for index in range(30))), 1) is None
