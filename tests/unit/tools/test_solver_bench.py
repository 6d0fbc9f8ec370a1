"""How well and how quickly solvers solve rounds."""

from dataclasses import replace

import numpy as np
import pytest

from tlcomm_core.game.problem import RoundProblem
from tlcomm_core.game.sample import sample_problem
from tlcomm_core.game.solver import BEST_RESPONSE, COALITION, EXACT
from tlcomm_tools.instances import Instances
from tlcomm_tools.solver_bench import SolverRow, growth, measure_solvers


def sample(index: int, team: int) -> RoundProblem:
    """Return a random round."""
    return sample_problem(np.random.default_rng([index, team]), team, 4, 7, 7)


SMALL = Instances("small", 5, 3, lambda index: sample(index, 5))
LARGE = Instances("large", 12, 2, lambda index: sample(index, 12))


def test_a_row_for_each_solver_and_size_that_fits() -> None:
    """The optimum is what ratios are of, where it can be had; nothing is better than it."""
    rows = list(measure_solvers([SMALL, LARGE], (COALITION, EXACT)))
    assert [(row.solver, row.agents, row.reference) for row in rows] == [
        ("best-response", 5, "exact"),
        ("coalition", 5, "exact"),
        ("exact", 5, "exact"),
        ("best-response", 12, "best-response"),
        ("coalition", 12, "best-response"),
    ]
    assert all(
        row.initial_s > 0.0 < row.agent_s and row.worst_ratio >= row.mean_ratio for row in rows
    )
    best_response, coalition, exact = rows[:3]
    assert best_response.mean_ratio > coalition.mean_ratio >= 1.0 - 1e-9
    assert coalition.mean_ratio >= exact.mean_ratio == 1.0
    assert rows[4].mean_ratio < 1.0


def test_without_the_optimum_best_responses_are_the_measure() -> None:
    """They are measured whether asked for or not."""
    rows = list(measure_solvers([SMALL], (COALITION, BEST_RESPONSE), searchers=1))
    assert [(row.solver, row.reference) for row in rows] == [
        ("best-response", "best-response"),
        ("coalition", "best-response"),
    ]
    assert rows[0].mean_ratio == rows[0].worst_ratio == 1.0


def test_growth_is_the_slope_between_logarithms() -> None:
    """Eight times the time for twice the agents is N³; one size tells nothing."""
    row = SolverRow("s", "i", 10, 1, 0.1, 0.5, "s", 1.0, 1.0)
    rows = [row, replace(row, agents=20, agent_s=4.0), replace(row, solver="t", agent_s=9.0)]
    assert growth(rows, "s") == pytest.approx(3.0)
    assert growth(rows, "t") is None
