"""Smaller graphs: useless states, equal states, superfluous edges."""

from tlcomm_core.ltl.graph import Edge, Graph
from tlcomm_core.ltl.reduction import reduced

IF_A, IF_NOT_A = 0b01, 0b10


def test_states_without_an_accepting_run_go() -> None:
    """Dead ends and cycles that lack a mark disappear with the edges into them."""
    graph = Graph(
        (
            (Edge(0, 0, 1), Edge(0, 1, 1), Edge(0, 2, 0)),
            (Edge(0, 1, 0),),
            (),
        ),
        1,
    )
    assert reduced(graph) == Graph(((Edge(0, 0, 1),),), 1)


def test_a_graph_that_accepts_nothing_keeps_its_initial_state_alone() -> None:
    """With no accepting run, one state without edges is left."""
    assert reduced(Graph(((Edge(0, 1, 0),), (Edge(0, 0, 0),)), 1)) == Graph(((),), 1)


def test_equal_states_are_merged() -> None:
    """Two states with the same edges become one; states that differ in a mark don't."""
    twins = Graph(((Edge(IF_A, 1, 1), Edge(IF_NOT_A, 0, 1)), (Edge(IF_A, 0, 1),)), 1)
    assert len(reduced(twins).rows) == 2
    equal = Graph(
        ((Edge(IF_A, 1, 1), Edge(IF_NOT_A, 0, 1)), (Edge(IF_A, 0, 1), Edge(IF_NOT_A, 1, 1))), 1
    )
    assert len(reduced(equal).rows) == 1
    marked = Graph(((Edge(0, 1, 1),), (Edge(0, 0, 0),)), 1)
    assert len(reduced(marked).rows) == 2


def test_superfluous_edges_go() -> None:
    """An edge with a stronger guard and fewer marks to the same state is dropped."""
    graph = Graph(((Edge(IF_A, 0, 0), Edge(0, 0, 1)),), 1)
    assert reduced(graph) == Graph(((Edge(0, 0, 1),),), 1)
