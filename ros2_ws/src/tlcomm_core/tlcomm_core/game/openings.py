"""Where each agent of a team may go while the others stay, for all agents at once.

``Openings``  the places open to each
"""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from tlcomm_core.game.problem import RoundProblem
from tlcomm_core.game.rules import lone_cuts

__all__ = ["Openings"]


class Openings:
    """The places open to each agent of a team whose places are admissible.

    An agent that the others can do without may go wherever it is linked to another: how many are
    linked to each place is counted once for all. The same holds for how many are too close to it.
    """

    def __init__(self, problem: RoundProblem, places: Sequence[int]) -> None:
        """Count for a team.

        Args:
            problem: the round.
            places: of all agents, admissible.
        """
        links, rules = problem.links, problem.rules
        self._problem = problem
        self._places = places
        near = np.concatenate([links.near(place) for place in places])
        self._linked = np.bincount(near, minlength=len(links))
        self._crowding = np.zeros(len(links), dtype=np.int64)
        if rules.separation_m:
            for place in places:
                self._crowding += links.crowded(place, rules.separation_m)
        # Whoever is alone in the team, or matters to how the others are connected.
        self._is_special = len(places) == 1 or rules.resilience > 0
        self._cuts = frozenset() if self._is_special else lone_cuts(links, places)

    def around(self, agent: int) -> NDArray[np.intp]:
        """Return the open places, ascending, that are linked to the agent's own."""
        near = self._problem.links.near(self._places[agent])
        if self._is_bound(agent):
            kept: NDArray[np.intp] = near[self._open_beside_others(agent)[near]]
            return kept
        is_open = self._linked[near] > 1
        if self._problem.rules.separation_m:
            is_open &= self._crowding[near] == self._crowded_by(agent)[near]
        free: NDArray[np.intp] = near[is_open]
        return free

    def everywhere(self, agent: int) -> NDArray[np.intp]:
        """Return all open places, ascending."""
        if self._is_bound(agent):
            return np.flatnonzero(self._open_beside_others(agent))
        is_open = self._linked > 0
        near = self._problem.links.near(self._places[agent])
        is_open[near] = self._linked[near] > 1
        if self._problem.rules.separation_m:
            is_open &= self._crowding == self._crowded_by(agent)
        return np.flatnonzero(is_open)

    def _is_bound(self, agent: int) -> bool:
        """Return whether more than a link to any other is asked of the agent's place."""
        return self._is_special or self._places[agent] in self._cuts

    def _open_beside_others(self, agent: int) -> NDArray[np.bool_]:
        return self._problem.open_places(
            [*self._places[:agent], *self._places[agent + 1 :]],
        )

    def _crowded_by(self, agent: int) -> NDArray[np.bool_]:
        rules = self._problem.rules
        return self._problem.links.crowded(self._places[agent], rules.separation_m)
