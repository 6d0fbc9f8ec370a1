"""Expansion: what a formula demands now and later."""

import pytest

from tlcomm_core.errors import LocalMisuseError
from tlcomm_core.ltl import negation_normal_form, parse
from tlcomm_core.ltl.expansion import Expansion, antichain


def expanded(text: str) -> set[tuple[str, int, bool]]:
    """Return per term its literals, how much it obliges later, and whether it postpones."""
    expansion = Expansion(negation_normal_form(parse(text)))
    assert expansion.start is not None
    return {
        (
            " ".join(
                name if positive else f"!{name}"
                for name, positive in expansion.cube(expansion.literals(term)).literals()
            ),
            expansion.obligations(term).bit_count(),
            bool(expansion.postponed(term)),
        )
        for term in expansion.terms(expansion.start)
    }


@pytest.mark.parametrize(
    ("text", "terms"),
    [
        ("true", {("", 0, False)}),
        ("a & !b", {("a !b", 0, False)}),
        ("X a", {("", 1, False)}),
        ("X (a & b)", {("", 2, False)}),
        ("F a", {("a", 0, False), ("", 1, True)}),
        ("G a", {("a", 1, False)}),
        ("a U b", {("b", 0, False), ("a", 1, True)}),
        ("a W b", {("b", 0, False), ("a", 1, False)}),
        ("a R b", {("a b", 0, False), ("b", 1, False)}),
        ("a M b", {("a b", 0, False), ("b", 1, True)}),
        ("G F a", {("a", 1, False), ("", 1, True)}),
        ("F a & G !a", {("!a", 2, True)}),
        ("a | a & b", {("a", 0, False)}),
    ],
)
def test_expansion_rules(text: str, terms: set[tuple[str, int, bool]]) -> None:
    """Each operator unfolds by its fixpoint equation; stronger terms are dropped."""
    assert expanded(text) == terms


def test_false_has_no_start() -> None:
    """The constant false can't be obliged."""
    assert Expansion(parse("false")).start is None


@pytest.mark.parametrize("text", ["!(a & b)", "a -> b", "a <-> b", "!F a"])
def test_other_forms_are_refused(text: str) -> None:
    """A formula that isn't in negation normal form is our own bug."""
    with pytest.raises(LocalMisuseError, match="negation normal form"):
        Expansion(parse(text))


def test_antichain_keeps_the_smallest_sets() -> None:
    """A set that contains another goes; the rest is sorted by size."""
    assert antichain([0b111, 0b100, 0b011, 0b110, 0b011]) == (0b100, 0b011)
    assert antichain([0b1, 0]) == (0,)
    assert antichain([]) == ()
