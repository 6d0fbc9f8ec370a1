"""The meeting game is an exact potential game, and the algorithm descends in it."""

import numpy as np
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from tlcomm_core.errors import InfeasibleRoundError
from tlcomm_core.game.algorithm import Solution, solve
from tlcomm_core.game.best_response import Scope, best_response
from tlcomm_core.game.potential import communication_time, deviation_costs, potential
from tlcomm_core.game.problem import Choice, Profile, RoundProblem
from tlcomm_core.game.sample import sample_problem

SEEDS = st.integers(0, 2**32 - 1)


def feasible(seed: int, team_size: int) -> tuple[RoundProblem, Solution]:
    """Return a random round and its solution; infeasible ones don't count."""
    problem = sample_problem(np.random.default_rng(seed), team_size, 8, 8, 6)
    try:
        return problem, solve(problem)
    except InfeasibleRoundError:
        assume(condition=False)
        raise


def random_choice(rng: np.random.Generator, problem: RoundProblem, agent: int) -> Choice:
    """Return any admissible strategy of an agent."""
    known = np.argwhere(np.isfinite(problem.candidates[agent].arrival_s))
    candidate, location = rng.choice(known).tolist()
    return Choice(location, candidate)


@given(seed=SEEDS, team_size=st.integers(1, 6))
@settings(max_examples=150, deadline=None)
def test_cost_changes_are_potential_changes(seed: int, team_size: int) -> None:
    """For any profile and any switch of one agent, Δu_i = ΔΦ to 1e-9."""
    rng = np.random.default_rng(seed)
    problem = sample_problem(rng, team_size, 8, 8, 6)
    assume(all(len(own.task_index) for own in problem.candidates))
    opens_s, _ = problem.window_s
    before = Profile((0,) * team_size, (0,) * team_size)
    for agent in range(team_size):
        before = before.switched(agent, random_choice(rng, problem, agent))
    mover = int(rng.integers(team_size))
    after = before.switched(mover, random_choice(rng, problem, mover))
    costs_s, potentials_s = [], []
    for profile in (before, after):
        strategies = problem.strategies(profile)
        own = strategies[mover]
        others = strategies[:mover] + strategies[mover + 1 :]
        costs_s.append(
            float(
                deviation_costs(
                    np.array(own.arrival_s), np.array(own.extra_travel_s), others, opens_s
                )
            )
        )
        potentials_s.append(potential(strategies, opens_s))
    assert abs((costs_s[1] - costs_s[0]) - (potentials_s[1] - potentials_s[0])) <= 1e-9


@given(seed=SEEDS, team_size=st.integers(1, 6))
@settings(max_examples=60, deadline=None)
def test_every_move_descends_and_stays_admissible(seed: int, team_size: int) -> None:
    """Φ falls with each move; each team strategy is connected and meets inside the window."""
    problem, solution = feasible(seed, team_size)
    opens_s, closes_s = problem.window_s
    assert (np.diff(solution.potentials_s) < 0.0).all()
    assert len(solution.profiles) == solution.iterations + 1
    for profile in solution.profiles:
        assert problem.links.is_connected(profile.location)
        assert opens_s <= communication_time(problem.strategies(profile), opens_s) < closes_s


@given(seed=SEEDS, team_size=st.integers(2, 6))
@settings(max_examples=60, deadline=None)
def test_announced_changes_are_the_potentials_changes(seed: int, team_size: int) -> None:
    """σ* of a best response is by how much Φ falls when the agent switches, to 1e-9."""
    problem, solution = feasible(seed, team_size)
    opens_s, _ = problem.window_s
    strategies = problem.strategies(solution.initial)
    for agent in range(team_size):
        others = strategies[:agent] + strategies[agent + 1 :]
        current = solution.initial.choice(agent)
        response = best_response(problem, agent, current, others, Scope.EVERYWHERE)
        after = solution.initial.switched(agent, response.choice)
        fall_s = potential(problem.strategies(after), opens_s) - solution.potentials_s[0]
        assert abs(response.change_s - fall_s) <= 1e-9
