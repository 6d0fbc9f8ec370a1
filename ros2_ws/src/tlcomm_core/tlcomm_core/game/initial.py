"""The initial team strategy: everybody at one place, chosen exactly, or around one.

``initial_profile``  S⁰, the least potential over all common places and admissible times
"""

from typing import Final

import numpy as np
from numpy.typing import NDArray

from tlcomm_core.errors import InfeasibleRoundError
from tlcomm_core.game.formation import cheapest_formation
from tlcomm_core.game.problem import Profile, RoundProblem

__all__ = ["initial_profile"]

# Places searched together: enough to outweigh numpy's calls, few enough to stop early.
_CHUNK: Final = 64
# A lower bound and the sum that it bounds are added up in different orders.
_BOUND_TOLERANCE_S: Final = 1e-6


def initial_profile(problem: RoundProblem) -> Profile:
    """Return the common place and the candidates of least potential.

    Among equal potentials the lowest place wins, there the earliest communication time, then each
    agent's lowest candidate. The arithmetic is elementary, so equal inputs give equal outcomes on
    every machine.

    Args:
        problem: at least one agent.

    Returns:
        S⁰, with one location for all; a formation if the rules demand a separation.

    Raises:
        InfeasibleRoundError: some agents have no admissible candidate, or no place is
            admissible for all.

    Source: Eq. (9) and "Optimization of Initial Strategy" in Section IV-B3 of the paper. For a
        place z and a bound τ on the arrivals, the best h of agent i is the one with t ≤ τ and the
        least δ − t, and Φ = N·max(τ, r·T_c) + Σ_i min(δ − t); the least over all arrivals τ is
        exact.
    Deviates: agents that mustn't share a place begin in a formation around one.
    Cost: O(N·H·Z) for lower bounds, then O(N·H·(N + log(N·H))) for each place that these leave.
    """
    _check_feasible(problem)
    table = _Table(problem)
    bound_s = table.lower_bounds()
    if not np.isfinite(bound_s).any():
        _, closes_s = problem.window_s
        raise InfeasibleRoundError(
            f"round {problem.round}: no place that all of {', '.join(problem.agents)} "
            f"reach before {closes_s!r} s"
        )
    if problem.rules.separation_m:
        return _spread(problem, bound_s)
    location, latest_s = _best_place(table, bound_s)
    return Profile(
        location=(location,) * len(problem.agents),
        candidate=table.best_candidates(location, latest_s),
    )


def _check_feasible(problem: RoundProblem) -> None:
    stranded = [own.agent for own in problem.candidates if not np.isfinite(own.arrival_s).any()]
    if stranded:
        opens_s, closes_s = problem.window_s
        raise InfeasibleRoundError(
            f"round {problem.round}: no candidate that arrives in time for the window "
            f"[{opens_s!r}, {closes_s!r}) s for {', '.join(stranded)}"
        )


def _spread(problem: RoundProblem, bound_s: NDArray[np.float64]) -> Profile:
    """Return the cheapest formation around the places in the order of their bounds."""
    order = np.argsort(bound_s, kind="stable")
    profile = cheapest_formation(problem, order[np.isfinite(bound_s[order])].tolist())
    if profile is None:
        raise InfeasibleRoundError(
            f"round {problem.round}: no {len(problem.agents)} places at least "
            f"{problem.rules.separation_m!r} m apart that all of {', '.join(problem.agents)} "
            "reach in time and that are connected as the scenario demands"
        )
    return profile


def _best_place(table: "_Table", bound_s: NDArray[np.float64]) -> tuple[int, float]:
    """Return the best place and its τ, searching the most promising places first."""
    order = np.argsort(bound_s, kind="stable")
    best = (np.inf, 0, 0.0)
    for start in range(0, len(order), _CHUNK):
        # In ascending order, so that the first of equals is the lowest place.
        places = np.sort(order[start : start + _CHUNK])
        if bound_s[order[start]] > best[0] + _BOUND_TOLERANCE_S:
            break
        potential_s, latest_s = table.sweep(places)
        least = int(np.argmin(potential_s))
        best = min(best, (float(potential_s[least]), int(places[least]), float(latest_s[least])))
    _, location, latest = best
    return location, latest


class _Table:
    """All agents' candidates in one array of K = Σ_i H_i rows; times count from r·T_c.

    Attributes:
        since_s: [K, Z] t; +inf where inadmissible.
        extra_s: [K, Z] δ; +inf where inadmissible.
        gain_s: [K, Z] δ − t; +inf where inadmissible.
        owner: [K] which agent's row.
        starts: [N] each agent's first row.
        meeting_s: [Z] the earliest meeting: when the slowest agent can be there, not before
            the window opens; +inf where somebody can't.
    """

    def __init__(self, problem: RoundProblem) -> None:
        opens_s, _ = problem.window_s
        heights = [len(own.task_index) for own in problem.candidates]
        self.since_s = np.concatenate([own.arrival_s for own in problem.candidates]) - opens_s
        self.extra_s = np.concatenate([own.extra_s for own in problem.candidates])
        self.gain_s = self.extra_s - np.where(np.isfinite(self.since_s), self.since_s, 0.0)
        self.owner = np.repeat(np.arange(len(heights)), heights)
        self.starts = np.cumsum([0, *heights[:-1]])
        self.meeting_s = np.maximum(self._least(self.since_s).max(axis=0), 0.0)

    def lower_bounds(self) -> NDArray[np.float64]:
        """Return [Z] a bound on Φ at each place; +inf where the team can't meet.

        Nobody meets before the earliest meeting, so each agent adds at least δ and its wait until
        then, if any.
        """
        meeting_s = np.where(np.isfinite(self.meeting_s), self.meeting_s, 0.0)
        added_s = self.extra_s + np.maximum(meeting_s - self.since_s, 0.0)
        bound_s: NDArray[np.float64] = self._least(added_s).sum(axis=0)
        return bound_s

    def sweep(self, places: NDArray[np.intp]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Return the least Φ at each place and the τ of its first attainment, both [places].

        The bound τ rises from the earliest meeting over all later arrivals, while each agent keeps
        the best candidate so far.
        """
        meeting_s, since_s, gain_s = (
            times_s[..., places] for times_s in (self.meeting_s, self.since_s, self.gain_s)
        )
        is_late = since_s > meeting_s
        least_s = self._least(np.where(is_late, np.inf, gain_s))
        late_s = np.where(is_late, since_s, np.inf)
        depth = int(np.isfinite(late_s).sum(axis=0).max())
        # Equal arrivals may come in any order: the last of them has the least potential.
        order = np.argsort(late_s, axis=0)[:depth]
        bound_s = np.vstack((meeting_s, np.take_along_axis(late_s, order, axis=0)))
        gain_s = np.take_along_axis(gain_s, order, axis=0)
        owner = self.owner[order]
        potential_s = len(self.starts) * bound_s
        for agent, first_s in enumerate(least_s):
            own_s = np.vstack((first_s, np.where(owner == agent, gain_s, np.inf)))
            potential_s += np.minimum.accumulate(own_s, axis=0)
        rows = np.argmin(potential_s, axis=0)
        columns = np.arange(len(places))
        return potential_s[rows, columns], bound_s[rows, columns]

    def best_candidates(self, location: int, latest_s: float) -> tuple[int, ...]:
        """Return each agent's candidate at a place that arrives by τ with the least δ − t."""
        in_time = self.since_s[:, location] <= latest_s
        gain_s = np.where(in_time, self.gain_s[:, location], np.inf)
        return tuple(int(np.argmin(own_s)) for own_s in np.split(gain_s, self.starts[1:]))

    def _least(self, times_s: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return the least of each agent's rows, [N, …] of [K, …]."""
        least_s: NDArray[np.float64] = np.minimum.reduceat(times_s, self.starts, axis=0)
        return least_s
