"""Büchi automata: what the product asks of them."""

import pytest

from tlcomm_core.ltl import BuchiAutomaton, Construction, Cube, Guard, Transition
from tlcomm_core.ltl.automaton import strong_components

IF_A = Guard((Cube(frozenset({"a"}), frozenset()),))
IF_NOT_A = Guard((Cube(frozenset(), frozenset({"a"})),))
ALWAYS = Guard((Cube(frozenset(), frozenset()),))
NEVER = Guard(())


def automaton(*rows: list[Transition]) -> BuchiAutomaton:
    """Return an automaton over the atom a."""
    return BuchiAutomaton(("a",), 0, tuple(map(tuple, rows)), Construction.TABLEAU)


def test_successors_ignore_foreign_atoms() -> None:
    """Only the automaton's own atoms matter for a letter."""
    machine = automaton([Transition(IF_A, 1, accepting=False)], [])
    assert machine.successors(0, frozenset({"a", "zebra"})) == ((1, False),)
    assert machine.successors(0, frozenset({"zebra"})) == ()


def test_accepting_edge_hides_its_twin() -> None:
    """Where an accepting and another edge lead to one target, the accepting one is given."""
    machine = automaton(
        [
            Transition(IF_A, 0, accepting=False),
            Transition(ALWAYS, 0, accepting=True),
            Transition(ALWAYS, 1, accepting=False),
        ],
        [],
    )
    assert machine.successors(0, frozenset({"a"})) == ((0, True), (1, False))


@pytest.mark.parametrize(
    ("rows", "empty"),
    [
        ([[]], True),
        ([[Transition(ALWAYS, 0, accepting=True)]], False),
        ([[Transition(ALWAYS, 0, accepting=False)]], True),
        ([[Transition(NEVER, 0, accepting=True)]], True),
        ([[Transition(ALWAYS, 1, accepting=True)], []], True),
        ([[], [Transition(ALWAYS, 1, accepting=True)]], True),
        (
            [
                [Transition(ALWAYS, 1, accepting=True)],
                [Transition(ALWAYS, 0, accepting=False)],
            ],
            False,
        ),
        (
            [[Transition(ALWAYS, 1, accepting=True)], [Transition(NEVER, 0, accepting=False)]],
            True,
        ),
    ],
)
def test_emptiness_needs_a_reachable_accepting_cycle(
    rows: list[list[Transition]], *, empty: bool
) -> None:
    """An automaton is empty unless an accepting edge on a cycle can be reached."""
    assert automaton(*rows).is_empty() is empty


def test_determinism_and_completeness() -> None:
    """Overlapping guards break determinism, a letter without an edge breaks completeness."""
    both = automaton(
        [Transition(IF_A, 0, accepting=True), Transition(IF_NOT_A, 0, accepting=False)]
    )
    assert both.is_deterministic()
    assert both.is_complete()
    partial = automaton([Transition(IF_A, 0, accepting=True)])
    assert partial.is_deterministic()
    assert not partial.is_complete()
    overlapping = automaton(
        [Transition(IF_A, 0, accepting=True), Transition(ALWAYS, 0, accepting=False)]
    )
    assert not overlapping.is_deterministic()
    assert overlapping.is_complete()


def test_strong_components() -> None:
    """Two nodes share a component exactly when each reaches the other."""
    component = strong_components([[1], [2], [1, 3], []])
    assert component[1] == component[2]
    assert len({component[0], component[1], component[3]}) == 3
