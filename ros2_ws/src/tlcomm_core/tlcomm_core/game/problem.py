"""The round problem: every agent's candidates, and what makes a team strategy admissible.

``Candidates``    one agent's strategies (z, h) with arrival times and extra travel, as arrays
``RoundProblem``  Problem 2 of the paper for one round
``Choice``        one agent's strategy as indices into its candidates
``Profile``       a team strategy as indices
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from tlcomm_core.errors import LocalMisuseError
from tlcomm_core.game.links import Links
from tlcomm_core.game.rules import PLAIN_RULES, Rules, is_admissible, open_places
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

    def only_at(self, location: int) -> "Candidates":
        """Return those at one location."""
        elsewhere = np.arange(self.arrival_s.shape[1]) != location
        kept = np.isfinite(self.arrival_s[:, location])
        return Candidates(
            agent=self.agent,
            task_index=self.task_index[kept],
            arrival_s=np.where(elsewhere, np.inf, self.arrival_s)[kept],
            extra_s=np.where(elsewhere, np.inf, self.extra_s)[kept],
        )


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
        links: every candidate place, and which of them are linked.
        candidates: per agent, sorted by the agent's name.
        rules: what the places of the meeting must be, beside connected.
    """

    round: int
    window_s: tuple[float, float]
    links: Links
    candidates: tuple[Candidates, ...]
    rules: Rules = PLAIN_RULES

    @property
    def locations_m(self) -> NDArray[np.float64]:
        """[Z, 2] every candidate place."""
        return self.links.locations_m

    @property
    def range_m(self) -> float:
        """The range that places are planned with."""
        return self.links.range_m

    @cached_property
    def agents(self) -> tuple[str, ...]:
        """Names, sorted."""
        return tuple(candidates.agent for candidates in self.candidates)

    def is_admissible(self, places: Sequence[int]) -> bool:
        """Tell whether the team may meet at some places, one for each agent."""
        return is_admissible(self.links, self.rules, places)

    def open_places(self, others: Sequence[int]) -> NDArray[np.bool_]:
        """Tell, [Z], where one agent may go while the others' places stay."""
        return open_places(self.links, self.rules, others)

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

    def places_of(self, strategies: Sequence[Strategy]) -> tuple[int, ...]:
        """Return the indices of the strategies' places.

        Raises:
            LocalMisuseError: a strategy's place is none of the locations.
        """
        places = [self.links.place_at(strategy.x_m, strategy.y_m) for strategy in strategies]
        if None in places:
            raise LocalMisuseError(f"{strategies[places.index(None)]!r} is at no location")
        return tuple(place for place in places if place is not None)

    def strategies(self, profile: Profile) -> tuple[Strategy, ...]:
        """Return every agent's strategy in a profile, in the order of ``agents``."""
        return tuple(
            self.strategy(agent, location, candidate)
            for agent, (location, candidate) in enumerate(
                zip(profile.location, profile.candidate, strict=True)
            )
        )
