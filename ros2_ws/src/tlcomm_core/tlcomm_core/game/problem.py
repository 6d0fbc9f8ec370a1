"""The round problem: every agent's candidates, and what makes a team strategy admissible.

``Candidates``    one agent's strategies (z, h) with arrival times and extra travel, as arrays
``RoundProblem``  Problem 2 of the paper for one round
``Choice``        one agent's strategy as indices into its candidates
``Profile``       a team strategy as indices
"""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from tlcomm_core.game.strategy import Strategy

__all__ = ["Candidates", "Choice", "Profile", "RoundProblem"]


@dataclass(frozen=True, slots=True, eq=False)
class Candidates:
    """The strategies open to one agent.

    Attributes:
        agent: whose.
        task_index: [H] the indices h, ascending.
        arrival_s: [H, Z] t_{i,(z,h)}; +inf where unreachable or not before the window's end.
        extra_s: [H, Z] δ_{i,(z,h)}; +inf where ``arrival_s`` is.
    """

    agent: str
    task_index: NDArray[np.int64]
    arrival_s: NDArray[np.float64]
    extra_s: NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class Choice:
    """One agent's strategy as indices: a location z and a row of its ``task_index``."""

    location: int
    candidate: int


@dataclass(frozen=True, slots=True)
class Profile:
    """A team strategy as indices: per agent a location z and a row of its ``task_index``."""

    location: tuple[int, ...]
    candidate: tuple[int, ...]

    def choice(self, agent: int) -> Choice:
        """Return one agent's part."""
        return Choice(self.location[agent], self.candidate[agent])

    def switched(self, agent: int, choice: Choice) -> "Profile":
        """Return this profile after one agent's switch."""
        location, candidate = list(self.location), list(self.candidate)
        location[agent], candidate[agent] = choice.location, choice.candidate
        return Profile(tuple(location), tuple(candidate))


@dataclass(frozen=True, eq=False)
class RoundProblem:
    """Problem 2 for round r.

    Attributes:
        round: r ≥ 1.
        window_s: [r·T_c, (r+1)·T_c).
        range_m: the range that places are planned with.
        locations_m: [Z, 2] every candidate place.
        candidates: per agent, sorted by the agent's name.
    """

    round: int
    window_s: tuple[float, float]
    range_m: float
    locations_m: NDArray[np.float64]
    candidates: tuple[Candidates, ...]

    @cached_property
    def agents(self) -> tuple[str, ...]:
        """Names, sorted."""
        return tuple(candidates.agent for candidates in self.candidates)

    @cached_property
    def location_index(self) -> Mapping[tuple[float, float], int]:
        """Which location lies at (x, y)."""
        return {(x_m, y_m): z for z, (x_m, y_m) in enumerate(self.locations_m.tolist())}

    def strategy(self, agent: int, location: int, candidate: int) -> Strategy:
        """Return one agent's candidate as the values that are exchanged."""
        own = self.candidates[agent]
        x_m, y_m = self.locations_m[location].tolist()
        return Strategy(
            agent=own.agent,
            x_m=x_m,
            y_m=y_m,
            task_index=int(own.task_index[candidate]),
            arrival_s=float(own.arrival_s[candidate, location]),
            extra_travel_s=float(own.extra_s[candidate, location]),
        )

    def strategies(self, profile: Profile) -> tuple[Strategy, ...]:
        """Return every agent's strategy in a profile, in the order of ``agents``."""
        return tuple(
            self.strategy(agent, location, candidate)
            for agent, (location, candidate) in enumerate(
                zip(profile.location, profile.candidate, strict=True)
            )
        )
