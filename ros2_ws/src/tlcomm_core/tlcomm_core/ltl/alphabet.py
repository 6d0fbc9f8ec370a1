"""Guards over the few letters that can occur.

- ``LetterGuards``   sets of letters, known by their bits
- ``sharpened``      a graph whose edges leave out the letters that better ones take
"""

from collections.abc import Collection, Iterable

from tlcomm_core.ltl.composition import ungrouped
from tlcomm_core.ltl.graph import Edge, Graph
from tlcomm_core.ltl.simulation import Letters, simulating

__all__ = ["LetterGuards", "sharpened"]


class LetterGuards:
    """Guards as sets of letters: the number of a guard has a bit per letter.

    A robot's words have few letters (it is in one region and performs one action), whereas the
    cubes of a product of automata multiply.
    """

    def __init__(self, atoms: tuple[str, ...], letters: Collection[frozenset[str]]) -> None:
        """Number the letters that differ in some of the atoms."""
        self._letters = tuple(dict.fromkeys(_literals(atoms, letter) for letter in letters))

    def number(self, cubes: Iterable[int]) -> int:
        """Return the guard that is the disjunction of some cubes."""
        distinct = set(cubes)
        return sum(
            1 << place
            for place, letter in enumerate(self._letters)
            if any(cube & letter == cube for cube in distinct)
        )

    def cubes(self, guard: int) -> tuple[int, ...]:
        """Return the letters of a guard, each as a cube with every atom."""
        return tuple(letter for place, letter in enumerate(self._letters) if guard >> place & 1)

    def both(self, one: int, other: int) -> int | None:
        """Return the conjunction of two guards, None if no letter passes it."""
        return one & other or None


def sharpened(graph: Graph, guards: LetterGuards) -> Graph:
    """Return an equivalent grouped graph in which, letter by letter, only the best edges are left.

    An edge is better than another if it carries at least its marks into a state that simulates the
    other's target. What is left is often deterministic, so that products have fewer edges.

    Source: see ``simulation``.
    """
    rows = ungrouped(graph, guards).rows
    above = simulating(rows, Letters(edge.literals for row in rows for edge in row))
    return Graph(tuple(_best(row, above) for row in graph.rows), graph.mark_count)


def _best(row: tuple[Edge, ...], above: list[int]) -> tuple[Edge, ...]:
    kept = list(row)
    for index, edge in enumerate(kept):
        letters = edge.literals
        for other in kept:
            better = above[edge.target] >> other.target & 1 and not edge.marks & ~other.marks
            if other is not edge and better:
                letters &= ~other.literals
        kept[index] = Edge(letters, edge.target, edge.marks)
    return tuple(edge for edge in kept if edge.literals)


def _literals(atoms: tuple[str, ...], letter: frozenset[str]) -> int:
    return sum((1 if name in letter else 2) << 2 * place for place, name in enumerate(atoms))
