"""How the cost of a team strategy comes down in the first rounds of a run.

``follow_courses``  Φ after each move of Algorithm 1
"""

from tlcomm_core.game.algorithm import solve
from tlcomm_core.game.solver import DEFAULT, Solver
from tlcomm_core.scenario.site import Site
from tlcomm_tools.figures.elements import Course
from tlcomm_tools.rounds import pose_rounds

__all__ = ["follow_courses"]


def follow_courses(
    site: Site, count: int, seed: int, solver: Solver = DEFAULT
) -> tuple[Course, ...]:
    """Return the course of Φ from S⁰ to the equilibrium of Algorithm 1, in rounds 1 to ``count``.

    What agents record is where they began and what they agreed on. The way between is a function of
    the round's problem, and is gone once more by the reference in one place. Where agents propose
    whole strategies, they agree on less than where it ends.

    Args:
        site: the scenario.
        count: how many rounds, from 1 on.
        seed: of the run.
        solver: of the run: it decides where each round begins.

    Raises:
        InfeasibleRoundError: a round has no S⁰.
        InputError: the team doesn't get so far.
        PlanningError: an agent's task has no plan.

    Source: Algorithm 1 of the paper.
    Cost: a simulation of these rounds.
    """
    return tuple(
        Course(round=problem.round, potentials_s=solve(problem).potentials_s)
        for problem in pose_rounds(site, count, seed, solver)
    )
