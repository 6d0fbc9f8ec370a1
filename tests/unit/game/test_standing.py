"""The best times for a team that keeps its places, against all there are."""

from dataclasses import replace
from itertools import product

import numpy as np
import pytest

from tlcomm_core.errors import InfeasibleRoundError
from tlcomm_core.game.algorithm import solve
from tlcomm_core.game.initial import initial_profile
from tlcomm_core.game.potential import potential
from tlcomm_core.game.problem import Profile, RoundProblem
from tlcomm_core.game.rules import Rules
from tlcomm_core.game.sample import sample_problem


def standing_problem(seed: int) -> RoundProblem:
    """Return a random round in which three agents keep some places."""
    rng = np.random.default_rng(seed)
    problem = sample_problem(rng, 3, 4, 3, 3)
    places = []
    for own in problem.candidates:
        is_open = np.flatnonzero(np.isfinite(own.arrival_s).any(axis=0))
        places.append(int(rng.choice(is_open)))
    kept = tuple(own.only_at(z) for own, z in zip(problem.candidates, places, strict=True))
    return replace(problem, candidates=kept, rules=Rules(keeps_places=True))


@pytest.mark.parametrize("seed", range(40))
def test_no_other_times_cost_less(seed: int) -> None:
    """Every combination of the agents' candidates has at least that potential."""
    problem = standing_problem(seed)
    opens_s, _ = problem.window_s
    found = initial_profile(problem)
    every = product(*(range(len(own.task_index)) for own in problem.candidates))
    least_s = min(
        potential(problem.strategies(Profile(found.location, rows)), opens_s) for rows in every
    )
    assert potential(problem.strategies(found), opens_s) == pytest.approx(least_s)


@pytest.mark.parametrize("seed", range(10))
def test_nobody_wants_to_leave_them(seed: int) -> None:
    """They are an equilibrium: best responses change nothing."""
    solution = solve(standing_problem(seed))
    assert solution.iterations == 0
    assert solution.search.is_equilibrium


def test_only_at_leaves_nothing_elsewhere() -> None:
    """Entries of one place stay as they are, rows without one go, and all others are closed."""
    own = sample_problem(np.random.default_rng(3), 2, 4, 3, 3).candidates[0]
    place = int(np.flatnonzero(np.isfinite(own.arrival_s).any(axis=0))[0])
    kept = own.only_at(place)
    rows = np.isfinite(own.arrival_s[:, place])
    assert kept.task_index.tolist() == own.task_index[rows].tolist()
    assert kept.arrival_s[:, place].tolist() == own.arrival_s[rows, place].tolist()
    assert not np.isfinite(np.delete(kept.arrival_s, place, axis=1)).any()
    assert not np.isfinite(np.delete(kept.extra_s, place, axis=1)).any()


def test_a_place_that_nobody_reaches_in_time_is_no_round() -> None:
    """It is said who can't be there."""
    problem = standing_problem(1)
    late = replace(problem, candidates=tuple(own.only_at(0) for own in problem.candidates))
    names = [own.agent for own in late.candidates if not len(own.task_index)]
    with pytest.raises(InfeasibleRoundError, match=names[0]):
        initial_profile(late)
