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
    table = np.full((1 << count, costs.shape[1]), np.inf)
    reached = np.full_like(table, np.inf)
    table[1 << np.arange(count)] = costs
    for layer in _layers(count):
        for subset in layer.tolist():
            if subset & (subset - 1):
                table[subset] = _cheapest_split(table, reached, subset)
        reached[layer] = neighbourhood.least(table[layer])
    everybody = (1 << count) - 1
    root = int(np.argmin(table[everybody]))
    locations = [root] * count
    cost = float(table[everybody, root])
    if np.isfinite(cost):
        _trace(table, reached, neighbourhood, everybody, root, locations)
    return Placement(cost, tuple(locations))


def _cheapest_split(
    table: NDArray[np.float64], reached: NDArray[np.float64], subset: int
) -> NDArray[np.float64]:
    """Return the least of g(A, z) + min g(B, z') over all splits of a set, float[Z].

    With an axis for each agent, the parts A are a view of the table, and what they leave is the
    same view of the other one, backwards: nothing is copied before it is added. The empty part and
    the whole are +inf as yet.
    """
    count = len(table).bit_length() - 1
    members = [subset >> agent & 1 for agent in reversed(range(count))]
    inside = tuple(slice(None) if is_member else 0 for is_member in members)
    backwards = (slice(None, None, -1),) * sum(members)
    shape = (2,) * count + table.shape[1:]
    totals = table.reshape(shape)[inside] + reached.reshape(shape)[inside][backwards]
    least: NDArray[np.float64] = totals.reshape(-1, table.shape[1]).min(axis=0)
    return least


@cache
def _layers(count: int) -> tuple[NDArray[np.intp], ...]:
    """Return the subsets of each size from 1 on, as bit masks."""
    subsets = np.arange(1 << count)
    sizes = np.array([subset.bit_count() for subset in range(1 << count)])
    return tuple(subsets[sizes == size] for size in range(1, count + 1))


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
        onward = neighbourhood.cheapest(table[rest], place)
        _trace(table, reached, neighbourhood, rest, onward, locations)
        subset = part
    locations[subset.bit_length() - 1] = place
