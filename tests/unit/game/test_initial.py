"""The initial team strategy on small problems."""

from collections.abc import Callable

import numpy as np
import pytest

from tlcomm_core.errors import InfeasibleRoundError
from tlcomm_core.game.initial import initial_profile
from tlcomm_core.game.problem import Profile, RoundProblem
from tlcomm_core.game.sample import sample_problem

MakeProblem = Callable[..., RoundProblem]
PLACES_M = [(0.0, 0.0), (5.0, 0.0)]


def test_the_cheapest_common_place_wins(make_problem: MakeProblem) -> None:
    """The place with the least sum is taken, though each agent alone would prefer the other."""
    problem = make_problem(
        PLACES_M, 1.0, a=[[(70.0, 0.0), (70.0, 3.0)]], b=[[(80.0, 0.0), (71.0, 3.0)]]
    )
    assert initial_profile(problem) == Profile((1, 1), (0, 0))


def test_a_later_meeting_may_cost_less(make_problem: MakeProblem) -> None:
    """All go after their second task when the detour saved outweighs the wait."""
    table = [[(65.0, 9.0)], [(75.0, 0.0)]]
    problem = make_problem(PLACES_M[:1], 1.0, a=table, b=[*table[:1], [(77.0, 0.0)]])
    assert initial_profile(problem) == Profile((0, 0), (1, 1))


def test_an_early_arrival_waits_for_the_window(make_problem: MakeProblem) -> None:
    """Waiting until r·T_c costs: 20 s of wait lose against 15 s of detour at the opening."""
    problem = make_problem(PLACES_M[:1], 1.0, a=[[(40.0, 0.0)], [(60.0, 15.0)]])
    assert initial_profile(problem) == Profile((0,), (1,))


def test_ties_go_to_the_lowest_place_then_the_earliest_meeting(make_problem: MakeProblem) -> None:
    """Equal potentials: place 0, and at it the earlier of two arrivals, though listed second."""
    table = [[(80.0, 1.0), (70.0, 1.0)], [(70.0, 1.0), (70.0, 1.0)]]
    problem = make_problem(PLACES_M, 1.0, a=table)
    assert initial_profile(problem) == Profile((0,), (1,))


def test_agents_without_candidates_are_named(make_problem: MakeProblem) -> None:
    """The error names exactly the agents that can't come at all."""
    problem = make_problem(PLACES_M, 1.0, a=[[(70.0, 0.0)] * 2], b=[], c=[[None, None]])
    with pytest.raises(InfeasibleRoundError, match=r"round 1: .*\[60.0, 120.0\) s for b, c$"):
        initial_profile(problem)


def test_a_round_without_common_place_is_infeasible(make_problem: MakeProblem) -> None:
    """Each agent reaches some place, but no place is reached by both."""
    problem = make_problem(PLACES_M, 1.0, a=[[(70.0, 0.0), None]], b=[[None, (70.0, 0.0)]])
    with pytest.raises(InfeasibleRoundError, match="no place that all of a, b reach before 120"):
        initial_profile(problem)


def test_promising_places_do_not_mislead(make_problem: MakeProblem) -> None:
    """The last of 300 places is the best, though b can be early or without detour everywhere."""
    # Elsewhere never both at once.
    deceptive = [[(60.0, 50.0)] * 299 + [(60.0, 1.0)], [(110.0, 0.0)] * 299 + [(61.0, 0.5)]]
    problem = make_problem(
        [(float(x), 0.0) for x in range(300)], 1.0, a=[[(60.0, 0.0)] * 300], b=deceptive
    )
    assert initial_profile(problem) == Profile((299, 299), (0, 0))


def test_repetition_changes_nothing() -> None:
    """Ten runs on equal problems give ten equal profiles."""
    profiles = {
        initial_profile(sample_problem(np.random.default_rng(3), 6, 12, 12, 12)) for _ in range(10)
    }
    assert len(profiles) == 1
