"""Formations, where the team begins that can't share a place."""

from itertools import permutations, product

import numpy as np
import pytest

from support.ruled_rounds import RULES, ruled_problem
from tlcomm_core.errors import InfeasibleRoundError
from tlcomm_core.game.formation import cheapest_formation
from tlcomm_core.game.initial import initial_profile
from tlcomm_core.game.potential import potential
from tlcomm_core.game.problem import Profile

CENTRE = 4


@pytest.mark.parametrize("seed", range(12))
def test_places_are_assigned_at_the_least_potential(seed: int) -> None:
    """No other assignment of the same places, with whatever tasks before, has a smaller Φ."""
    problem = ruled_problem(seed, (3, 4, 3, 3), RULES["apart"])
    profile = cheapest_formation(problem, [CENTRE])
    assert profile is not None
    assert CENTRE in profile.location
    opens_s, _ = problem.window_s
    everyone = [range(len(own.task_index)) for own in problem.candidates]
    options = [
        potential(problem.strategies(Profile(places, candidates)), opens_s)
        for places in permutations(profile.location)
        for candidates in product(*everyone)
    ]
    finite = [potential_s for potential_s in options if np.isfinite(potential_s)]
    assert potential(problem.strategies(profile), opens_s) == pytest.approx(min(finite), abs=1e-5)


def test_the_cheapest_of_several_is_taken() -> None:
    """More centres can only make it better, and do somewhere."""
    gains_s = []
    for seed in range(10):
        problem = ruled_problem(seed, (4, 4, 6, 6), RULES["apart"])
        opens_s, _ = problem.window_s
        one, all_ = (cheapest_formation(problem, centres) for centres in ([14], [14, *range(36)]))
        if one is not None:
            assert all_ is not None
            gains_s.append(
                potential(problem.strategies(one), opens_s)
                - potential(problem.strategies(all_), opens_s)
            )
    assert min(gains_s) >= -1e-5
    assert max(gains_s) > 1.0


def test_too_little_room_is_told() -> None:
    """Four places 0.7 m apart aren't to be had on a lattice of 1 m × 0.5 m."""
    problem = ruled_problem(0, (4, 4, 3, 2), RULES["far apart"])
    assert cheapest_formation(problem, range(6)) is None
    with pytest.raises(InfeasibleRoundError, match=r"no 4 places at least 0\.7 m apart"):
        initial_profile(problem)


def test_what_somebody_can_t_reach_is_no_part() -> None:
    """A place that one agent can't reach isn't taken, however near."""
    problem = ruled_problem(3, (3, 4, 3, 3), RULES["apart"])
    nearest = cheapest_formation(problem, [0])
    shut = [1, 3]
    own = problem.candidates[1]
    own.arrival_s[:, shut] = own.extra_s[:, shut] = np.inf
    profile = cheapest_formation(problem, [0])
    assert nearest is not None
    assert profile is not None
    assert {*shut} <= {*nearest.location}
    assert not {*shut} & {*profile.location}
