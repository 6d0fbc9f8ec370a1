"""Conjuncts G F β outside the tableau."""

import pytest

from tlcomm_core.ltl import negation_normal_form, parse, tableau_automaton
from tlcomm_core.ltl.recurrence import separated

FAIRNESS = " & ".join(f"G F a{index}" for index in range(20))


def test_many_conjuncts_are_separated() -> None:
    """Five or more are taken out, with the rest left; fewer stay."""
    many = separated(
        negation_normal_form(parse("G F a & G F b & G F c & G F (d | e) & G F f & X g"))
    )
    assert many.rest == (parse("X g"),)
    assert [str(target) for target in many.targets] == ["a", "b", "c", "d | e", "f"]
    assert separated(negation_normal_form(parse(FAIRNESS))).rest == ()
    few = separated(negation_normal_form(parse("G F a & G F b & X g")))
    assert [str(node) for node in few.rest] == ["G F a", "G F b", "X g"]
    assert few.targets == ()


def test_twenty_fairness_terms_have_twenty_states() -> None:
    """The automaton grows by one state, not by a factor, with each term."""
    automaton = tableau_automaton(parse(FAIRNESS))
    assert automaton.state_count == 20
    assert not automaton.is_empty()


@pytest.mark.parametrize(
    ("extra", "empty"), [("F G !a7", True), ("G !a7", True), ("F G a7", False), ("G a7", False)]
)
def test_the_rest_and_the_terms_must_hold_together(extra: str, empty: bool) -> None:
    """A rest that excludes one of the terms leaves nothing, one that doesn't leaves something."""
    assert tableau_automaton(parse(f"{FAIRNESS} & {extra}")).is_empty() is empty
