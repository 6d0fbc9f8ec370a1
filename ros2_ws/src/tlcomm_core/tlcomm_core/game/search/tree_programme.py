"""The cheapest placement of a team along a spanning tree of its meeting graph.

``TreeProgramme``  the placement, by messages along the tree
"""

from collections.abc import Iterable, Sequence

import numpy as np
from numpy.typing import NDArray

from tlcomm_core.game.links import Neighbourhood
from tlcomm_core.game.search.spanning_tree import Edge

__all__ = ["TreeProgramme"]


class TreeProgramme:
    """The cheapest placement in which agents joined by a tree's edges are linked.

    A message from agent u to its neighbour v says what it costs to place all that lies behind u, by
    the place of v: m_uv(z) = min over z' linked to z of c_u(z') + Σ_w m_wu(z'), over u's other
    neighbours w. Messages are computed when they are needed, and are kept where a tree is changed
    elsewhere.

    Attributes:
        costs: float[N, Z], c_i(z); +inf where the agent can't be.

    Cost: O(Z·D) for each message; 2·(N − 1) of them hold all about a tree.
    """

    def __init__(
        self, costs: NDArray[np.float64], neighbourhood: Neighbourhood, edges: Iterable[Edge]
    ) -> None:
        """Begin with a tree.

        Args:
            costs: float[N, Z], c_i(z); +inf where the agent can't be.
            neighbourhood: of the Z places.
            edges: N − 1 pairs of agents, a tree.
        """
        self.costs = costs
        self._neighbourhood = neighbourhood
        self._neighbours: list[list[int]] = [[] for _ in costs]
        self._join(edges)
        # By sender and receiver: the sum before its least is taken, and the message.
        self._sums: dict[Edge, NDArray[np.float64]] = {}
        self._messages: dict[Edge, NDArray[np.float64]] = {}

    @property
    def team(self) -> int:
        """N."""
        return len(self.costs)

    @property
    def edges(self) -> tuple[Edge, ...]:
        """The tree, each edge once."""
        return tuple((u, v) for u, near in enumerate(self._neighbours) for v in near if u < v)

    def cost(self) -> float:
        """Return the least cost of a placement along the tree; +inf if there is none."""
        return float(self.costs_of(0).min())

    @property
    def order(self) -> tuple[int, ...]:
        """All agents, each but the first joined to one before."""
        return (0, *(u for _, u in self._outward(0)))

    def neighbours(self, agent: int) -> tuple[int, ...]:
        """Return whom an agent is joined to."""
        return tuple(self._neighbours[agent])

    def costs_of(self, agent: int, but: frozenset[int] = frozenset()) -> NDArray[np.float64]:
        """Return the least cost of all by the place of one agent, float[Z], fresh.

        Args:
            agent: whose place.
            but: neighbours of it that are left out, with all that lies behind them.
        """
        costs: NDArray[np.float64] = self.costs[agent].copy()
        for other in self._neighbours[agent]:
            if other not in but:
                costs += self._message(other, agent)
        return costs

    def costs_within(self, part: Sequence[int]) -> list[NDArray[np.float64]]:
        """Return the least cost of a part of the tree by the place of each of its agents.

        Args:
            part: what lies behind an edge, as ``behind`` returns it: nearer agents first.

        Returns:
            float[Z] for each of the part, fresh.
        """
        beyond = frozenset(self._neighbours[part[0]]) - frozenset(part)
        nearer: dict[int, frozenset[int]] = {part[0]: beyond}
        above = {part[0]: np.zeros(len(self._neighbourhood))}
        for agent in part:
            for other in self._neighbours[agent]:
                if other not in nearer[agent]:
                    nearer[other] = frozenset((agent,))
                    rest = self.costs_of(agent, nearer[agent] | {other}) + above[agent]
                    above[other] = self._neighbourhood.least(rest)
        return [self.costs_of(agent, nearer[agent]) + above[agent] for agent in part]

    def behind(self, sender: int, receiver: int) -> list[int]:
        """Return the sender and all that an edge parts from the receiver, nearer ones first."""
        found = [(sender, receiver)]
        for u, v in found:
            found += [(w, u) for w in self._neighbours[u] if w != v]
        return [u for u, _ in found]

    def path(self, first: int, last: int) -> list[int]:
        """Return the agents from one to another along the tree."""
        before = {u: v for v, u in self._outward(first)}
        path = [last]
        while path[-1] != first:
            path.append(before[path[-1]])
        return path[::-1]

    def locations(self) -> tuple[int, ...]:
        """Return the cheapest placement; one must exist."""
        found = [0] * len(self.costs)
        found[0] = int(np.argmin(self.costs_of(0)))
        for v, u in self._outward(0):
            found[u] = self._neighbourhood.cheapest(self._sums[u, v], found[v])
        return tuple(found)

    def rejoined(self, members: Sequence[int], edges: Iterable[Edge]) -> "TreeProgramme":
        """Return the programme of a tree with other edges among some agents.

        Args:
            members: agents that form a subtree.
            edges: another tree of them, which takes its place.
        """
        inside = frozenset(members)
        kept = [(u, v) for u, v in self.edges if not (u in inside and v in inside)]
        other = TreeProgramme(self.costs, self._neighbourhood, [*kept, *edges])
        for v, u in self._outward(members[0]):
            if u not in inside and (u, v) in self._messages:
                other._sums[u, v] = self._sums[u, v]
                other._messages[u, v] = self._messages[u, v]
        return other

    def _join(self, edges: Iterable[Edge]) -> None:
        for u, v in edges:
            self._neighbours[u].append(v)
            self._neighbours[v].append(u)

    def _outward(self, root: int) -> list[Edge]:
        """Return all edges outwards from an agent, the nearer end first."""
        order = [(root, other) for other in self._neighbours[root]]
        for v, u in order:
            order += [(u, w) for w in self._neighbours[u] if w != v]
        return order

    def _message(self, sender: int, receiver: int) -> NDArray[np.float64]:
        pending = [(sender, receiver)]
        for u, v in pending:
            if (u, v) not in self._messages:
                pending += [(w, u) for w in self._neighbours[u] if w != v]
        for u, v in reversed(pending):
            if (u, v) not in self._messages:
                total = self.costs_of(u, frozenset((v,)))
                self._sums[u, v] = total
                self._messages[u, v] = self._neighbourhood.least(total)
        return self._messages[sender, receiver]
