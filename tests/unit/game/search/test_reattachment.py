"""Parts of a tree that are joined elsewhere."""

import networkx as nx
import numpy as np
import pytest

from tlcomm_core.game.links import Links
from tlcomm_core.game.search.reattachment import reattach
from tlcomm_core.game.search.tree_programme import TreeProgramme

LATTICE = np.column_stack([axis.ravel() for axis in np.meshgrid(np.arange(8.0), np.arange(8.0))])
LINKS = Links(LATTICE, 1.5)


def chain(seed: int, team: int) -> TreeProgramme:
    """Return the programme of a chain of agents with random homes, in any order."""
    homes_m = np.random.default_rng(seed).uniform(0.0, 7.0, (team, 2))
    costs = np.linalg.norm(homes_m[:, None] - LATTICE, axis=2)
    edges = [(agent, agent + 1) for agent in range(team - 1)]
    return TreeProgramme(costs, LINKS.neighbourhood, edges)


@pytest.mark.parametrize("seed", range(8))
def test_costs_fall_and_the_tree_stays_a_tree(seed: int) -> None:
    """A chain in the order of names is a poor tree; what is told is what a fresh programme has."""
    programme = chain(seed, 9)
    before = programme.cost()
    programme = reattach(programme, LINKS.neighbourhood)
    assert programme.cost() < before
    assert nx.is_tree(nx.Graph(programme.edges))
    fresh = TreeProgramme(programme.costs, LINKS.neighbourhood, programme.edges)
    assert programme.cost() == pytest.approx(fresh.cost())


def test_costs_never_rise() -> None:
    """What is promised isn't always kept: then the tree stays as it was."""
    for seed in range(30):
        programme = chain(seed, 7)
        costs = [programme.cost()]
        for _ in range(4):
            programme = reattach(programme, LINKS.neighbourhood)
            costs.append(programme.cost())
        assert costs == sorted(costs, reverse=True)


def test_an_end_is_joined_to_whom_it_is_near() -> None:
    """Agent 3 lives beside agent 0, out of range of agent 2 to which it is joined."""
    homes_m = np.array([[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [0.0, 1.0]])
    costs = np.linalg.norm(homes_m[:, None] - LATTICE, axis=2)
    programme = TreeProgramme(costs, LINKS.neighbourhood, [(0, 1), (1, 2), (2, 3)])
    assert programme.cost() > 0.5
    programme = reattach(programme, LINKS.neighbourhood)
    assert programme.cost() == 0.0
    assert 2 not in programme.neighbours(3)


def test_the_best_tree_is_left_alone() -> None:
    """Three in a row at their homes: nothing is gained."""
    homes_m = np.array([[0.0, 0.0], [1.0, 0.0], [2.0, 0.0]])
    costs = np.linalg.norm(homes_m[:, None] - LATTICE, axis=2)
    programme = TreeProgramme(costs, LINKS.neighbourhood, [(0, 1), (1, 2)])
    programme = reattach(programme, LINKS.neighbourhood)
    assert programme.edges == ((0, 1), (1, 2))
    assert programme.cost() == 0.0
