"""Coalitions that join themselves anew."""

import networkx as nx
import numpy as np
import pytest

from tlcomm_core.game.links import Links
from tlcomm_core.game.search.placement import cheapest_placement
from tlcomm_core.game.search.regrouping import regroup
from tlcomm_core.game.search.spanning_tree import grown_tree
from tlcomm_core.game.search.tree_programme import TreeProgramme


def sample(seed: int, team: int) -> TreeProgramme:
    """Return the programme of a first tree for random costs on a lattice."""
    rng = np.random.default_rng(seed)
    x, y = np.meshgrid(np.arange(8.0), np.arange(8.0))
    links = Links(np.column_stack((x.ravel(), y.ravel())), 1.5)
    homes_m = rng.uniform(0.0, 7.0, (team, 2))
    costs = np.linalg.norm(homes_m[:, None] - links.locations_m, axis=2)
    edges = grown_tree(costs, links.neighbourhood, 0)
    assert edges is not None
    return TreeProgramme(costs, links.neighbourhood, edges)


@pytest.mark.parametrize("seed", range(8))
def test_a_coalition_of_all_finds_the_optimum(seed: int) -> None:
    """One tree is as good as another to begin with."""
    programme = sample(seed, 5)
    programme = regroup(programme, programme._neighbourhood, 5, np.random.default_rng(0))
    optimum = cheapest_placement(programme.costs, programme._neighbourhood)
    assert programme.cost() == pytest.approx(optimum.cost)


@pytest.mark.parametrize("seed", range(8))
def test_costs_fall_until_nobody_gains(seed: int) -> None:
    """Never do they rise, and the tree stays a tree."""
    programme, rng = sample(seed, 12), np.random.default_rng(seed)
    costs = [programme.cost()]
    for _ in range(6):
        programme = regroup(programme, programme._neighbourhood, 4, rng)
        costs.append(programme.cost())
        assert nx.is_tree(nx.Graph(programme.edges))
    assert costs[1] < costs[0]
    assert sorted(costs, reverse=True) == costs
