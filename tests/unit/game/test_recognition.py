"""A peer's team strategy, looked up in one's own tables."""

import math
from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from tlcomm_core.game.algorithm import solve
from tlcomm_core.game.potential import potential
from tlcomm_core.game.problem import RoundProblem
from tlcomm_core.game.recognition import recognise
from tlcomm_core.game.rules import Rules
from tlcomm_core.game.sample import sample_problem
from tlcomm_core.game.strategy import Strategy

Strategies = tuple[Strategy, ...]


@pytest.fixture
def problem() -> RoundProblem:
    """Return a feasible round of three."""
    return sample_problem(np.random.default_rng(3), 3, 4, 5, 4)


def found(problem: RoundProblem) -> tuple[Strategies, float]:
    """Return an equilibrium's values and its potential."""
    solution = solve(problem)
    return problem.strategies(solution.nash), solution.potentials_s[-1]


def test_a_team_strategy_is_recognised_by_its_values(problem: RoundProblem) -> None:
    """What one agent sends as values is another's profile, also if its sums differ a little."""
    strategies, potential_s = found(problem)
    assert recognise(problem, strategies, potential_s) == solve(problem).nash
    assert recognise(problem, strategies, potential_s + 1e-8) == solve(problem).nash


def _far(problem: RoundProblem, strategies: Strategies) -> Strategies:
    """Move the first agent to a place of its own out of everybody's range."""
    near = {place for z in problem.places_of(strategies[1:]) for place in problem.links.near(z)}
    arrival_s = problem.candidates[0].arrival_s
    row, place = next(
        (row, place)
        for row, place in zip(*np.nonzero(np.isfinite(arrival_s)), strict=True)
        if place not in near
    )
    return (problem.strategy(0, int(place), int(row)), *strategies[1:])


def _first(**changes: float) -> Callable[[RoundProblem, Strategies], Strategies]:
    return lambda _, strategies: (replace(strategies[0], **changes), *strategies[1:])


_WRONG: dict[str, Callable[[RoundProblem, Strategies], Strategies]] = {
    "nobody": lambda _, _strategies: (),
    "one too few": lambda _, strategies: strategies[1:],
    "in another order": lambda _, strategies: strategies[::-1],
    "at no place": _first(x_m=0.26),
    "at no number": _first(x_m=math.nan),
    "an h that isn't offered": _first(task_index=10**6),
    "an earlier arrival": lambda problem, strategies: _first(
        arrival_s=strategies[0].arrival_s - 1.0
    )(problem, strategies),
    "a smaller detour": lambda problem, strategies: _first(
        extra_travel_s=strategies[0].extra_travel_s - 1.0
    )(problem, strategies),
    "out of range": _far,
}


@pytest.mark.parametrize("kind", _WRONG)
def test_what_the_tables_do_not_hold_is_refused(problem: RoundProblem, kind: str) -> None:
    """Names, places, steps and times must be the round's, and the places connected."""
    strategies, _ = found(problem)
    wrong = _WRONG[kind](problem, strategies)
    assert recognise(problem, wrong, potential(wrong, problem.window_s[0])) is None


@pytest.mark.parametrize("off_s", [-1.0, -1e-3, 1e-3, math.inf, math.nan])
def test_another_potential_than_claimed_is_refused(problem: RoundProblem, off_s: float) -> None:
    """Whoever claims less than its proposal costs would win every comparison."""
    strategies, potential_s = found(problem)
    assert recognise(problem, strategies, potential_s + off_s) is None


def test_what_the_rules_forbid_is_refused(problem: RoundProblem) -> None:
    """Three agents in a row, 0.5 m apart: close enough to each other, but perhaps too close."""
    strategies, potential_s = found(problem)
    for separation_m, is_fine in ((0.5, True), (0.6, False)):
        apart = replace(problem, rules=Rules(separation_m=separation_m))
        assert (recognise(apart, strategies, potential_s) is not None) == is_fine
