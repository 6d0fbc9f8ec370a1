"""Algorithm 1 on small problems."""

from collections.abc import Callable

import numpy as np

from tlcomm_core.game.algorithm import solve
from tlcomm_core.game.problem import Profile, RoundProblem
from tlcomm_core.game.sample import sample_problem

MakeProblem = Callable[..., RoundProblem]
LINE_M = [(0.0, 0.0), (1.0, 0.0), (2.0, 0.0), (3.0, 0.0)]


def row(*extra_s: float) -> list[list[tuple[float, float]]]:
    """Return a table of one row: arrivals at 70 s, detours by place."""
    return [[(70.0, extra) for extra in extra_s]]


def test_the_agent_that_gains_most_moves_first(make_problem: MakeProblem) -> None:
    """Both leave the middle, the one with the larger saving first; then nobody moves."""
    problem = make_problem(LINE_M, 2.0, a=row(2, 3, 9, 9), b=row(9, 3, 1, 9))
    solution = solve(problem)
    assert solution.profiles == (
        Profile((1, 1), (0, 0)),
        Profile((1, 2), (0, 0)),
        Profile((0, 2), (0, 0)),
    )
    assert solution.potentials_s == (6.0, 4.0, 3.0)
    assert solution.search.is_equilibrium


def test_equal_gains_go_to_the_first_name(make_problem: MakeProblem) -> None:
    """Of two equal changes the first agent's is taken; it then bars the other's."""
    problem = make_problem(LINE_M, 1.0, a=row(2, 3, 9, 9), b=row(9, 3, 2, 9))
    assert solve(problem).nash == Profile((0, 1), (0, 0))


def test_a_step_beyond_the_ball_is_found(make_problem: MakeProblem) -> None:
    """When no place within range is better, one further on that the team reaches is taken."""
    problem = make_problem(LINE_M[:3], 1.0, a=row(5, 9, 0), b=row(3, 0, 9), c=row(0, 9, 9))
    solution = solve(problem)
    assert [profile.location for profile in solution.profiles] == [
        (0, 0, 0),
        (0, 1, 0),
        (2, 1, 0),
    ]
    # One comparison more than moves for each scope: nothing near, then nothing anywhere.
    assert solution.search.iteration == solution.iterations + 2


def test_iterations_are_limited(make_problem: MakeProblem) -> None:
    """With K = 1 the first move is the last, and nobody calls it an equilibrium."""
    problem = make_problem(LINE_M, 2.0, a=row(2, 3, 9, 9), b=row(9, 3, 1, 9))
    solution = solve(problem, max_iterations=1)
    assert solution.nash == Profile((1, 2), (0, 0))
    assert solution.iterations == 1
    assert not solution.search.is_equilibrium


def test_repetition_changes_nothing() -> None:
    """Ten runs on equal problems give ten equal solutions, every profile included."""
    solutions = {solve(sample_problem(np.random.default_rng(5), 6, 12, 12, 12)) for _ in range(10)}
    assert len(solutions) == 1
    assert solutions.pop().iterations > 0
