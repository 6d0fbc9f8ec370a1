"""Rewriting: what becomes of formulas whose syntax shows that they are needlessly long."""

import pytest

from tlcomm_core.ltl import negation_normal_form, parse
from tlcomm_core.ltl.implication import Implication
from tlcomm_core.ltl.rewriting import rewritten


@pytest.mark.parametrize(
    ("text", "shorter"),
    [
        ("a U F b", "F b"),
        ("a R G b", "G b"),
        ("X G F a", "G F a"),
        ("F (a & G F b)", "F a & G F b"),
        ("G (a | F G b)", "G a | F G b"),
        ("G F (a U b)", "G F b"),
        ("F X a", "X F a"),
        ("G a & G b", "G (a & b)"),
        ("F a | F b", "F (a | b)"),
        ("F a & (b U a)", "b U a"),
        ("G a | a", "a"),
        ("(a U b) & G !b", "false"),
        ("F a | G !a", "true"),
        ("a U (a U b)", "a U b"),
        ("(F a) M b", "F a & b"),
        ("(G a) W b", "G a | b"),
        ("a U b | (c & (a U b))", "a U b"),
        ("X a & X b", "X (a & b)"),
        ("X a U X b", "X (a U b)"),
        ("X X a R X b", "X (X a R b)"),
        ("(X a U X b) | !X (a U b)", "true"),
        ("F a & ((F a & b) | G c)", "F a & (b | G c)"),
        ("((F a & b) | G c) & F a", "(b | G c) & F a"),
        ("F a & (X b | G !a)", "F a & X b"),
        ("G a | (b & (G a | c))", "G a | (b & c)"),
        ("a | (G b & (!a | c))", "a | G b"),
    ],
)
def test_rules_shorten(text: str, shorter: str) -> None:
    """Each rule of the literature has its effect."""
    assert rewritten(parse(text)) is negation_normal_form(parse(shorter))


def test_kinds_are_read_off_the_syntax() -> None:
    """G F a is a pure eventuality and a pure universality; a U b is neither."""
    known = Implication()
    assert known.is_eventual(parse("G F a"))
    assert known.is_universal(parse("G F a"))
    assert known.is_eventual(parse("a U F b"))
    assert not known.is_eventual(parse("a U b"))
    assert not known.is_universal(parse("a U b"))


def test_deep_formulas_are_rewritten() -> None:
    """Depth reaches neither Python's stack limit nor a number of pairs that takes long."""
    deep = parse("a U (" * 150 + "b" + ")" * 150)
    assert rewritten(deep) is parse("a U b")
    chain = parse(" & ".join(f"X a{index}" for index in range(900)))
    assert rewritten(chain) is chain
