"""One acceptance mark instead of several."""

import pytest

from tlcomm_core.ltl.degeneralization import degeneralized
from tlcomm_core.ltl.graph import Edge, Graph

IF_A, IF_NOT_A = 0b01, 0b10


def test_one_mark_waits_for_all_in_turn() -> None:
    """Two marks on different edges of one state need two states; both at once accept at once."""
    graph = Graph(((Edge(IF_A, 0, 1), Edge(IF_NOT_A, 0, 2), Edge(0, 0, 0)),), 2)
    assert degeneralized(graph) == Graph(
        (
            (Edge(IF_A, 1, 0), Edge(IF_NOT_A, 0, 0), Edge(0, 0, 0)),
            (Edge(IF_A, 1, 0), Edge(IF_NOT_A, 0, 1), Edge(0, 1, 0)),
        ),
        1,
    )
    both = Graph(((Edge(IF_A, 0, 3),),), 2)
    assert degeneralized(both) == Graph(((Edge(IF_A, 0, 1),),), 1)


def test_without_marks_every_edge_on_a_cycle_accepts() -> None:
    """A graph with nothing to wait for accepts all the time."""
    assert degeneralized(Graph(((Edge(0, 0, 0),),), 0)) == Graph(((Edge(0, 0, 1),),), 1)


def ring(marks: tuple[int, ...], mark_count: int) -> Graph:
    """Return a graph of one cycle whose edges carry these marks."""
    size = len(marks)
    rows = tuple((Edge(0, (i + 1) % size, mark),) for i, mark in enumerate(marks))
    return Graph(rows, mark_count)


@pytest.mark.parametrize(
    ("any_order", "rounds"), [(False, 2), (True, 1)], ids=["in turn", "in any order"]
)
def test_in_any_order_one_round_is_enough(any_order: bool, rounds: int) -> None:
    """On a cycle with the marks 0, 2, 1 a counter accepts every other round, a memory each."""
    graph = degeneralized(ring((0b001, 0b100, 0b010), 3), any_order=any_order)
    (accepting,) = [(state, e) for state, row in enumerate(graph.rows) for e in row if e.marks]
    start = state = accepting[1].target
    steps = 0
    while state != start or not steps:
        state = graph.rows[state][0].target
        steps += 1
    assert steps == 3 * rounds


def test_many_marks_in_any_order_are_counted() -> None:
    """Six marks on one state make six states, not 32."""
    edges = tuple(Edge(1 << 2 * mark, 0, 1 << mark) for mark in range(6))
    graph = degeneralized(Graph((edges,), 6), any_order=True)
    assert len(graph.rows) == 6
    assert len(degeneralized(Graph((edges[:5],), 5), any_order=True).rows) == 16
