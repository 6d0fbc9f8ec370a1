"""Reasons why a task has no plan, in the small plant."""

import pytest

from support.small_plant import SmallPlant
from tlcomm_core.errors import PlanningError, UnreachableTaskError, UnsatisfiableTaskError
from tlcomm_core.ltl import parse, translate
from tlcomm_core.planning.failure import failure
from tlcomm_core.planning.transition_system import TransitionSystem

SYSTEM = SmallPlant().system()
HERE = "place that can be reached from (1.75, 0.25)"
ORDER = "no order of visits and actions fits that begins at (1.75, 0.25), in no region"
AT_ONCE = "what they want true and what they want false can't be had at once"
VAULT = "region 'vault' can't be reached from (1.75, 0.25): every way is blocked"


def reason(text: str, system: TransitionSystem = SYSTEM) -> PlanningError:
    """Return the error for a task."""
    formula = parse(text)
    return failure(formula, translate(formula), system)


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ("G F (p & !p)", "'G F (p & !p)' contradicts itself: no word satisfies it"),
        (
            "F p & G F r & G !p",
            "'F p' and 'G !p' contradict each other: no word satisfies them all",
        ),
    ],
)
def test_a_contradiction_names_its_parts(text: str, sentence: str) -> None:
    """Those that exclude each other whatever an agent does."""
    error = reason(text)
    assert isinstance(error, UnsatisfiableTaskError)
    assert str(error) == sentence


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ("G F p & G F vault", f"'G F vault' can't be done: {VAULT}"),
        ("G F (p & F vault)", f"'G F (p & F vault)' can't be done: {VAULT}"),
        (
            "G F (p & r) & F m",
            f"'G F (p & r)' can't be done: 'p & r' can't be had at any {HERE}",
        ),
        (
            "p & G F r",
            f"'p' can't be done: {ORDER}",
        ),
        (
            "G F p & G F r & G !hall",
            f"'G F p' and 'G !hall' can't be done together: {AT_ONCE} at any {HERE}",
        ),
    ],
)
def test_what_cannot_be_had_is_named(text: str, sentence: str) -> None:
    """A region behind walls, several places at once, or a first letter that the start isn't."""
    error = reason(text)
    assert isinstance(error, UnreachableTaskError)
    assert str(error) == sentence


def test_every_culprit_is_named() -> None:
    """Where none of them alone is to blame."""
    system = SmallPlant(("p", "m")).system()
    named = str(reason("F r | F vault", system))
    assert "region 'r' can't" in named
    assert "region 'vault' can't" in named


def test_an_action_that_is_possible_nowhere_is_named() -> None:
    """With no region in reach there is no place to act at."""
    error = reason("F collect", SmallPlant(("vault",)).system())
    sentence = f"'F collect' can't be done: action 'collect' isn't possible at any {HERE}"
    assert str(error) == sentence


def test_parts_that_are_too_large_are_not_blamed() -> None:
    """What has no automaton within the limits counts as possible."""
    many = " & ".join(f"F x{index}" for index in range(12))
    error = failure(parse(f"(false | {many}) & F vault"), translate(parse("F vault")), SYSTEM)
    assert str(error) == f"'F vault' can't be done: {VAULT}"
