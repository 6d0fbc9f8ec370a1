"""Proposals of near-optimal team strategies."""

import numpy as np
import pytest

from support.ruled_rounds import RULES, may_meet, ruled_problem
from tlcomm_core.errors import InfeasibleRoundError
from tlcomm_core.game.algorithm import solve
from tlcomm_core.game.best_response import Scope, best_response
from tlcomm_core.game.initial import initial_profile
from tlcomm_core.game.potential import potential
from tlcomm_core.game.problem import Profile, RoundProblem
from tlcomm_core.game.sample import sample_problem
from tlcomm_core.game.search.coalition import propose
from tlcomm_core.game.search.exact import solve_exactly


def sample(seed: int, size: tuple[int, int, int, int]) -> tuple[RoundProblem, Profile]:
    """Return a random round and its S⁰."""
    rng = np.random.default_rng([seed, *size])
    while True:
        problem = sample_problem(rng, *size)
        try:
            return problem, initial_profile(problem)
        except InfeasibleRoundError:
            continue


def potential_s(problem: RoundProblem, profile: Profile) -> float:
    """Return Φ."""
    return potential(problem.strategies(profile), problem.window_s[0])


def team_potential_s(problem: RoundProblem, start: Profile) -> float:
    """Return the least Φ that any agent proposes."""
    team = range(len(problem.agents))
    return min(potential_s(problem, propose(problem, start, searcher)) for searcher in team)


def is_equilibrium(problem: RoundProblem, profile: Profile) -> bool:
    """Tell whether nobody gains by leaving a team strategy alone."""
    strategies = problem.strategies(profile)
    return all(
        best_response(
            problem,
            agent,
            profile.choice(agent),
            strategies[:agent] + strategies[agent + 1 :],
            Scope.EVERYWHERE,
        ).change_s
        == 0.0
        for agent in range(len(strategies))
    )


@pytest.mark.parametrize("team", [1, 2, 5, 9, 14])
@pytest.mark.parametrize("seed", range(4))
def test_a_proposal_is_an_equilibrium_no_worse_than_the_start(seed: int, team: int) -> None:
    """Connected, and nobody wants to leave it alone; an equilibrium can't be made worse either."""
    problem, start = sample(seed, (team, 4, 7, 6))
    for begun in (start, solve(problem).nash):
        proposal = propose(problem, begun, seed % team)
        assert problem.is_admissible(proposal.location)
        assert potential_s(problem, proposal) <= potential_s(problem, begun)
        assert is_equilibrium(problem, proposal)


@pytest.mark.parametrize("team", [6, 12])
def test_a_proposal_is_a_function_of_its_inputs(team: int) -> None:
    """Equal inputs, equal proposals; another searcher finds others."""
    problem, start = sample(3, (team, 4, 8, 8))
    proposals = [propose(problem, start, searcher) for searcher in range(team)]
    assert proposals == [propose(problem, start, searcher) for searcher in range(team)]
    assert len(set(proposals)) > 1


def test_the_team_is_near_the_optimum() -> None:
    """Over seeded rounds of up to eight agents, in the mean and at worst; best responses aren't."""
    gaps, gaps_alone = [], []
    for seed in range(12):
        problem, start = sample(seed, (5 + seed % 4, 5, 8, 7))
        alone = solve(problem)
        optimum_s = solve_exactly(problem, alone.nash).potential_s
        gaps.append(team_potential_s(problem, start) / optimum_s - 1.0)
        gaps_alone.append(alone.potentials_s[-1] / optimum_s - 1.0)
    assert min(gaps) >= -1e-9
    assert np.mean(gaps) <= 0.02
    assert max(gaps) <= 0.08
    assert np.mean(gaps_alone) >= 5.0 * np.mean(gaps)


@pytest.mark.parametrize("rule", RULES)
@pytest.mark.parametrize("seed", range(3))
def test_proposals_keep_the_rules(seed: int, rule: str) -> None:
    """Whatever the places of a meeting must be, and behind walls, as best responses do."""
    problem = ruled_problem(seed, (6, 4, 8, 8), RULES[rule], is_blind=True)
    start = initial_profile(problem)
    for searcher in (0, 5):
        proposal = propose(problem, start, searcher)
        assert may_meet(problem, proposal.location)
        assert potential_s(problem, proposal) <= potential_s(problem, start)
        assert is_equilibrium(problem, proposal)


def test_rules_leave_room_for_improvement() -> None:
    """With a separation as without, the team's proposals beat Algorithm 1 in the mean."""
    ratios = []
    for seed in range(6):
        problem = ruled_problem(seed, (6, 4, 8, 8), RULES["apart"])
        alone_s = solve(problem).potentials_s[-1]
        ratios.append(team_potential_s(problem, initial_profile(problem)) / alone_s)
    assert np.mean(ratios) < 0.95


def test_fifty_agents_are_no_obstacle() -> None:
    """A few of them find what is far better than single moves from S⁰ do."""
    problem, start = sample(1, (50, 3, 25, 25))
    proposals = [propose(problem, start, searcher) for searcher in (0, 15, 30)]
    assert all(is_equilibrium(problem, proposal) for proposal in proposals)
    least_s = min(potential_s(problem, proposal) for proposal in proposals)
    assert least_s < 0.85 * solve(problem).potentials_s[-1]
