"""The cheapest connected placement of a team, each agent's costs by place given.

``cheapest_placement``  the optimum, by dynamic programming over subsets of agents
"""

from dataclasses import dataclass
from functools import cache

import numpy as np
from numpy.typing import NDArray

from tlcomm_core.game.links import Neighbourhood

__all__ = ["Placement", "cheapest_placement"]


@dataclass(frozen=True, slots=True)
class Placement:
    """One place per agent, such that the places are connected.

    Attributes:
        cost: Σ_i c_i(z_i).
        locations: per agent.
    """

    cost: float
    locations: tuple[int, ...]


def cheapest_placement(costs: NDArray[np.float64], neighbourhood: Neighbourhood) -> Placement:
    """Return the connected placement of least total cost.

    Let g(S, z) be the least cost of a connected placement of the agents S with one of them at z.
    A spanning tree of such a placement, rooted there, has a subtree that can be split off: so
    g(S, z) = min over S = A ∪ B of g(A, z) + min over z' linked to z of g(B, z').

    Among equally cheap placements the same one is found wherever the costs are the same.

    Args:
        costs: float[N, Z], c_i(z); +inf where the agent can't be.
        neighbourhood: of the Z places.

    Returns:
        The optimum; its cost is +inf, and its places mean nothing, if there is none.

    Source: the recursion of Dreyfus and Wagner, "The Steiner problem in graphs" (1971), here with
        costs at nodes and several agents at one place.
    Cost: O(3^N·Z + 2^N·Z·D) time, O(2^N·Z) memory.
    """
    count = len(costs)
    table = np.empty((1 << count, costs.shape[1]))
    reached = np.empty_like(table)
    for subset in range(1, 1 << count):
        if subset & (subset - 1):
            parts = _parts(subset)
            table[subset] = (table[parts] + reached[subset ^ parts]).min(axis=0)
        else:
            table[subset] = costs[subset.bit_length() - 1]
        reached[subset] = neighbourhood.least(table[subset])
    everybody = (1 << count) - 1
    root = int(np.argmin(table[everybody]))
    locations = [root] * count
    cost = float(table[everybody, root])
    if np.isfinite(cost):
        _trace(table, reached, neighbourhood, everybody, root, locations)
    return Placement(cost, tuple(locations))


@cache
def _parts(subset: int) -> NDArray[np.intp]:
    """Return all subsets of a set but itself and the empty one, as bit masks."""
    parts = []
    part = (subset - 1) & subset
    while part:
        parts.append(part)
        part = (part - 1) & subset
    masks = np.array(parts, dtype=np.intp)
    masks.setflags(write=False)
    return masks


def _trace(
    table: NDArray[np.float64],
    reached: NDArray[np.float64],
    neighbourhood: Neighbourhood,
    subset: int,
    place: int,
    locations: list[int],
) -> None:
    """Write the places of the optimal placement of ``subset`` with one of them at ``place``."""
    while subset & (subset - 1):
        parts = _parts(subset)
        part = int(parts[np.argmin(table[parts, place] + reached[subset ^ parts, place])])
        rest = subset ^ part
        near = neighbourhood.places[place]
        onward = int(near[np.argmin(table[rest, near])])
        _trace(table, reached, neighbourhood, rest, onward, locations)
        subset = part
    locations[subset.bit_length() - 1] = place
