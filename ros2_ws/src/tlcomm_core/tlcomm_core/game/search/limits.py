"""Where single agents must or mustn't be: how placements that the rules forbid are ruled out.

``Limits``     what was decided so far
``contested``  the agent to decide on next
"""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from tlcomm_core.game.links import Links
from tlcomm_core.game.rules import Rules, crowding, indispensable

__all__ = ["Limits", "contested"]


@dataclass(frozen=True, slots=True)
class Limits:
    """Decisions on single agents.

    Attributes:
        kept: agents with the place that each stays at.
        banned: agents with places that each stays away from.
    """

    kept: tuple[tuple[int, int], ...] = ()
    banned: tuple[tuple[int, int], ...] = ()

    def decide(self, agent: int, place: int) -> tuple["Limits", "Limits"]:
        """Return both ways to go on: the agent is at the place, or it isn't."""
        choice = (agent, place)
        return replace(self, kept=(*self.kept, choice)), replace(
            self, banned=(*self.banned, choice)
        )

    def applied(
        self, costs: NDArray[np.float64], links: Links, separation_m: float
    ) -> NDArray[np.float64]:
        """Return costs [N, Z] that are +inf where the decisions leave no room, fresh."""
        limited = costs.copy()
        for agent, place in self.banned:
            limited[agent, place] = np.inf
        for agent, place in self.kept:
            cost = limited[agent, place]
            limited[agent] = np.inf
            if separation_m:
                limited[:, links.crowded(place, separation_m)] = np.inf
            limited[agent, place] = cost
        return limited


def contested(links: Links, rules: Rules, places: tuple[int, ...], limits: Limits) -> int | None:
    """Return an agent whose place is to be decided on in a connected placement.

    That is one of those that the rules are broken by, else any that isn't decided on yet.

    Returns:
        The agent; None if all are decided on, so that the placement is out.
    """
    decided = {agent for agent, _ in limits.kept}
    broken = (*crowding(links, rules, places), *indispensable(links, rules, places))
    return next((agent for agent in (*broken, *range(len(places))) if agent not in decided), None)
