"""All agents' best responses, remembered from move to move."""

import numpy as np
import pytest

from support.ruled_rounds import RULES, ruled_problem
from tlcomm_core.errors import InfeasibleRoundError
from tlcomm_core.game.best_response import Response, Scope, best_response
from tlcomm_core.game.initial import initial_profile
from tlcomm_core.game.openings import Openings
from tlcomm_core.game.problem import Choice, Profile, RoundProblem
from tlcomm_core.game.responses import Responses

MOVES = 12


def one_by_one(problem: RoundProblem, profile: Profile, scope: Scope) -> tuple[Response, ...]:
    """Return each agent's best response from the others' values alone."""
    strategies = problem.strategies(profile)
    return tuple(
        best_response(
            problem,
            agent,
            profile.choice(agent),
            strategies[:agent] + strategies[agent + 1 :],
            scope,
        )
        for agent in range(len(strategies))
    )


def random_move(problem: RoundProblem, profile: Profile, rng: np.random.Generator) -> Profile:
    """Return the profile after any admissible switch of some agent."""
    agent = int(rng.integers(len(problem.agents)))
    places = Openings(problem, profile.location).everywhere(agent)
    finite = np.isfinite(problem.candidates[agent].arrival_s[:, places])
    row, column = rng.choice(np.argwhere(finite)).tolist()
    return profile.switched(agent, Choice(int(places[column]), row))


@pytest.mark.parametrize("size", [(1, 3, 4, 4), (2, 4, 5, 5), (6, 4, 6, 6)])
@pytest.mark.parametrize("name", RULES)
def test_they_are_what_each_finds_alone(name: str, size: tuple[int, int, int, int]) -> None:
    """After any move, in both scopes, whatever was remembered; and places stay admissible."""
    rng = np.random.default_rng(size)
    for seed in range(6):
        problem = ruled_problem(seed, size, RULES[name], is_blind=bool(seed % 2))
        try:
            profile = initial_profile(problem)
        except InfeasibleRoundError:
            continue
        responses = Responses(problem)
        for _ in range(MOVES):
            for scope in Scope:
                assert responses.to(profile, scope) == one_by_one(problem, profile, scope)
            profile = random_move(problem, profile, rng)
            assert problem.is_admissible(profile.location)


@pytest.mark.parametrize("name", RULES)
def test_openings_are_the_places_that_rules_leave(name: str) -> None:
    """For each agent of a random walk of teams, around it and everywhere."""
    rng = np.random.default_rng(7)
    problem = ruled_problem(1, (6, 4, 6, 6), RULES[name], is_blind=True)
    profile = initial_profile(problem)
    for _ in range(MOVES):
        openings = Openings(problem, profile.location)
        for agent, place in enumerate(profile.location):
            others = [*profile.location[:agent], *profile.location[agent + 1 :]]
            everywhere = np.flatnonzero(problem.open_places(others))
            near = np.intersect1d(everywhere, problem.links.near(place))
            assert openings.everywhere(agent).tolist() == everywhere.tolist()
            assert openings.around(agent).tolist() == near.tolist()
        profile = random_move(problem, profile, rng)
