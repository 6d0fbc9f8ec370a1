"""Algorithm 1 in one place: the reference that the protocol must agree with.

``solve``     the team strategies from S⁰ to a Nash equilibrium
``improve``   the same from any team strategy
``Solution``  all of them, with their potentials
"""

from dataclasses import dataclass

from tlcomm_core.game.best_response import (
    MAX_ITERATIONS,
    Scope,
    Search,
    priority,
)
from tlcomm_core.game.initial import initial_profile
from tlcomm_core.game.potential import potential
from tlcomm_core.game.problem import Profile, RoundProblem
from tlcomm_core.game.responses import Responses

__all__ = ["Solution", "improve", "solve"]


@dataclass(frozen=True, slots=True)
class Solution:
    """A run of the algorithm.

    Attributes:
        profiles: S⁰ or another start, and the team strategy after each move.
        potentials_s: Φ of each; strictly falling.
        search: where the search ended.
    """

    profiles: tuple[Profile, ...]
    potentials_s: tuple[float, ...]
    search: Search

    @property
    def initial(self) -> Profile:
        """What it began with."""
        return self.profiles[0]

    @property
    def nash(self) -> Profile:
        """The last team strategy: the equilibrium, unless the iterations ran out."""
        return self.profiles[-1]

    @property
    def iterations(self) -> int:
        """Moves from S⁰ to the last team strategy, k."""
        return self.search.moves


def solve(problem: RoundProblem, max_iterations: int = MAX_ITERATIONS) -> Solution:
    """Improve S⁰ by single moves until nobody gains by any, or the iterations run out.

    Args:
        problem: the round.
        max_iterations: K ≥ 1.

    Raises:
        InfeasibleRoundError: there is no S⁰.

    Source: Algorithm 1 of the paper.
    Deviates: when the balls Υ_i have no improvement left, all places are searched, so that the
        result is an equilibrium against every unilateral deviation.
    """
    return improve(problem, initial_profile(problem), max_iterations=max_iterations)


def improve(
    problem: RoundProblem,
    start: Profile,
    scope: Scope = Scope.BALL,
    max_iterations: int = MAX_ITERATIONS,
) -> Solution:
    """Improve a team strategy by single moves until nobody gains by any.

    In each iteration all agents find their best responses, and the one with the least change
    moves, among equals the first by name.

    Args:
        problem: the round.
        start: an admissible team strategy.
        scope: where to look for moves first.
        max_iterations: K ≥ 1.

    Source: the loop of Algorithm 1 of the paper.
    """
    opens_s, _ = problem.window_s
    profiles = [start]
    to_one_another = Responses(problem)
    search = Search(scope=scope, max_iterations=max_iterations)
    while search.scope is not None:
        responses = to_one_another.to(profiles[-1], search.scope)
        mover = min(
            range(len(responses)),
            key=lambda agent: priority(responses[agent].change_s, problem.agents[agent]),
        )
        search = search.after(responses[mover].change_s)
        if responses[mover].change_s < 0.0:
            profiles.append(profiles[-1].switched(mover, responses[mover].choice))
    return Solution(
        profiles=tuple(profiles),
        potentials_s=tuple(potential(problem.strategies(profile), opens_s) for profile in profiles),
        search=search,
    )
