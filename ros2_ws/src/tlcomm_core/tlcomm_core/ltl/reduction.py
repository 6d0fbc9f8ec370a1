"""Smaller graphs for the same language.

- ``reduced``           without useless states, states that simulate each other merged
- ``productive``        without the edges that lie on no accepting run
- ``renumbered``        without the states that can't be reached
"""

from collections.abc import Callable, Hashable
from typing import Final

from tlcomm_core.ltl.automaton import strong_components
from tlcomm_core.ltl.graph import Edge, Graph
from tlcomm_core.ltl.simulation import Letters, simulating

__all__ = ["productive", "reduced", "renumbered"]

# Beyond so many edges, or pairs of a state and an edge, only equal states are merged.
_MOST_EDGES: Final = 2_000
_MOST_PAIRS: Final = 100_000
# Beyond so many comparisons of edges, not even those.
_MOST_COMPARISONS: Final = 5_000_000
_MOST_ROUNDS: Final = 10


def reduced(graph: Graph) -> Graph:
    """Return an equivalent graph with fewer states.

    States from which no run accepts go, states with the same edges are merged, then states that
    simulate each other, and edges that others make superfluous go, until nothing changes. On edges
    that lie on no cycle marks mean nothing: the simulation is sought both with all and with none
    there; at the end they have none.

    Source: see ``simulation``; edges that another one's target simulates are Somenzi and Bloem's
        "little brothers".
    Cost: quadratic in the edges of a state, times the number of merging passes; for graphs with
        up to 2,000 edges and 100,000 pairs of a state and an edge, the simulation's cost too.
    """
    for _ in range(_MOST_ROUNDS):
        before = graph
        for idle_marks in (-1, 0):
            graph = _with_idle_marks(productive(graph), idle_marks)
            graph = _bisimulation_quotient(graph)
            edges = sum(map(len, graph.rows))
            if edges <= _MOST_EDGES and len(graph.rows) * edges <= _MOST_PAIRS:
                graph = _simulation_quotient(graph)
        if graph == before:
            break
    return graph


def _bisimulation_quotient(graph: Graph) -> Graph:
    graph = renumbered(graph)
    while True:
        smaller = renumbered(_mapped(graph, _classes(graph)))
        if smaller == graph:
            return graph
        graph = smaller


def _simulation_quotient(graph: Graph) -> Graph:
    """Merge the states that simulate each other and remove the edges that are matched."""
    letters = Letters(edge.literals for row in graph.rows for edge in row)
    above = simulating(graph.rows, letters)
    classes = [
        next(
            other
            for other in range(state + 1)
            if above[state] >> other & 1 and above[other] >> state & 1
        )
        for state in range(len(graph.rows))
    ]
    rows = []
    for row in graph.rows:
        moved = sorted({Edge(e.literals, classes[e.target], e.marks) for e in row})
        rows.append(_unmatched(moved, above, letters))
    return renumbered(Graph(tuple(rows), graph.mark_count))


def _unmatched(row: list[Edge], above: list[int], letters: Letters) -> tuple[Edge, ...]:
    """Remove, one after another, the edges whose letters better remaining ones cover."""
    kept = sorted(row, key=lambda e: (-e.literals.bit_count(), e.marks.bit_count(), e))
    for edge in list(kept):
        offer = 0
        for other in kept:
            if (
                other is not edge
                and above[edge.target] >> other.target & 1
                and not edge.marks & ~other.marks
            ):
                offer |= letters.of(other.literals)
        if not letters.of(edge.literals) & ~offer:
            kept.remove(edge)
    return tuple(sorted(kept))


def _components(graph: Graph) -> list[int]:
    return strong_components([[edge.target for edge in row] for row in graph.rows])


def productive(graph: Graph) -> Graph:
    """Return a graph without the edges into states from which no run accepts.

    Such states themselves stay, out of reach.
    """
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


def _with_idle_marks(graph: Graph, marks: int) -> Graph:
    """Give the edges that lie on no cycle these marks: no run takes them twice."""
    component = _components(graph)
    idle = marks & ((1 << graph.mark_count) - 1)
    return _filtered(
        graph,
        lambda state, edge: edge.marks if component[state] == component[edge.target] else idle,
    )


def _filtered(graph: Graph, marks_of: Callable[[int, Edge], int | None]) -> Graph:
    """Give each edge new marks, or remove it where there are None."""
    rows = []
    for state, row in enumerate(graph.rows):
        kept = ((edge, marks_of(state, edge)) for edge in row)
        rows.append(tuple(Edge(e.literals, e.target, m) for e, m in kept if m is not None))
    return Graph(tuple(rows), graph.mark_count)


def _classes(graph: Graph) -> list[int]:
    """Return the coarsest partition in which equal states have equal edges into classes.

    If that takes too long, every state is a class of its own.
    """
    classes = [0] * len(graph.rows)
    count = 1
    cost = sum(len(row) + len(row) ** 2 // 16 for row in graph.rows)
    for _ in range(1 + _MOST_COMPARISONS // (cost + 1)):
        number: dict[Hashable, int] = {}
        fresh = []
        for state, row in enumerate(graph.rows):
            signature = (classes[state], frozenset(_irredundant(row, classes)))
            fresh.append(number.setdefault(signature, len(number)))
        if len(number) == count:
            return fresh
        classes, count = fresh, len(number)
    return list(range(len(graph.rows)))


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


def renumbered(graph: Graph) -> Graph:
    """Return the states that can be reached, in the order of a breadth-first search."""
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
