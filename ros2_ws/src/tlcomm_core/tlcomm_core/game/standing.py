"""When to meet, where everybody's place is given: the optimum.

``cheapest_times``  the team strategy of least potential
"""

import numpy as np

from tlcomm_core.game.problem import Profile, RoundProblem

__all__ = ["cheapest_times"]


def cheapest_times(problem: RoundProblem) -> Profile:
    """Return the team strategy of least potential where each agent has a single location.

    For a fixed bound on t_c the agents don't depend on each other: each takes the candidate of
    least δ − t that arrives by then. The optimum's own t_c is one of the arrivals, or the window's
    opening; of these bounds the best is taken. As a global minimum of Φ it is an equilibrium.

    Args:
        problem: every agent has candidates, at one location only.

    Cost: O(N·H·T) for T distinct arrival times.
    """
    places = [int(np.flatnonzero(np.isfinite(own.arrival_s[0]))[0]) for own in problem.candidates]
    arrivals_s = [
        own.arrival_s[:, place] for own, place in zip(problem.candidates, places, strict=True)
    ]
    extras_s = [
        own.extra_s[:, place] for own, place in zip(problem.candidates, places, strict=True)
    ]
    opens_s, _ = problem.window_s
    bounds_s = np.unique(np.maximum(np.concatenate(arrivals_s), opens_s))
    total_s = len(places) * bounds_s
    chosen = []
    for arrival_s, extra_s in zip(arrivals_s, extras_s, strict=True):
        is_there = arrival_s[:, None] <= bounds_s[None, :]
        costs_s = np.where(is_there, (extra_s - arrival_s)[:, None], np.inf)
        chosen.append(np.argmin(costs_s, axis=0))
        total_s = total_s + costs_s.min(axis=0)
    best = int(np.argmin(total_s))
    return Profile(tuple(places), tuple(int(rows[best]) for rows in chosen))
