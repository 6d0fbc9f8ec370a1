"""One acceptance mark instead of several.

- ``degeneralized``   an equivalent graph with one mark
"""

from typing import Final

from tlcomm_core.ltl.automaton import strong_components
from tlcomm_core.ltl.graph import Edge, Graph, check_size

__all__ = ["degeneralized"]

# The order of more marks than this in one component is fixed even where any would do.
_MOST_IN_ANY_ORDER: Final = 5


def degeneralized(graph: Graph, *, any_order: bool = False) -> Graph:
    """Return an equivalent graph with one mark.

    A counter waits for each of the marks in turn; the edge that brings the last one is accepting
    and the counter begins anew. It also begins anew on an edge that can't lie on a cycle.

    Within a strongly connected component it waits only for marks that no other mark there entails.

    Args:
        graph: an automaton with any number of marks.
        any_order: remember which marks have come instead, in a component that waits for up to
            five of them; an accepting edge brings the last of them after all others. Then each
            cycle with all marks, however ordered, is an accepting one of the same length; with a
            counter, three or more marks in the wrong order take several rounds.

    Raises:
        IntractableTaskError: it would be too large.
    Source: Gastin and Oddoux, "Fast LTL to Büchi automata translation", 2001 (counting as many
        marks as an edge brings at once).
    Cost: up to k = ``mark_count`` times as many states; in any order, 2ᵏ⁻¹ times.
    """
    component = strong_components([[edge.target for edge in row] for row in graph.rows])
    needed = _needed_marks(graph, component)

    def advance(node: tuple[int, int], edge: Edge) -> tuple[tuple[int, int], bool]:
        state, level = node
        if component[state] != component[edge.target]:
            return (edge.target, 0), False
        wanted = needed[component[state]]
        remembers = any_order and len(wanted) <= _MOST_IN_ANY_ORDER
        after = (_remembered if remembers else _counted)(level, edge.marks, wanted)
        return (edge.target, after or 0), after is None

    number: dict[tuple[int, int], int] = {(0, 0): 0}
    pending = [(0, 0)]
    rows: list[tuple[Edge, ...]] = []
    edges = 0
    for node in pending:
        row = []
        for edge in graph.rows[node[0]]:
            target, accepting = advance(node, edge)
            if target not in number:
                number[target] = len(number)
                pending.append(target)
            row.append(Edge(edge.literals, number[target], int(accepting)))
        rows.append(tuple(row))
        edges += len(row)
        check_size(len(number), edges)
    return Graph(tuple(rows), 1)


def _counted(level: int, marks: int, wanted: list[int]) -> int | None:
    """Return how many marks have come in turn after an edge; None if all have."""
    while level < len(wanted) and marks >> wanted[level] & 1:
        level += 1
    return None if level == len(wanted) else level


def _remembered(seen: int, marks: int, wanted: list[int]) -> int | None:
    """Return which marks but the last have come after an edge; None if the last completes them."""
    if not wanted:
        return None
    others = sum(1 << mark for mark in wanted[:-1])
    seen |= marks & others
    return None if seen == others and marks >> wanted[-1] & 1 else seen


def _needed_marks(graph: Graph, component: list[int]) -> dict[int, list[int]]:
    """Return per component the marks to wait for: none whose edges include another's edges."""
    inside: dict[int, set[int]] = {label: set() for label in component}
    for state, row in enumerate(graph.rows):
        for edge in row:
            if component[state] == component[edge.target]:
                inside[component[state]].add(edge.marks)
    return {label: _minimal_marks(sets, graph.mark_count) for label, sets in inside.items()}


def _minimal_marks(sets: set[int], count: int) -> list[int]:
    full = (1 << count) - 1
    if full in sets and len(sets) == 1:
        return []
    # Per mark the other marks that every edge with it carries too.
    entailed = [full] * count
    for marks in sets:
        for mark in range(count):
            if marks >> mark & 1:
                entailed[mark] &= marks
    kept = full
    for mark in range(count):
        others = kept & ~(1 << mark)
        if any(others >> other & 1 and entailed[other] >> mark & 1 for other in range(count)):
            kept = others
    return [mark for mark in range(count) if kept >> mark & 1]
