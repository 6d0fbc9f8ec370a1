"""The tableau: known automata, unsatisfiable formulas, depth."""

import pytest

from tlcomm_core.ltl import Construction, parse, tableau_automaton


@pytest.mark.parametrize(
    ("text", "states"),
    [
        ("true", 1),
        ("a", 2),
        ("X a", 3),
        ("F a", 2),
        ("G a", 1),
        ("F G a", 2),
        ("a U b", 2),
        ("a W b", 2),
        ("G (a -> F b)", 2),
        ("G F a & G F b", 2),
    ],
)
def test_small_formulas_have_small_automata(text: str, states: int) -> None:
    """Everyday formulas get no more states than they need."""
    automaton = tableau_automaton(parse(text))
    assert automaton.state_count == states
    assert automaton.kind is Construction.TABLEAU
    assert not automaton.is_empty()


@pytest.mark.parametrize(
    "text",
    [
        "false",
        "a & !a",
        "G a & F !a",
        "a U b & G !b",
        "G F a & F G !a",
        "X (a & X !a) & G (a -> X a)",
        "(a M b) & G !a",
        "!(a U b <-> b | a & X (a U b))",
    ],
)
def test_unsatisfiable_formulas_have_empty_automata(text: str) -> None:
    """With no satisfying word, one state without edges is left."""
    automaton = tableau_automaton(parse(text))
    assert automaton.is_empty()
    assert automaton.transitions == ((),)


def test_deep_formulas_are_translated() -> None:
    """Neither nested operators nor chains of conjuncts reach Python's stack limit."""
    assert tableau_automaton(parse("X " * 200 + "a")).state_count == 202
    assert tableau_automaton(parse("a U (" * 30 + "b" + ")" * 30)).state_count == 2
    chain = " & ".join(f"a{index}" for index in range(1500))
    assert tableau_automaton(parse(chain)).state_count == 2
