"""Guards over the letters that can occur."""

import pytest

from tlcomm_core.errors import IntractableTaskError
from tlcomm_core.ltl import Construction, parse, translate
from tlcomm_core.ltl.alphabet import LetterGuards, sharpened
from tlcomm_core.ltl.composition import grouped
from tlcomm_core.ltl.graph import Edge, Graph

IF_A, IF_B, UNLESS_B = 0b0001, 0b0100, 0b1000
NOTHING, ONLY_A, ONLY_B = frozenset[str](), frozenset({"a"}), frozenset({"b"})


def one_at_a_time(count: int) -> list[frozenset[str]]:
    """Return the letters in which at most one of a0, b0, a1, b1, … is true."""
    names = [f"{kind}{i}" for kind in "ab" for i in range(count)]
    return [frozenset(), *(frozenset({name}) for name in names)]


def responses(count: int) -> str:
    """Return conjoined formulas G (a -> F b) over different atoms."""
    return " & ".join(f"G (a{i} -> F b{i})" for i in range(count))


def test_a_guard_is_the_set_of_its_letters() -> None:
    """Letters that differ in other atoms alone are one; what no letter passes is nothing."""
    guards = LetterGuards(("a", "b"), [NOTHING, ONLY_A, ONLY_B, ONLY_A | {"c"}])
    assert guards.number([IF_A]) == 0b010
    assert guards.number([UNLESS_B]) == 0b011
    assert guards.number([IF_A | IF_B]) == 0
    assert guards.both(guards.number([IF_A]), guards.number([IF_B])) is None
    assert guards.cubes(0b010) == (IF_A | UNLESS_B,)


def test_sharpening_leaves_the_best_edge_of_each_letter() -> None:
    """Of two edges into one state, the one without the mark keeps the other's missing letters."""
    guards = LetterGuards(("a", "b"), [NOTHING, ONLY_A, ONLY_B])
    graph = Graph(((Edge(0, 0, 0), Edge(IF_A, 0, 1)),), 1)
    assert sharpened(grouped(graph, guards), guards).rows == (
        (Edge(0b101, 0, 0), Edge(0b010, 0, 1)),
    )


def test_too_large_a_conjunction_is_made_for_its_letters() -> None:
    """Eight responses are refused in general and translated for a robot's letters."""
    formula = parse(responses(8))
    with pytest.raises(IntractableTaskError):
        translate(formula)
    automaton = translate(formula, one_at_a_time(8))
    assert automaton.kind is Construction.FOR_LETTERS
    assert not automaton.is_empty()
    assert automaton.is_deterministic()
    known, unknown = frozenset({"a3"}), frozenset({"a3", "b4"})
    assert len(automaton.successors(automaton.initial, known)) == 1
    assert automaton.successors(automaton.initial, unknown) == ()


def test_what_fits_is_made_for_all_letters() -> None:
    """Known letters change nothing where the whole automaton is within the limits."""
    formula = parse(responses(3))
    assert translate(formula, one_at_a_time(3)) == translate(formula)
