"""What each place costs each agent when nobody may arrive later than a given time.

``BoundedCosts``  the costs c_i(z; τ), and the team strategies that attain them
"""

from collections.abc import Sequence
from typing import Final

import numpy as np
from numpy.typing import NDArray

from tlcomm_core.game.potential import potential
from tlcomm_core.game.problem import Profile, RoundProblem

__all__ = ["BoundedCosts"]

# An arrival isn't later than itself, counted from r·T_c and back.
_ROUNDING_S: Final = 1e-9


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
        self._arrival_s = [own.arrival_s for own in problem.candidates]
        self._gain_s = [
            own.extra_s - np.where(np.isfinite(own.arrival_s), own.arrival_s - self._opens_s, 0.0)
            for own in problem.candidates
        ]
        first_s = max(float(arrival_s.min()) for arrival_s in self._arrival_s)
        self.earliest_s = max(0.0, first_s - self._opens_s)

    def times_s(self) -> NDArray[np.float64]:
        """Return the arrivals that may be the communication time, ascending, fresh.

        The first is ``earliest_s``.
        """
        arrivals_s = np.concatenate([own.ravel() for own in self._arrival_s]) - self._opens_s
        later_s = arrivals_s[np.isfinite(arrivals_s) & (arrivals_s > self.earliest_s)]
        times_s: NDArray[np.float64] = np.unique(np.append(later_s, self.earliest_s))
        return times_s

    def at(self, latest_s: float) -> NDArray[np.float64]:
        """Return c_i(z; τ) for a bound τ, [N, Z], fresh; +inf where there is no candidate."""
        until_s = self._opens_s + latest_s + _ROUNDING_S
        return np.array(
            [
                np.where(arrival_s <= until_s, gain_s, np.inf).min(axis=0)
                for arrival_s, gain_s in zip(self._arrival_s, self._gain_s, strict=True)
            ]
        )

    def profile(self, locations: Sequence[int], latest_s: float) -> Profile:
        """Return the candidates that attain c_i(z_i; τ) at the places [N]."""
        until_s = self._opens_s + latest_s + _ROUNDING_S
        candidates = tuple(
            int(np.argmin(np.where(arrival_s[:, z] <= until_s, gain_s[:, z], np.inf)))
            for arrival_s, gain_s, z in zip(self._arrival_s, self._gain_s, locations, strict=True)
        )
        return Profile(tuple(locations), candidates)

    def potential_s(self, profile: Profile) -> float:
        """Return Φ."""
        return potential(self._problem.strategies(profile), self._opens_s)

    def meeting_s(self, profile: Profile) -> float:
        """Return t_c."""
        chosen = zip(self._arrival_s, profile.candidate, profile.location, strict=True)
        last_s = max(float(arrival_s[h, z]) for arrival_s, h, z in chosen)
        return max(0.0, last_s - self._opens_s)
