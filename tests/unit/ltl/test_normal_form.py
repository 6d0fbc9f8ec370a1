"""Negation normal form and what is read off it."""

import pytest

from tlcomm_core.ltl import is_co_safe, negation_normal_form, parse, recurring


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("!(a & b)", "!a | !b"),
        ("!(a | b)", "!a & !b"),
        ("!(a -> b)", "a & !b"),
        ("a -> b", "!a | b"),
        ("a <-> b", "a & b | !a & !b"),
        ("!(a <-> b)", "a & !b | !a & b"),
        ("!X a", "X !a"),
        ("!F a", "G !a"),
        ("!G a", "F !a"),
        ("!(a U b)", "!a R !b"),
        ("!(a R b)", "!a U !b"),
        ("!(a W b)", "!a M !b"),
        ("!(a M b)", "!a W !b"),
        ("!!a", "a"),
        ("F F a", "F a"),
        ("G G a", "G a"),
        ("F G F a", "G F a"),
        ("G F G a", "F G a"),
        ("a & !a", "false"),
        ("a | !a", "true"),
        ("X true", "true"),
        ("F false", "false"),
        ("true U a", "F a"),
        ("false U a", "a"),
        ("a U true", "true"),
        ("a U false", "false"),
        ("false R a", "G a"),
        ("true R a", "a"),
        ("a R true", "true"),
        ("a R false", "false"),
        ("a W false", "G a"),
        ("true W a", "true"),
        ("false W a", "a"),
        ("a W true", "true"),
        ("a M true", "F a"),
        ("a M false", "false"),
        ("false M a", "false"),
        ("true M a", "a"),
        ("a U a", "a"),
    ],
)
def test_normal_form(text: str, expected: str) -> None:
    """Negations move to the atoms by duality, and constants fold."""
    assert negation_normal_form(parse(text)) is parse(expected)


def test_nested_equivalences_stay_small() -> None:
    """300 nested equivalences, 2^300 disjuncts if written out, share their subformulas."""
    formula = parse(" <-> ".join(f"a{index}" for index in range(300)))
    assert negation_normal_form(formula) is negation_normal_form(formula)


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("a & F (b & F c)", True),
        ("a U b", True),
        ("a M b", True),
        ("X !a", True),
        ("!G a", True),
        ("!(a R b)", True),
        ("!(a W b)", True),
        ("true", True),
        ("G a", False),
        ("a R b", False),
        ("a W b", False),
        ("!F a", False),
        ("!(a U b)", False),
        ("F a -> F b", False),
        ("G a -> F b", True),
    ],
)
def test_co_safety(text: str, expected: bool) -> None:
    """A formula is co-safe when its normal form has no G, R or W."""
    assert is_co_safe(parse(text)) is expected


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("G F a", "a"),
        ("[]<>(a U b)", "a U b"),
        ("!F G !a", "a"),
        ("false R (true U a)", "a"),
        ("F G F a", "a"),
        ("(G F a)", "a"),
        ("(F a) W false", "a"),
        ("F G a", None),
        ("G a", None),
        ("G F a & G F b", None),
        ("X G F a", None),
    ],
)
def test_recurring(text: str, expected: str | None) -> None:
    """G F φ is recognised however it is written."""
    assert recurring(parse(text)) is (None if expected is None else parse(expected))
