"""How a team finds its next meeting: what each agent contributes before best responses decide.

``Proposed``       a team strategy, and what is proven about it
``Solver``         a way to propose one
``Solved``         what a whole team finds with a solver
``solve_with``     the same in one place: the reference that the protocol must agree with
``BEST_RESPONSE``  none: Algorithm 1 from S⁰
``EXACT``          the optimum, searched for in shares
``COALITION``      near the optimum, for teams of any size
``SOLVERS``        all of them, by name
``DEFAULT``        the one that is used unless another is asked for

Every agent holds all offers, so each can search for a good team strategy alone; a minimum consensus
picks the best proposal, and Algorithm 1 goes on from there. So whatever a solver does, the result
is a team strategy that all agents hold, that has no higher potential than what was proposed, and
that none of them wants to leave alone.
"""

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Final

from tlcomm_core.errors import InputError
from tlcomm_core.game.algorithm import Solution, improve
from tlcomm_core.game.best_response import Scope
from tlcomm_core.game.initial import initial_profile
from tlcomm_core.game.potential import potential
from tlcomm_core.game.problem import Profile, RoundProblem
from tlcomm_core.game.search.coalition import propose
from tlcomm_core.game.search.exact import MOST_AGENTS, Share, solve_exactly

__all__ = [
    "BEST_RESPONSE",
    "COALITION",
    "DEFAULT",
    "EXACT",
    "SOLVERS",
    "Proposed",
    "Solved",
    "Solver",
    "solve_with",
]


# Up to this many agents the optimum is within reach.
_SMALL_TEAM: Final = 8
# What a better team strategy would have to save, of Φ, to be worth the search.
_TOLERANCE: Final = 0.1


@dataclass(frozen=True, slots=True)
class Proposed:
    """A team strategy, and what is proven about it.

    Attributes:
        profile: the team strategy.
        bound_s: no team strategy in the searcher's share has a lower Φ; −inf if nothing is proven.
    """

    profile: Profile
    bound_s: float


Propose = Callable[[RoundProblem, Profile, int], Proposed]
"""Searches a round problem from S⁰, as the searcher of this index; a function of its inputs."""


@dataclass(frozen=True, slots=True)
class Solver:
    """A way to find a round's team strategy.

    Attributes:
        name: as users call it.
        propose: what each agent does first; ``None`` if best responses begin from S⁰.
        most_agents: the largest team that it is meant for; ``None`` for any.
    """

    name: str
    propose: Propose | None = None
    most_agents: int | None = None

    def check_team(self, size: int) -> None:
        """Check that the solver is meant for a team of this size.

        Raises:
            InputError: it isn't.
        """
        if self.most_agents is not None and size > self.most_agents:
            raise InputError(
                f"solver {self.name!r}: {size} agents take too long; "
                f"expected at most {self.most_agents}"
            )


@dataclass(frozen=True, slots=True)
class Solved:
    """What a whole team finds with a solver.

    Attributes:
        initial: S⁰.
        initial_potential_s: its Φ.
        solution: from S⁰, or from the best proposal, to the equilibrium.
        proposer: index of the agent whose proposal was the best; ``None`` without proposals.
        bound_s: no team strategy has a lower Φ; −inf if nothing is proven.
    """

    initial: Profile
    initial_potential_s: float
    solution: Solution
    proposer: int | None
    bound_s: float


def solve_with(solver: Solver, problem: RoundProblem) -> Solved:
    """Let every agent propose, take the best proposal, and improve it to an equilibrium.

    Args:
        solver: what agents propose.
        problem: the round.

    Raises:
        InfeasibleRoundError: there is no S⁰.
    """
    initial = initial_profile(problem)
    if solver.propose is None:
        solution = improve(problem, initial)
        return Solved(initial, solution.potentials_s[0], solution, None, -math.inf)
    opens_s, _ = problem.window_s
    proposals = [solver.propose(problem, initial, agent) for agent in range(len(problem.agents))]
    costs_s = [potential(problem.strategies(own.profile), opens_s) for own in proposals]
    best = min(range(len(proposals)), key=lambda agent: (costs_s[agent], problem.agents[agent]))
    return Solved(
        initial=initial,
        initial_potential_s=potential(problem.strategies(initial), opens_s),
        solution=improve(problem, proposals[best].profile, Scope.EVERYWHERE),
        proposer=best,
        bound_s=min(own.bound_s for own in proposals),
    )


def _exact(problem: RoundProblem, initial: Profile, searcher: int) -> Proposed:
    """Search this searcher's share of the communication times."""
    start = improve(problem, initial).nash
    optimum = solve_exactly(problem, start, Share(searcher, len(problem.agents)))
    return Proposed(optimum.profile, optimum.bound_s)


def _coalition(problem: RoundProblem, initial: Profile, searcher: int) -> Proposed:
    """Search this searcher's share of the communication times, with proof as far as that is quick.

    A small team comes within the tolerance of the optimum in less time than a large one's search
    takes; but many decisions on single agents, as resilience costs them, aren't quick.
    """
    team = len(problem.agents)
    if team > _SMALL_TEAM:
        return Proposed(propose(problem, initial, searcher), -math.inf)
    start = improve(problem, initial).nash
    if problem.rules.resilience:
        return Proposed(propose(problem, start, searcher), -math.inf)
    optimum = solve_exactly(problem, start, Share(searcher, team), _TOLERANCE)
    return Proposed(optimum.profile, optimum.bound_s)


BEST_RESPONSE: Final = Solver("best-response")
EXACT: Final = Solver("exact", _exact, MOST_AGENTS)
COALITION: Final = Solver("coalition", _coalition)
SOLVERS: Final[Mapping[str, Solver]] = MappingProxyType(
    {solver.name: solver for solver in (BEST_RESPONSE, COALITION, EXACT)}
)
DEFAULT: Final = COALITION
