"""Why a team meets where and when it does."""

import numpy as np
import pytest

from tlcomm_core.game.algorithm import solve
from tlcomm_core.game.links import Links
from tlcomm_core.game.potential import potential
from tlcomm_core.game.problem import Candidates, Choice, RoundProblem
from tlcomm_core.game.rationale import rationale
from tlcomm_core.game.sample import sample_problem


@pytest.mark.parametrize("seed", range(6))
def test_it_names_each_agents_best_alternative(seed: int) -> None:
    """By brute force: of all other strategies that keep the team connected, none costs less."""
    problem = sample_problem(np.random.default_rng(seed), 3, 3, 4, 4)
    nash = solve(problem).nash
    opens_s, _ = problem.window_s
    present_s = potential(problem.strategies(nash), opens_s)
    attendances = rationale(problem, nash)
    assert sum(own.additional_s for own in attendances) == pytest.approx(present_s)
    for agent, attendance in enumerate(attendances):
        arrival_s = problem.candidates[agent].arrival_s
        others = []
        for row, place in zip(*np.nonzero(np.isfinite(arrival_s)), strict=True):
            switched = nash.switched(agent, Choice(int(place), int(row)))
            if switched != nash and problem.links.is_connected(switched.location):
                others.append(potential(problem.strategies(switched), opens_s))
        assert attendance.increase_s == pytest.approx(min(others) - present_s)
        assert attendance.increase_s >= -1e-9


def test_an_agent_may_have_no_choice() -> None:
    """With a single candidate there is no alternative, and nothing to pay for it."""
    table = np.array([[70.0]])
    lone = Candidates("agent", np.array([4]), table, np.zeros_like(table))
    problem = RoundProblem(1, (60.0, 120.0), Links(np.zeros((1, 2)), 1.0), (lone,))
    (attendance,) = rationale(problem, solve(problem).nash)
    assert (attendance.alternative, attendance.increase_s) == (None, None)
    assert attendance.wait_s == attendance.additional_s == 0.0
