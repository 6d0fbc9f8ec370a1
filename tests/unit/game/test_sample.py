"""Random round problems."""

import numpy as np

from tlcomm_core.errors import InfeasibleRoundError
from tlcomm_core.game.initial import initial_profile
from tlcomm_core.game.sample import sample_problem


def test_samples_are_admissible_problems() -> None:
    """Arrivals lie before the window's end, rows have entries, both tables agree."""
    problem = sample_problem(np.random.default_rng(1), 4, 10, 6, 5)
    assert len(problem.agents) == 4
    for own in problem.candidates:
        known = np.isfinite(own.arrival_s)
        assert own.arrival_s.shape == (len(own.task_index), 30)
        assert known.any(axis=1).all()
        assert (known == np.isfinite(own.extra_s)).all()
        assert (own.arrival_s[known] < problem.window_s[1]).all()
        assert (own.extra_s[known] >= 0.0).all()


def test_the_seed_decides() -> None:
    """Equal seeds give equal problems, others don't."""
    first, again, other = (
        sample_problem(np.random.default_rng(seed), 2, 5, 4, 4).candidates[0].arrival_s
        for seed in (1, 1, 2)
    )
    np.testing.assert_array_equal(first, again)
    assert first.shape != other.shape or (first != other).any()


def test_most_samples_are_feasible() -> None:
    """Tests that skip infeasible rounds have enough left."""
    feasible = 0
    for seed in range(50):
        try:
            initial_profile(sample_problem(np.random.default_rng(seed), 3, 4, 3, 3))
        except InfeasibleRoundError:
            continue
        feasible += 1
    assert feasible >= 25
