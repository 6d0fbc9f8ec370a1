"""One agent's best response, and whose response the team takes.

``best_response``  an agent's best switch, knowing the others by their exchanged values only
``best_switch``    the same once it is known which places are open
``Response``       what it found
``priority``       the order in which responses are taken
``Scope``          where a response is looked for: near the present place, or everywhere
``Search``         which scope comes next, and when the search is over
"""

from collections.abc import Sequence
from dataclasses import dataclass
from enum import Enum
from typing import Final

import numpy as np
from numpy.typing import NDArray

from tlcomm_core.game.potential import communication_time, switch_costs
from tlcomm_core.game.problem import Candidates, Choice, RoundProblem
from tlcomm_core.game.strategy import Strategy

__all__ = [
    "CHANGE_TOLERANCE_S",
    "MAX_ITERATIONS",
    "Response",
    "Scope",
    "Search",
    "best_response",
    "best_switch",
    "priority",
]

CHANGE_TOLERANCE_S: Final = 1e-9
"""A change that doesn't save more than this is rounding, not an improvement."""

MAX_ITERATIONS: Final = 1000
"""K of Algorithm 1, unless told otherwise."""


class Scope(Enum):
    """Where a best response is looked for; what disconnects the team is always left out."""

    BALL = "ball"
    """Within range of the agent's present place: Υ_i of the paper."""
    EVERYWHERE = "everywhere"
    """At every location."""


@dataclass(frozen=True, slots=True)
class Response:
    """An agent's best response.

    Attributes:
        change_s: σ*, below −``CHANGE_TOLERANCE_S``; or 0.0 to stay.
        location: the place to switch to, or the present one.
        candidate: the row of its candidates to switch to, or the present one.
    """

    change_s: float
    location: int
    candidate: int

    @property
    def choice(self) -> Choice:
        """The strategy to switch to, or the present one."""
        return Choice(self.location, self.candidate)


@dataclass(frozen=True, slots=True)
class Search:
    """How far the search for an equilibrium has come; the same for the reference and each agent.

    Attributes:
        iteration: comparisons of best responses so far, whether or not one led to a move.
        moves: k of Algorithm 1: moves made so far.
        scope: where responses are looked for now; None when the search is over.
        is_equilibrium: whether it is over because nobody can gain by any switch.
        max_iterations: the most comparisons to make, K.
    """

    iteration: int = 0
    moves: int = 0
    scope: Scope | None = Scope.BALL
    is_equilibrium: bool = False
    max_iterations: int = MAX_ITERATIONS

    def after(self, least_change_s: float) -> "Search":
        """Return the search after one more comparison.

        A move keeps the scope. Without one, the ball gives way to all places, and when these have
        none either, the team strategy is an equilibrium.

        Args:
            least_change_s: σ* of the agent that moves; 0.0 if none does.

        Source: Algorithm 1 of the paper, its last lines.
        Deviates: the paper ends with the ball, in which a Nash equilibrium is only a local one.
        """
        moved = least_change_s < 0.0
        is_equilibrium = not moved and self.scope is Scope.EVERYWHERE
        iteration = self.iteration + 1
        scope = self.scope if moved else Scope.EVERYWHERE
        return Search(
            iteration=iteration,
            moves=self.moves + moved,
            scope=None if is_equilibrium or iteration >= self.max_iterations else scope,
            is_equilibrium=is_equilibrium,
            max_iterations=self.max_iterations,
        )


def priority(change_s: float, agent: str) -> tuple[float, str]:
    """Return the sort key of a response: the least change first, among equals the first name."""
    return change_s, agent


def best_response(
    problem: RoundProblem,
    agent: int,
    current: Choice,
    others: Sequence[Strategy],
    scope: Scope,
) -> Response:
    """Return the switch of one agent that lowers the potential most while the others stay.

    Among equal changes the lowest location wins, there the lowest candidate.

    Args:
        problem: the round; of the candidates, only the agent's own are read.
        agent: index of the agent.
        current: its present strategy.
        others: the others' present strategies, as exchanged.
        scope: where to look.

    Returns:
        The best switch, or the present strategy with a change of 0.0.

    Source: Algorithm 1 of the paper, its loop over agents: σ_i* = min u_i(s_i', S_−i) −
        u_i(s_i, S_−i) over z' in Υ_i and h', with t_c in the window.
    Cost: O(Z·N + H·|Υ_i|).
    """
    opens_s, _ = problem.window_s
    places = _open_places(problem, current.location, others, scope)
    others_s = communication_time(others, opens_s)
    own, team = problem.candidates[agent], len(others) + 1
    return best_switch(own, current, team, (opens_s, others_s), places)


def best_switch(
    own: Candidates,
    current: Choice,
    team: int,
    meeting_s: tuple[float, float],
    places: NDArray[np.intp],
) -> Response:
    """Return the switch to one of some places that lowers the potential most.

    Args:
        own: the agent's candidates.
        current: its present strategy.
        team: N.
        meeting_s: when the window opens, and when the others alone could meet.
        places: open to the agent, ascending.
    """
    stay = Response(0.0, current.location, current.candidate)
    if not len(places):
        return stay
    # The present strategy is costed in the same call, as a last column.
    columns = np.append(places, current.location)
    opens_s, others_s = meeting_s
    costs_s = switch_costs(
        own.arrival_s[:, columns], own.extra_s[:, columns], team, others_s, opens_s
    )
    rows = np.argmin(costs_s[:, :-1], axis=0)
    least_s = costs_s[rows, np.arange(len(places))]
    best = int(np.argmin(least_s))
    change_s = float(least_s[best] - costs_s[current.candidate, -1])
    if change_s >= -CHANGE_TOLERANCE_S:
        return stay
    return Response(change_s, int(places[best]), int(rows[best]))


def _open_places(
    problem: RoundProblem, location: int, others: Sequence[Strategy], scope: Scope
) -> NDArray[np.intp]:
    """Return the locations, ascending, that the scope and the meeting's rules leave."""
    is_open = problem.open_places(problem.places_of(others))
    if scope is Scope.EVERYWHERE:
        return np.flatnonzero(is_open)
    near = problem.links.near(location)
    places: NDArray[np.intp] = near[is_open[near]]
    return places
