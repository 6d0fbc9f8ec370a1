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
        for layer in _layers(count):
            tops = costs[layer.members] + self.hanging[layer.below]
            self.topped[layer.subsets] = tops.min(axis=1)
            self.reached[layer.subsets] = neighbourhood.least(self.topped[layer.subsets])
            splits = self.reached[layer.parts] + self.hanging[layer.rests]
            self.hanging[layer.subsets] = splits.min(axis=1)

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


@dataclass(frozen=True, slots=True, eq=False)
class _Layer:
    """The subsets of one size k, as bit masks, with what the recursion needs of each.

    Attributes:
        subsets: int[n].
        members: int[n, k], agents.
        below: int[n, k], the subset without each member.
        parts: int[n, 2^(k−1)], its subsets with its first member.
        rests: int[n, 2^(k−1)], what each of these leaves.
    """

    subsets: NDArray[np.intp]
    members: NDArray[np.intp]
    below: NDArray[np.intp]
    parts: NDArray[np.intp]
    rests: NDArray[np.intp]


@cache
def _layers(count: int) -> tuple[_Layer, ...]:
    """Return the non-empty subsets of ``count`` agents by size, ascending."""
    layers = []
    for size in range(1, count + 1):
        chosen = [subset for subset in range(1 << count) if subset.bit_count() == size]
        subsets = np.array(chosen, dtype=np.intp)
        members = np.array([_members(subset) for subset in chosen], dtype=np.intp)
        parts = np.array([_parts_with_first(subset) for subset in chosen], dtype=np.intp)
        below = subsets[:, None] ^ (1 << members)
        layers.append(_Layer(subsets, members, below, parts, subsets[:, None] ^ parts))
    return tuple(layers)


@cache
def _members(subset: int) -> list[int]:
    return [agent for agent in range(subset.bit_length()) if subset >> agent & 1]


@cache
def _parts_with_first(subset: int) -> NDArray[np.intp]:
    """Return all subsets of a set with its first member, as bit masks; read-only."""
    first = subset & -subset
    parts = [part for part in range(1, subset + 1) if part & first and part & subset == part]
    masks = np.array(parts, dtype=np.intp)
    masks.setflags(write=False)
    return masks
