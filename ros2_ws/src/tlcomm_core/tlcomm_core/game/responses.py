"""All agents' best responses to one another, as a team strategy changes move by move.

``Responses``  remembers what a move leaves as it was
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from tlcomm_core.game.best_response import Response, Scope, best_switch
from tlcomm_core.game.openings import Openings
from tlcomm_core.game.problem import Choice, Profile, RoundProblem

__all__ = ["Responses"]


@dataclass(frozen=True, slots=True)
class _Known:
    """A response, and all that it depends on."""

    current: Choice
    others_s: float
    places: NDArray[np.intp]
    response: Response

    def is_to(self, current: Choice, others_s: float, places: NDArray[np.intp]) -> bool:
        return (
            self.current == current
            and self.others_s == others_s
            and np.array_equal(self.places, places)
        )


class Responses:
    """All agents' best responses to one another.

    The same as ``best_response`` gives for each; but one agent's move changes little for those far
    away, and what it leaves as it was needn't be computed anew.
    """

    def __init__(self, problem: RoundProblem) -> None:
        """Begin without any."""
        self._problem = problem
        self._known: list[_Known | None] = [None] * len(problem.candidates)

    def to(self, profile: Profile, scope: Scope) -> tuple[Response, ...]:
        """Return the best response of each agent while the others stay.

        Args:
            profile: an admissible team strategy.
            scope: where to look.
        """
        openings = Openings(self._problem, profile.location)
        open_places = openings.around if scope is Scope.BALL else openings.everywhere
        return tuple(
            self._response(agent, profile.choice(agent), others_s, open_places(agent))
            for agent, others_s in enumerate(self._others_s(profile))
        )

    def _others_s(self, profile: Profile) -> list[float]:
        """Return for each agent when the others could meet."""
        opens_s, _ = self._problem.window_s
        chosen = zip(self._problem.candidates, profile.candidate, profile.location, strict=True)
        arrivals_s = [float(own.arrival_s[row, place]) for own, row, place in chosen]
        second_s, latest_s = sorted([opens_s, opens_s, *arrivals_s])[-2:]
        return [second_s if arrival_s == latest_s else latest_s for arrival_s in arrivals_s]

    def _response(
        self, agent: int, current: Choice, others_s: float, places: NDArray[np.intp]
    ) -> Response:
        known = self._known[agent]
        if known is None or not known.is_to(current, others_s, places):
            own, team = self._problem.candidates[agent], len(self._problem.candidates)
            opens_s, _ = self._problem.window_s
            response = best_switch(own, current, team, (opens_s, others_s), places)
            known = self._known[agent] = _Known(current, others_s, places, response)
        return known.response
