"""Automata of conjunctions, put together from the automata of their parts.

- ``Guards``           what guards a graph's edges, by number
- ``CubeGuards``       disjunctions of cubes by number, joined once per pair
- ``grouped``          a graph with one edge per target and marks, guarded by such a number
- ``ungrouped``        back to an edge per cube
- ``composed``         the automaton of the words that several automata accept

Expanding a conjunction as a whole multiplies all its parts' cubes before any of them is known to
be superfluous. Here each part is reduced by itself, and after each factor so is the product.

Source: Babiak, Badie, Duret-Lutz, Křetínský and Strejček, "Compositional approach to suspension and
other improvements to LTL translation", 2013; generalized acceptance on transitions as in Couvreur,
"On-the-fly verification of linear temporal logic", 1999.
"""

from collections.abc import Iterable, Sequence
from itertools import product as pairs_of
from typing import Final, Protocol

from tlcomm_core.ltl.expansion import antichain
from tlcomm_core.ltl.graph import Edge, Graph, check_size
from tlcomm_core.ltl.reduction import productive, reduced

__all__ = ["CubeGuards", "Guards", "composed", "grouped", "ungrouped"]

# Products with more cubes than this aren't reduced between two factors.
_MOST_CUBES: Final = 400


class Guards(Protocol):
    """Guards by number; equal ones have the same."""

    def number(self, cubes: Iterable[int]) -> int:
        """Return the number of the guard that is the disjunction of some cubes."""
        ...

    def cubes(self, guard: int) -> tuple[int, ...]:
        """Return the cubes of a guard; none if no letter passes it."""
        ...

    def both(self, one: int, other: int) -> int | None:
        """Return the number of the conjunction of two guards, None if no letter passes it."""
        ...


class CubeGuards:
    """Guards as sets of cubes, known by number so that equal ones are joined once.

    A cube is an integer: bit 2i requires atom i, bit 2i + 1 forbids it.
    """

    def __init__(self, atom_count: int) -> None:
        """Begin with no guard."""
        self._required = sum(1 << (2 * atom) for atom in range(atom_count))
        self._cubes: list[tuple[int, ...]] = []
        self._number: dict[tuple[int, ...], int] = {}
        self._both: dict[tuple[int, int], int | None] = {}

    def number(self, cubes: Iterable[int]) -> int:
        """Return the number of the guard that is the disjunction of some cubes."""
        kept = antichain(cubes)
        found = self._number.setdefault(kept, len(self._cubes))
        if found == len(self._cubes):
            self._cubes.append(kept)
        return found

    def cubes(self, guard: int) -> tuple[int, ...]:
        """Return the cubes of a guard; none contains another."""
        return self._cubes[guard]

    def both(self, one: int, other: int) -> int | None:
        """Return the number of the conjunction of two guards, None if no letter passes it."""
        key = (one, other) if one < other else (other, one)
        if key not in self._both:
            self._both[key] = self._joined(*key)
        return self._both[key]

    def _joined(self, one: int, other: int) -> int | None:
        joined = {mine | yours for mine, yours in pairs_of(self._cubes[one], self._cubes[other])}
        kept = [cube for cube in joined if not cube & (cube >> 1) & self._required]
        return self.number(kept) if kept else None


def grouped(graph: Graph, guards: Guards) -> Graph:
    """Return a graph whose edges to the same target with the same marks are one.

    The ``literals`` of its edges are numbers of guards.
    """
    return Graph(tuple(_grouped_row(row, guards) for row in graph.rows), graph.mark_count)


def ungrouped(graph: Graph, guards: Guards) -> Graph:
    """Return a grouped graph with an edge per cube."""
    rows = (
        tuple(Edge(cube, e.target, e.marks) for e in row for cube in guards.cubes(e.literals))
        for row in graph.rows
    )
    return Graph(tuple(rows), graph.mark_count)


def composed(graphs: Sequence[Graph], guards: Guards) -> Graph:
    """Return a grouped graph that accepts the words which all of some graphs accept.

    Its marks are the first graph's, then the second's, and so on.

    Args:
        graphs: at least one, grouped.
        guards: where the guards' numbers come from.

    Raises:
        IntractableTaskError: a product is too large.
    Cost: the product of the numbers of grouped edges.
    """
    result = graphs[0]
    for graph in graphs[1:]:
        result = productive(_product(result, graph, guards))
        cubes = sum(len(guards.cubes(edge.literals)) for row in result.rows for edge in row)
        if cubes <= _MOST_CUBES:
            result = grouped(reduced(ungrouped(result, guards)), guards)
    return result


def _grouped_row(row: Iterable[Edge], guards: Guards) -> tuple[Edge, ...]:
    cubes: dict[tuple[int, int], list[int]] = {}
    for edge in row:
        cubes.setdefault((edge.target, edge.marks), []).append(edge.literals)
    numbered = ((guards.number(group), key) for key, group in cubes.items())
    return tuple(Edge(guard, *key) for guard, key in numbered if guards.cubes(guard))


def _product(one: Graph, other: Graph, guards: Guards) -> Graph:
    """Return the pairs of states that can be reached, each edge with the marks of both."""
    number = {(0, 0): 0}
    pending = [(0, 0)]
    rows: list[tuple[Edge, ...]] = []
    edges = 0
    for left, right in pending:
        row = []
        for mine, yours in pairs_of(one.rows[left], other.rows[right]):
            guard = guards.both(mine.literals, yours.literals)
            if guard is None:
                continue
            target = (mine.target, yours.target)
            if target not in number:
                number[target] = len(number)
                pending.append(target)
            marks = mine.marks | yours.marks << one.mark_count
            row.append(Edge(guard, number[target], marks))
        rows.append(tuple(row))
        edges += len(row)
        check_size(len(number), edges)
    return Graph(tuple(rows), one.mark_count + other.mark_count)
