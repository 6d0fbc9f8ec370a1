"""Hops and connection against networkx."""

from itertools import combinations

import networkx as nx
from hypothesis import given
from hypothesis import strategies as st

from tlcomm_core.world.radio import diameter, is_connected, neighbours

Edges = list[tuple[int, int]]


@st.composite
def graphs(draw: st.DrawFn) -> tuple[int, Edges]:
    """Draw a number of nodes and edges between them."""
    count = draw(st.integers(1, 9))
    pairs = list(combinations(range(count), 2))
    return count, draw(st.lists(st.sampled_from(pairs), unique=True)) if pairs else []


@given(graphs())
def test_hops_agree_with_networkx(case: tuple[int, Edges]) -> None:
    """Diameter, connection and neighbours are those of the graph library."""
    count, edges = case
    graph = nx.empty_graph(count)
    graph.add_edges_from(edges)
    connected = nx.is_connected(graph)
    assert is_connected(count, edges) is connected
    assert diameter(count, edges) == (nx.diameter(graph) if connected else None)
    assert [set(nodes) for nodes in neighbours(count, edges)] == [
        set(graph.adj[node]) for node in range(count)
    ]
