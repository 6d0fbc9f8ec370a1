"""Spanning trees of meeting graphs."""

import networkx as nx
import numpy as np
import pytest

from tlcomm_core.game.links import Links
from tlcomm_core.game.search.spanning_tree import grown_tree, spanning_tree

LINE = Links(np.column_stack((np.arange(6.0), np.zeros(6))), 1.0).neighbourhood


@pytest.mark.parametrize("seed", range(10))
def test_a_grown_tree_joins_all(seed: int) -> None:
    """There is an edge less than agents, without a cycle."""
    rng = np.random.default_rng(seed)
    links = Links(rng.uniform(0.0, 2.0, (30, 2)), 1.0)
    edges = grown_tree(rng.uniform(size=(7, 30)), links.neighbourhood, 0)
    assert edges is not None
    assert nx.is_tree(nx.Graph(edges))
    assert len(nx.Graph(edges)) == 7


def test_who_loses_least_comes_first() -> None:
    """From the place 2, agent 1 is at its best within reach; agent 0 is joined to it, not to 2."""
    costs = np.array([[9.0, 9.0, 9.0, 9.0, 0.0, 9.0], [9.0, 9.0, 9.0, 0.0, 9.0, 9.0], [0.0] * 6])
    edges = grown_tree(costs, LINE, 2)
    assert edges is not None
    assert {frozenset(edge) for edge in edges} == {frozenset((0, 1)), frozenset((1, 2))}


def test_an_agent_out_of_reach_leaves_no_tree() -> None:
    """Agent 1 can only be where agent 0 reaches from nowhere."""
    costs = np.full((2, 6), np.inf)
    costs[0, 0] = costs[1, 5] = 0.0
    assert grown_tree(costs, LINE, 0) is None
    assert grown_tree(costs, LINE, 3) is None


def test_one_agent_needs_no_edge() -> None:
    """A team of one is a tree."""
    assert grown_tree(np.zeros((1, 6)), LINE, 0) == ()
    assert spanning_tree({4: 2}, LINE) == []


def test_a_spanning_tree_has_links_only() -> None:
    """Agents at neighbouring places are joined, breadth first from the first."""
    assert spanning_tree({3: 1, 5: 3, 7: 2, 8: 1}, LINE) == [(3, 7), (3, 8), (7, 5)]
