"""Automata of conjunctions from those of the parts."""

import pytest

from tlcomm_core.errors import IntractableTaskError
from tlcomm_core.ltl import parse, tableau_automaton
from tlcomm_core.ltl.composition import CubeGuards, composed, grouped, ungrouped
from tlcomm_core.ltl.graph import Edge, Graph

IF_A, IF_NOT_A, IF_B = 0b0001, 0b0010, 0b0100


def responses(count: int) -> str:
    """Return conjoined formulas G (a -> F b) over different atoms."""
    return " & ".join(f"G (a{i} -> F b{i})" for i in range(count))


def test_guards_are_joined_cube_by_cube() -> None:
    """(a | b) & !a is !a & b; a & !a is nothing; equal guards have one number."""
    guards = CubeGuards(2)
    either, not_a = guards.number([IF_A, IF_B]), guards.number([IF_NOT_A])
    both = guards.both(either, not_a)
    assert both is not None
    assert guards.cubes(both) == (IF_NOT_A | IF_B,)
    assert guards.both(guards.number([IF_A]), not_a) is None
    assert guards.number([IF_B, IF_A, IF_A | IF_B]) == either


def test_grouping_joins_edges_and_can_be_undone() -> None:
    """Edges to one target with the same marks become one with all their cubes."""
    graph = Graph(((Edge(IF_A, 0, 1), Edge(IF_B, 0, 1), Edge(IF_A, 0, 0)),), 1)
    guards = CubeGuards(2)
    joined = grouped(graph, guards)
    assert [(len(guards.cubes(e.literals)), e.marks) for e in joined.rows[0]] == [(2, 1), (1, 0)]
    assert ungrouped(joined, guards) == graph


def test_a_composition_carries_the_marks_of_all() -> None:
    """G F a beside G F b: one state, and an edge on a & b with both marks."""
    guards = CubeGuards(2)
    rows = [(Edge(cube, 0, 1), Edge(0, 0, 0)) for cube in (IF_A, IF_B)]
    parts = [grouped(Graph((row,), 1), guards) for row in rows]
    graph = ungrouped(composed(parts, guards), guards)
    assert graph.mark_count == 2
    assert len(graph.rows) == 1
    assert Edge(IF_A | IF_B, 0, 3) in graph.rows[0]


@pytest.mark.parametrize(("count", "states"), [(3, 14), (4, 36), (6, 208)])
def test_conjoined_responses_have_a_state_per_set_that_waits(count: int, states: int) -> None:
    """K responses need 2^k sets of waiting ones, each once per member, and little more."""
    automaton = tableau_automaton(parse(responses(count)))
    assert automaton.state_count == states
    assert not automaton.is_empty()


@pytest.mark.parametrize("count", [8, 12, 20])
def test_too_many_responses_are_refused(count: int) -> None:
    """Beyond the stated limits the answer is an error that names them."""
    with pytest.raises(IntractableTaskError, match=r"more than \d+ states or \d+ edges"):
        tableau_automaton(parse(responses(count)))


@pytest.mark.parametrize(
    ("extra", "empty"), [("F (a0 & G !b0)", True), ("F (a0 & X G !b0)", False), ("G a1", False)]
)
def test_the_parts_must_hold_together(extra: str, empty: bool) -> None:
    """What excludes one of many responses leaves nothing."""
    assert tableau_automaton(parse(f"{responses(4)} & {extra}")).is_empty() is empty
