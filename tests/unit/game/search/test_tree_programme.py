"""Placements along a tree, against brute force."""

from itertools import product

import numpy as np
import pytest

from tlcomm_core.game.links import Links, Neighbourhood
from tlcomm_core.game.search.tree_programme import TreeProgramme

TREES = {
    "one": (),
    "two": ((0, 1),),
    "chain": ((2, 0), (0, 3), (3, 1)),
    "star": ((1, 0), (1, 2), (1, 3)),
}


def sample(
    seed: int, edges: tuple[tuple[int, int], ...], *, is_apart: bool = False
) -> TreeProgramme:
    """Return the programme of a tree over random places and costs."""
    rng = np.random.default_rng(seed)
    links = Links(rng.uniform(0.0, 2.0, (6, 2)), 1.0)
    costs = rng.normal(size=(len(edges) + 1, 6))
    costs[rng.uniform(size=costs.shape) < 0.2] = np.inf
    return TreeProgramme(costs, links.neighbourhood_apart(0.5 * is_apart), edges)


def costs_along(
    programme: TreeProgramme, neighbourhood: Neighbourhood
) -> dict[tuple[int, ...], float]:
    """Return what each placement costs whose joined agents are neighbours."""
    near = [set(neighbourhood.near(place).tolist()) for place in range(len(neighbourhood))]
    return {
        places: float(sum(programme.costs[range(programme.team), places]))
        for places in product(range(len(near)), repeat=programme.team)
        if all(places[v] in near[places[u]] for u, v in programme.edges)
    }


@pytest.mark.parametrize("is_apart", [False, True])
@pytest.mark.parametrize("tree", TREES)
@pytest.mark.parametrize("seed", range(6))
def test_no_placement_along_the_tree_is_cheaper(seed: int, tree: str, is_apart: bool) -> None:
    """The cost is the least of all, whichever agent's place is looked at; the places have it."""
    programme = sample(seed, TREES[tree], is_apart=is_apart)
    options = costs_along(programme, programme._neighbourhood)
    least = min(options.values(), default=np.inf)
    assert programme.cost() == pytest.approx(least)
    for agent in range(programme.team):
        assert programme.costs_of(agent).min() == pytest.approx(least)
    if np.isfinite(least):
        assert options[programme.locations()] == pytest.approx(least)


@pytest.mark.parametrize("seed", range(10))
def test_what_is_left_out_costs_nothing(seed: int) -> None:
    """Without a neighbour, and what lies behind it, an agent's costs are those of the rest."""
    programme = sample(seed, TREES["chain"])
    alone = programme.costs_of(0, frozenset((2, 3)))
    assert alone.tolist() == programme.costs[0].tolist()
    with_leaf = alone + programme._neighbourhood.least(programme.costs[2])
    assert programme.costs_of(0, frozenset((3,))).tolist() == with_leaf.tolist()


@pytest.mark.parametrize("seed", range(10))
def test_a_part_costs_what_it_would_alone(seed: int) -> None:
    """Cut at an edge, by the place of each of its agents, nearer ones first."""
    programme = sample(seed, ((0, 1), (1, 2), (2, 3), (2, 4), (0, 5)))
    part = programme.behind(1, 0)
    assert sorted(part) == [1, 2, 3, 4]
    assert part[:2] == [1, 2]
    rank = {agent: place for place, agent in enumerate(part)}
    edges = [(rank[u], rank[v]) for u, v in ((1, 2), (2, 3), (2, 4))]
    alone = TreeProgramme(programme.costs[part], programme._neighbourhood, edges)
    for agent, costs in enumerate(programme.costs_within(part)):
        assert costs == pytest.approx(alone.costs_of(agent))


def test_a_path_follows_the_tree() -> None:
    """From either end."""
    programme = sample(0, ((0, 1), (1, 2), (2, 3), (2, 4), (0, 5)))
    assert programme.path(5, 3) == [5, 0, 1, 2, 3]
    assert programme.path(3, 5) == [3, 2, 1, 0, 5]
    assert programme.path(4, 4) == [4]


@pytest.mark.parametrize("seed", range(10))
def test_a_changed_tree_forgets_what_it_changed(seed: int) -> None:
    """After a subtree is joined anew, all is as in a programme that begins with that tree."""
    programme = sample(seed, ((0, 1), (1, 2), (2, 3), (3, 4), (1, 5)))
    programme.cost()
    for agent in range(6):
        programme.costs_of(agent)
    programme = programme.rejoined((1, 2, 3), ((1, 3), (3, 2)))
    fresh = TreeProgramme(programme.costs, programme._neighbourhood, programme.edges)
    assert set(map(frozenset, programme.edges)) == {
        frozenset(edge) for edge in ((0, 1), (1, 3), (3, 2), (3, 4), (1, 5))
    }
    for agent in range(6):
        assert programme.costs_of(agent) == pytest.approx(fresh.costs_of(agent))


def test_the_order_follows_the_tree() -> None:
    """Each agent but the first is joined to one before it."""
    programme = sample(0, TREES["chain"])
    order = programme.order
    assert sorted(order) == [0, 1, 2, 3]
    for rank, agent in enumerate(order[1:], start=1):
        assert set(programme.neighbours(agent)) & set(order[:rank])
