"""Smaller graphs for the same language.

- ``Edge``, ``Graph``   a generalized Büchi automaton with numbered atoms, under construction
- ``reduced``           without useless states, equal states merged
- ``degeneralized``     one acceptance mark instead of several
"""

from collections.abc import Callable, Hashable
from dataclasses import dataclass

from tlcomm_core.ltl.automaton import strong_components

__all__ = ["Edge", "Graph", "degeneralized", "reduced"]


@dataclass(frozen=True, slots=True, order=True)
class Edge:
    """An edge on the letters that satisfy a cube.

    Attributes:
        literals: bit 2i requires atom i, bit 2i + 1 forbids it.
        target: index of the state it leads to.
        marks: bit set of the acceptance marks that it carries.
    """

    literals: int
    target: int
    marks: int


@dataclass(frozen=True, slots=True)
class Graph:
    """A generalized Büchi automaton: a run must carry every mark again and again.

    Attributes:
        rows: per state its edges; state 0 is the initial one.
        mark_count: number of acceptance marks; with none, every run accepts.
    """

    rows: tuple[tuple[Edge, ...], ...]
    mark_count: int


def reduced(graph: Graph) -> Graph:
    """Return an equivalent graph with fewer states.

    States from which no run accepts go, marks that lie on no cycle go, edges that another one
    makes superfluous go, and states with the same edges are merged until none are left.

    Cost: quadratic in the edges of a state, times the number of merging passes.
    """
    graph = _renumbered(_without_idle_marks(_productive(graph)))
    while True:
        classes = _classes(graph)
        smaller = _renumbered(_mapped(graph, classes))
        if smaller == graph:
            return graph
        graph = smaller


def degeneralized(graph: Graph) -> Graph:
    """Return an equivalent graph with one mark.

    A counter waits for each of the marks in turn; the edge that brings the last one is accepting
    and the counter begins anew. It also begins anew on an edge that can't lie on a cycle.

    Source: Gastin and Oddoux, "Fast LTL to Büchi automata translation", 2001 (counting as many
    marks as an edge brings at once).
    Cost: up to ``mark_count`` times as many states.
    """
    component = _components(graph)

    def advance(node: tuple[int, int], edge: Edge) -> tuple[tuple[int, int], bool]:
        state, level = node
        if component[state] != component[edge.target]:
            return (edge.target, 0), False
        while level < graph.mark_count and edge.marks >> level & 1:
            level += 1
        accepting = level == graph.mark_count
        return (edge.target, 0 if accepting else level), accepting

    number: dict[tuple[int, int], int] = {(0, 0): 0}
    pending = [(0, 0)]
    rows: list[tuple[Edge, ...]] = []
    for node in pending:
        row = []
        for edge in graph.rows[node[0]]:
            target, accepting = advance(node, edge)
            if target not in number:
                number[target] = len(number)
                pending.append(target)
            row.append(Edge(edge.literals, number[target], int(accepting)))
        rows.append(tuple(row))
    return Graph(tuple(rows), 1)


def _components(graph: Graph) -> list[int]:
    return strong_components([[edge.target for edge in row] for row in graph.rows])


def _productive(graph: Graph) -> Graph:
    """Remove the edges into states from which no run accepts."""
    component = _components(graph)
    marks: dict[int, int] = {}
    for state, row in enumerate(graph.rows):
        for edge in row:
            if component[state] == component[edge.target]:
                marks[component[state]] = marks.get(component[state], 0) | edge.marks
    full = (1 << graph.mark_count) - 1
    alive = {state for state in range(len(graph.rows)) if marks.get(component[state]) == full}
    sources: list[list[int]] = [[] for _ in graph.rows]
    for state, row in enumerate(graph.rows):
        for edge in row:
            sources[edge.target].append(state)
    pending = list(alive)
    while pending:
        fresh = [source for source in sources[pending.pop()] if source not in alive]
        alive.update(fresh)
        pending += fresh
    return _filtered(graph, lambda _, edge: edge.marks if edge.target in alive else None)


def _without_idle_marks(graph: Graph) -> Graph:
    """Remove the marks of edges that lie on no cycle: no run takes them twice."""
    component = _components(graph)
    return _filtered(
        graph,
        lambda state, edge: edge.marks if component[state] == component[edge.target] else 0,
    )


def _filtered(graph: Graph, marks_of: Callable[[int, Edge], int | None]) -> Graph:
    """Give each edge new marks, or remove it where there are None."""
    rows = []
    for state, row in enumerate(graph.rows):
        kept = ((edge, marks_of(state, edge)) for edge in row)
        rows.append(tuple(Edge(e.literals, e.target, m) for e, m in kept if m is not None))
    return Graph(tuple(rows), graph.mark_count)


def _classes(graph: Graph) -> list[int]:
    """Return the coarsest partition in which equal states have equal edges into classes."""
    classes = [0] * len(graph.rows)
    count = 1
    while True:
        number: dict[Hashable, int] = {}
        fresh = []
        for state, row in enumerate(graph.rows):
            signature = (classes[state], frozenset(_irredundant(row, classes)))
            fresh.append(number.setdefault(signature, len(number)))
        if len(number) == count:
            return fresh
        classes, count = fresh, len(number)


def _irredundant(row: tuple[Edge, ...], classes: list[int]) -> list[Edge]:
    """Return the edges into classes, without those that another edge makes superfluous."""
    mapped = {Edge(edge.literals, classes[edge.target], edge.marks) for edge in row}
    groups: dict[int, list[Edge]] = {}
    for edge in sorted(mapped, key=lambda e: (e.literals.bit_count(), -e.marks.bit_count(), e)):
        group = groups.setdefault(edge.target, [])
        if not any(
            weaker.literals & edge.literals == weaker.literals
            and weaker.marks & edge.marks == edge.marks
            for weaker in group
        ):
            group.append(edge)
    return [edge for group in groups.values() for edge in group]


def _mapped(graph: Graph, classes: list[int]) -> Graph:
    """Return the quotient; the initial state's class is 0, as it is met first."""
    rows: dict[int, tuple[Edge, ...]] = {}
    for state, row in enumerate(graph.rows):
        rows.setdefault(classes[state], tuple(_irredundant(row, classes)))
    return Graph(tuple(rows[index] for index in range(len(rows))), graph.mark_count)


def _renumbered(graph: Graph) -> Graph:
    """Keep the states that can be reached, numbered in the order of a breadth-first search."""
    number = {0: 0}
    pending = [0]
    for state in pending:
        for edge in graph.rows[state]:
            if edge.target not in number:
                number[edge.target] = len(number)
                pending.append(edge.target)
    rows = (
        tuple(Edge(edge.literals, number[edge.target], edge.marks) for edge in graph.rows[state])
        for state in pending
    )
    return Graph(tuple(rows), graph.mark_count)
