"""Spanning trees of meeting graphs: who is linked to whom, without a cycle.

``Edge``           two linked agents
``grown_tree``     a first tree: agents added one by one, the cheapest to connect first
``spanning_tree``  a tree of links between agents at given places
"""

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from tlcomm_core.game.links import Neighbourhood

__all__ = ["Edge", "grown_tree", "spanning_tree"]

Edge = tuple[int, int]
"""Two agents, by their indices."""


def grown_tree(
    costs: NDArray[np.float64], neighbourhood: Neighbourhood, place: int
) -> tuple[Edge, ...] | None:
    """Return a tree of agents, each placed where it is cheapest within reach of those before.

    The next is always the one that loses least by being within reach rather than at its best place,
    among equals the first; the first agent's place is within reach of a given one.

    Args:
        costs: float[N, Z], c_i(z); +inf where the agent can't be.
        neighbourhood: of the Z places.
        place: where to begin.

    Returns:
        N − 1 edges between linked agents; ``None`` if some agent can't be reached.

    Source: Prim's algorithm, here with terminals that choose their places.
    Cost: O(N·Z + N²·D).
    """
    team, places = costs.shape
    least = costs.min(axis=1)
    loss = np.full(team, np.inf)
    best = np.zeros(team, dtype=np.intp)
    reached_by = np.full(places, -1, dtype=np.intp)
    waiting = np.ones(team, dtype=np.bool_)
    opened = np.unique(neighbourhood.near(place))
    edges: list[Edge] = []
    while waiting.any():
        if len(opened):
            offered = costs[:, opened]
            column = offered.argmin(axis=1)
            offer = offered[np.arange(team), column] - least
            better = offer < loss
            loss[better] = offer[better]
            best[better] = opened[column[better]]
        agent = int(np.argmin(np.where(waiting, loss, np.inf)))
        if not (waiting[agent] and np.isfinite(loss[agent])):
            return None
        if waiting.all():
            loss[:] = np.inf
        else:
            edges.append((int(reached_by[best[agent]]), agent))
        waiting[agent] = False
        near = np.unique(neighbourhood.near(int(best[agent])))
        opened = near[reached_by[near] < 0]
        reached_by[opened] = agent
    return tuple(edges)


def spanning_tree(places: Mapping[int, int], neighbourhood: Neighbourhood) -> list[Edge]:
    """Return a tree of links between agents, breadth first from the first of them.

    Args:
        places: of each agent; connected.
        neighbourhood: of all places.
    """
    first, *others = places
    edges: list[Edge] = []
    joined = [first]
    for u in joined:
        near = frozenset(neighbourhood.near(places[u]).tolist())
        reached = [v for v in others if places[v] in near]
        edges += [(u, v) for v in reached]
        joined += reached
        others = [v for v in others if places[v] not in near]
    assert not others, "the places are connected"
    return edges
