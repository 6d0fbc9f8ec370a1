"""From an agent's offer to its candidates: arrival times and extra travel for all (z, h).

``candidates``  the tables of one agent
"""

from itertools import pairwise
from typing import Final

import numpy as np

from tlcomm_core.game.offer import MemberOffer
from tlcomm_core.game.problem import Candidates
from tlcomm_core.geometry import Pose
from tlcomm_core.workspace.travel import TravelTimes

__all__ = ["ROUNDING_S", "candidates"]

ROUNDING_S: Final = 1e-3
"""Kept free before the window's end, unless more is asked for: simulated time is rounded to
nanoseconds, each time anew."""


def candidates(
    offer: MemberOffer,
    departure_s: float,
    window_s: tuple[float, float],
    travel: TravelTimes,
    margin_s: float = ROUNDING_S,
) -> Candidates:
    """Return the strategies open to an agent in the window.

    Args:
        offer: its plan; the last stop is only what follows its forerunner.
        departure_s: when it leaves the present meeting, t_c + D_c (simulated time).
        window_s: [r·T_c, (r+1)·T_c) of the meeting to plan.
        travel: travel times with the agent's own motion.
        margin_s: kept free before the window's end.

    Returns:
        A row for each stop h but the last that has an admissible entry. An entry is admissible
        when z and the way back are reachable and the agent is there by the window's end less
        the margin; too early is admissible, as an agent can wait. None is if no way leads from
        stop h to the next: an offer may have been made with a later map.

    Source: Section IV-B1 of the paper: t_{i,s_i} is when stop h is finished plus T_i(π^h, z), and
        δ_{i,s_i} = T_i(π^h, z) + T_i(z, π^{h+1}) − T_i(π^h, π^{h+1}), headings included.
    Cost: O(Z) for each stop once ``travel`` has cached its searches.
    """
    shape = (max(len(offer.stops) - 1, 0), len(travel.grid))
    arrival_s, extra_s = np.full(shape, np.inf), np.full(shape, np.inf)
    for h, (stop, following) in enumerate(pairwise(offer.stops)):
        target = travel.grid.location_at(following.x_m, following.y_m)
        if target is None or not travel.grid.leads(stop.x_m, stop.y_m, target):
            continue
        detour = travel.detour(Pose(stop.x_m, stop.y_m, stop.yaw_rad), target)
        arrival_s[h] = (departure_s + stop.finish_offset_s) + detour.there_s
        extra_s[h] = detour.extra_s
    admissible = (arrival_s < window_s[1] - margin_s) & np.isfinite(extra_s)
    kept = admissible.any(axis=1)
    task_index = np.array([stop.task_index for stop in offer.stops[:-1]], dtype=np.int64)
    return Candidates(
        agent=offer.agent,
        task_index=task_index[kept],
        arrival_s=np.where(admissible, arrival_s, np.inf)[kept],
        extra_s=np.where(admissible, extra_s, np.inf)[kept],
    )
