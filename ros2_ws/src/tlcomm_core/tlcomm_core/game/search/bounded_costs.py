"""What each place costs each agent when nobody may arrive later than a given time.

``BoundedCosts``  the costs c_i(z; τ), and the team strategies that attain them
"""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from tlcomm_core.game.potential import potential
from tlcomm_core.game.problem import Profile, RoundProblem

__all__ = ["BoundedCosts"]


class BoundedCosts:
    """The agents' costs for bounded arrivals; times count from r·T_c.

    For a bound τ on the arrivals the problem falls apart: Φ = N·max(τ, 0) + Σ_i c_i(z_i; τ), where
    c_i(z; τ) is the least δ − t over the candidates h with t ≤ τ.

    Attributes:
        team: N.
        earliest_s: the earliest time at which everybody can be anywhere, not before 0.

    Source: Problem 2 of the paper, Eq. (5).
    """

    def __init__(self, problem: RoundProblem) -> None:
        """Take a round's candidates.

        Args:
            problem: at least one agent; each with an admissible candidate.
        """
        self.team = len(problem.candidates)
        self._problem = problem
        self._opens_s, _ = problem.window_s
        self._since_s = [own.arrival_s - self._opens_s for own in problem.candidates]
        self._gain_s = [
            own.extra_s - np.where(np.isfinite(since_s), since_s, 0.0)
            for own, since_s in zip(problem.candidates, self._since_s, strict=True)
        ]
        self.earliest_s = max(0.0, *(float(since_s.min()) for since_s in self._since_s))

    def times_s(self) -> NDArray[np.float64]:
        """Return the arrivals that may be the communication time, ascending, fresh.

        The first is ``earliest_s``.
        """
        arrivals_s = np.concatenate([since_s.ravel() for since_s in self._since_s])
        later_s = arrivals_s[np.isfinite(arrivals_s) & (arrivals_s > self.earliest_s)]
        times_s: NDArray[np.float64] = np.unique(np.append(later_s, self.earliest_s))
        return times_s

    def at(self, latest_s: float) -> NDArray[np.float64]:
        """Return c_i(z; τ) for a bound τ, [N, Z], fresh; +inf where there is no candidate."""
        return np.array(
            [
                np.where(since_s <= latest_s, gain_s, np.inf).min(axis=0)
                for since_s, gain_s in zip(self._since_s, self._gain_s, strict=True)
            ]
        )

    def profile(self, locations: Sequence[int], latest_s: float) -> Profile:
        """Return the candidates that attain c_i(z_i; τ) at the places [N]."""
        candidates = tuple(
            int(np.argmin(np.where(since_s[:, z] <= latest_s, gain_s[:, z], np.inf)))
            for since_s, gain_s, z in zip(self._since_s, self._gain_s, locations, strict=True)
        )
        return Profile(tuple(locations), candidates)

    def potential_s(self, profile: Profile) -> float:
        """Return Φ."""
        return potential(self._problem.strategies(profile), self._opens_s)

    def meeting_s(self, profile: Profile) -> float:
        """Return t_c."""
        chosen = zip(self._since_s, profile.candidate, profile.location, strict=True)
        return max(0.0, *(float(since_s[h, z]) for since_s, h, z in chosen))
