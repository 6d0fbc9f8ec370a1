"""Direct simulation: which states stand in for which."""

from tlcomm_core.ltl.graph import Edge
from tlcomm_core.ltl.simulation import Letters, simulating

IF_A, IF_NOT_A = 0b01, 0b10


def relation(rows: list[list[Edge]]) -> list[int]:
    """Return the bit sets of simulating states."""
    return simulating(rows, Letters(edge.literals for row in rows for edge in row))


def test_more_letters_and_more_marks_simulate() -> None:
    """A state that does the same on more letters, or with more marks, simulates; not conversely."""
    assert relation([[Edge(IF_A, 0, 0)], [Edge(0, 1, 0)]]) == [0b11, 0b10]
    assert relation([[Edge(0, 0, 0)], [Edge(0, 1, 1)]]) == [0b11, 0b10]


def test_letters_are_matched_one_by_one() -> None:
    """One edge on all letters is matched by two edges that share them out."""
    rows = [[Edge(0, 0, 1)], [Edge(IF_A, 1, 1), Edge(IF_NOT_A, 1, 1)]]
    assert relation(rows) == [0b11, 0b11]


def test_targets_must_simulate_in_turn() -> None:
    """A difference far away refutes."""
    rows = [[Edge(0, 1, 0)], [Edge(0, 4, 0)], [Edge(0, 3, 0)], [Edge(IF_A, 4, 0)], [Edge(0, 4, 1)]]
    above = relation(rows)
    assert above[2] >> 0 & 1
    assert not above[0] >> 2 & 1


def test_with_many_atoms_inclusion_is_cautious() -> None:
    """Beyond eight atoms a cube counts as covered by a weaker cube alone."""
    far = 20
    rows = [[Edge(1 << far, 0, 1)], [Edge(0, 1, 1)], [Edge(1 << far, 2, 1), Edge(2 << far, 2, 1)]]
    assert relation(rows) == [0b111, 0b010, 0b110]
