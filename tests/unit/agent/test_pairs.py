"""Who meets whom by turns: trees of small degree, coloured without more colours than that."""

from itertools import combinations
from pathlib import Path

import networkx as nx
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from support.hall import hall
from tlcomm_core.agent.pairs import Pair, colours, pairs_of, spanning_tree
from tlcomm_core.scenario.generator import random_scenario
from tlcomm_core.scenario.loader import load_scenario, verify
from tlcomm_core.scenario.model import Radio
from tlcomm_core.scenario.site import Site

SCENARIOS = Path(__file__).parents[3] / "scenarios"
Link = tuple[int, int]


@st.composite
def graphs(draw: st.DrawFn, most: int) -> nx.Graph:
    """Return a connected graph: a random tree, and any further links."""
    count = draw(st.integers(1, most))
    parents = [draw(st.integers(0, node - 1)) for node in range(1, count)]
    further = draw(st.sets(st.sampled_from([*combinations(range(count), 2), (0, 0)])))
    graph = nx.Graph()
    graph.add_nodes_from(range(count))
    graph.add_edges_from(enumerate(parents, start=1))
    graph.add_edges_from(link for link in further if link != (0, 0))
    return graph


def links_of(graph: nx.Graph) -> list[Link]:
    """Return a graph's links, the lesser node first, sorted."""
    return sorted((min(link), max(link)) for link in graph.edges)


def tree_of(graph: nx.Graph) -> nx.Graph:
    """Return the tree that is found, as a graph."""
    tree = nx.Graph()
    tree.add_nodes_from(graph)
    tree.add_edges_from(spanning_tree(len(graph), links_of(graph)))
    return tree


def largest_degree(graph: nx.Graph) -> int:
    """Return the most links of a node."""
    return max(degree for _, degree in graph.degree)


def least_degree(graph: nx.Graph) -> int:
    """Return the least largest degree of any spanning tree, by trying them all."""
    subgraphs = (nx.Graph(links) for links in combinations(graph.edges, len(graph) - 1))
    return min(
        largest_degree(tree) for tree in subgraphs if len(tree) == len(graph) and nx.is_tree(tree)
    )


@settings(max_examples=150, deadline=None)
@given(graphs(most=25))
def test_trees_span_and_neighbouring_links_differ_in_colour(graph: nx.Graph) -> None:
    """Every tree links all by links of the graph, with as many colours as the largest degree."""
    tree = tree_of(graph)
    assert nx.is_tree(tree)
    assert all(graph.has_edge(*link) for link in tree.edges)
    links = links_of(tree)
    found = colours(links)
    assert set(found) == set(range(largest_degree(tree)))
    for (link, colour), (other, others) in combinations(zip(links, found, strict=True), 2):
        assert colour != others or not {*link} & {*other}


@settings(max_examples=60, deadline=None)
@given(graphs(most=6).filter(lambda graph: len(graph) > 1))
def test_degrees_are_small(graph: nx.Graph) -> None:
    """At most one more than in any other spanning tree."""
    assert largest_degree(tree_of(graph)) <= least_degree(graph) + 1


def test_a_link_gives_way_where_that_helps() -> None:
    """Grown next to whoever has the fewest links, this tree would have a node with three."""
    graph = nx.Graph([(0, 1), (0, 4), (1, 2), (1, 3), (2, 4)])
    assert largest_degree(tree_of(graph)) == 2


@pytest.mark.parametrize("name", ["corridor", "plant", "warehouse"])
def test_shipped_teams_take_turns_of_two(name: str) -> None:
    """Each has a path through all its agents, so that every pair meets in every other window."""
    pairs = pairs_of(Site.from_scenario(load_scenario(SCENARIOS / f"{name}.yaml")))
    assert {pair.stride for pair in pairs} == {2}
    assert nx.is_tree(nx.Graph(pair.members for pair in pairs))


@pytest.mark.parametrize("seed", range(5))
def test_nobody_meets_two_in_one_window(seed: int) -> None:
    """In any window a pair's members are in no other pair."""
    scenario = random_scenario(np.random.default_rng(seed), agents=9)
    pairs = pairs_of(Site.from_scenario(scenario))
    assert len(pairs) == 8
    for window in range(1, 12):
        meeting = [name for pair in pairs if pair.meets_in(window) for name in pair.members]
        assert len(meeting) == len(set(meeting))


def test_pairs_meet_again_after_all_turns() -> None:
    """From t = 0 to their first window, and then in every C-th."""
    pair = Pair(("one", "two"), first=2, stride=3)
    windows = [0]
    for _ in range(4):
        windows.append(pair.after(windows[-1]))
    assert windows == [0, 2, 5, 8, 11]
    assert [pair.turn(window) for window in windows] == [0, 1, 2, 3, 4]
    assert [window for window in range(12) if pair.meets_in(window)] == windows[1:]


def test_who_doesnt_see_the_other_is_no_pair_with_it() -> None:
    """A wall between two of three leaves the third in the middle."""
    site = hall(3)
    names = {frozenset(pair.members) for pair in pairs_of(site)}
    assert names == {frozenset({"one", "two"}), frozenset({"one", "three"})}
    wall = (3.4, 0.7, 3.45, 0.8)
    scenario = site.scenario
    starts = {"one": (2.75, 0.75, 0.0), "two": (3.25, 1.25, 0.0), "three": (3.75, 0.75, 0.0)}
    agents = {
        name: own.model_copy(update={"start": starts[name]})
        for name, own in scenario.agents.items()
    }
    seeing = scenario.model_copy(
        update={
            "agents": agents,
            "radio": Radio(line_of_sight=True),
            "workspace": scenario.workspace.model_copy(update={"obstacles_m": [wall]}),
        }
    )
    names = {frozenset(pair.members) for pair in pairs_of(Site.from_scenario(verify(seeing)))}
    assert names == {frozenset({"one", "two"}), frozenset({"two", "three"})}


def test_a_single_agent_has_no_pair() -> None:
    """Nor a window."""
    assert pairs_of(hall(1)) == ()
    assert spanning_tree(1, []) == colours([]) == ()
