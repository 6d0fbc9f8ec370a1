"""Places that the rules of meetings allow, near to places that only a tree of links holds together.

``adjusted_places``  agents placed one after the other, each where the rules leave it open
"""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from tlcomm_core.game.problem import RoundProblem

__all__ = ["adjusted_places"]


def adjusted_places(
    problem: RoundProblem,
    costs: NDArray[np.float64],
    wanted: Sequence[int],
    order: Sequence[int],
) -> tuple[int, ...] | None:
    """Return places that the team may meet at, as wanted where that can be.

    In the given order, each agent takes the place wanted for it if that is open beside those taken
    before, otherwise the cheapest open one; among equals the lowest.

    Args:
        problem: the round.
        costs: float[N, Z], c_i(z); +inf where the agent can't be.
        wanted: a place for each agent.
        order: all agents; the first is placed first.

    Returns:
        Admissible places, ``wanted`` itself if it is; ``None`` if an agent finds none open.
    """
    if problem.is_admissible(wanted):
        return tuple(wanted)
    found = list(wanted)
    taken: list[int] = []
    for agent in order:
        is_open = problem.open_places(taken)
        if not is_open[found[agent]]:
            open_costs = np.where(is_open, costs[agent], np.inf)
            found[agent] = int(np.argmin(open_costs))
            if not np.isfinite(open_costs[found[agent]]):
                return None
        taken.append(found[agent])
    return tuple(found) if problem.is_admissible(found) else None
