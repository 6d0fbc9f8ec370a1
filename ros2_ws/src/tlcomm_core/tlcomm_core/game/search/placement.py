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

    A spanning tree of a connected placement can be hung up by any agent, here by the last. With
    g(S, z) the least cost of a subtree of the agents S whose top is at z, and h(S, z) that of
    subtrees of S that together hang from somebody at z:

        g(S, z) = min over i in S of c_i(z) + h(S − {i}, z)
        h(S, z) = min over A ⊆ S of (min over z' linked to z of g(A, z')) + h(S − A, z)

    where A is the subtree with the first agent of S, and h is 0 for nobody.

    Among equally cheap placements the same one is found wherever the costs are the same.

    Args:
        costs: float[N, Z], c_i(z); +inf where the agent can't be.
        neighbourhood: of the Z places.

    Returns:
        The optimum; its cost is +inf, and its places mean nothing, if there is none.

    Source: after Dreyfus and Wagner, "The Steiner problem in graphs" (1971), here with costs at
        nodes and several agents at one place.
    Cost: O(3^(N−1)·Z + 2^N·Z·(N + D)) time, O(2^N·Z) memory.
    """
    programme = _Programme(costs, neighbourhood)
    top = len(costs) - 1
    everybody_else = (1 << top) - 1
    totals = costs[top] + programme.hanging[everybody_else]
    root = int(np.argmin(totals))
    cost = float(totals[root])
    locations = [root] * len(costs)
    if np.isfinite(cost):
        programme.write_hanging(everybody_else, root, locations)
    return Placement(cost, tuple(locations))


class _Programme:
    """The tables of g and h, by subsets (bit masks) of all agents but the last.

    Attributes:
        topped: float[2^(N−1), Z], g.
        reached: float[2^(N−1), Z], the least of g over the neighbours of each place.
        hanging: float[2^(N−1), Z], h.
    """

    def __init__(self, costs: NDArray[np.float64], neighbourhood: Neighbourhood) -> None:
        count = len(costs) - 1
        self._costs = costs
        self._neighbourhood = neighbourhood
        self.hanging = np.zeros((1 << count, costs.shape[1]))
        self.topped = np.empty_like(self.hanging)
        self.reached = np.empty_like(self.hanging)
        lattice = (2,) * count + costs.shape[1:]
        reached, hanging = self.reached.reshape(lattice), self.hanging.reshape(lattice)
        for subsets in _layers(count):
            for subset in subsets:
                members = _members(subset)
                rests = [subset ^ (1 << agent) for agent in members]
                self.topped[subset] = (costs[members] + self.hanging[rests]).min(axis=0)
            layer = list(subsets)
            self.reached[layer] = neighbourhood.least(self.topped[layer])
            for subset in subsets:
                # All splits at once: the subtrees A are a view, and what they leave is the same
                # view backwards.
                parts, rests_of_parts = _splits(count, subset)
                splits = reached[parts] + hanging[rests_of_parts]
                self.hanging[subset] = splits.reshape(-1, costs.shape[1]).min(axis=0)

    def write_hanging(self, subset: int, place: int, locations: list[int]) -> None:
        """Write the places of the subtrees of ``subset`` that hang from a place."""
        while subset:
            parts = _parts_with_first(subset)
            rests = subset ^ parts
            best = int(np.argmin(self.reached[parts, place] + self.hanging[rests, place]))
            part = int(parts[best])
            self._write_topped(
                part, self._neighbourhood.cheapest(self.topped[part], place), locations
            )
            subset = int(rests[best])

    def _write_topped(self, subset: int, place: int, locations: list[int]) -> None:
        """Write the places of a subtree of ``subset`` with its top at a place."""
        members = _members(subset)
        rests = [subset ^ (1 << agent) for agent in members]
        best = int(np.argmin(self._costs[members, place] + self.hanging[rests, place]))
        locations[members[best]] = place
        self.write_hanging(rests[best], place, locations)


@cache
def _members(subset: int) -> list[int]:
    return [agent for agent in range(subset.bit_length()) if subset >> agent & 1]


@cache
def _layers(count: int) -> tuple[tuple[int, ...], ...]:
    """Return the subsets of each size from 1 on."""
    return tuple(
        tuple(subset for subset in range(1 << count) if subset.bit_count() == size)
        for size in range(1, count + 1)
    )


@cache
def _splits(count: int, subset: int) -> tuple[tuple[slice | int, ...], tuple[slice | int, ...]]:
    """Return the indices of all parts of a set with its first member, and of what each leaves.

    They are for tables with an axis for each of ``count`` agents, the last agent's first.
    """
    first = (subset & -subset).bit_length() - 1
    parts: list[slice | int] = []
    rests: list[slice | int] = []
    for agent in reversed(range(count)):
        is_free = bool(subset >> agent & 1) and agent != first
        parts.append(slice(None) if is_free else int(agent == first))
        rests.append(slice(None, None, -1) if is_free else 0)
    return tuple(parts), tuple(rests)


@cache
def _parts_with_first(subset: int) -> NDArray[np.intp]:
    """Return all subsets of a set with its first member, as bit masks; read-only."""
    first = subset & -subset
    parts = [part for part in range(1, subset + 1) if part & first and part & subset == part]
    masks = np.array(parts, dtype=np.intp)
    masks.setflags(write=False)
    return masks
