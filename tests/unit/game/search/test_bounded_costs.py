"""What places cost when nobody may arrive later than a given time."""

from collections.abc import Callable

import numpy as np

from tlcomm_core.game.problem import RoundProblem
from tlcomm_core.game.search.bounded_costs import BoundedCosts

MakeProblem = Callable[..., RoundProblem]

# Two places, 1 m apart; one agent with two candidates, one with a single one.
PLACES_M = [(0.0, 0.0), (1.0, 0.0)]
TABLES = {
    "alf": [[(50.0, 2.0), (70.0, 1.0)], [(80.0, 0.5), None]],
    "bea": [[(65.0, 3.0), (66.0, 4.0)]],
}


def test_costs_fall_as_later_arrivals_are_allowed(make_problem: MakeProblem) -> None:
    """The least extra travel less the arrival, of what is there in time; times from the window."""
    costs = BoundedCosts(make_problem(PLACES_M, 1.0, **TABLES))
    assert costs.at(5.0).tolist() == [[12.0, np.inf], [-2.0, np.inf]]
    assert costs.at(10.0).tolist() == [[12.0, -9.0], [-2.0, -2.0]]
    assert costs.at(20.0).tolist() == [[-19.5, -9.0], [-2.0, -2.0]]


def test_everybody_is_somewhere_from_the_earliest_time_on(make_problem: MakeProblem) -> None:
    """That is when the last can be at its nearest place, but not before the window opens."""
    assert BoundedCosts(make_problem(PLACES_M, 1.0, **TABLES)).earliest_s == 5.0
    early = {"alf": TABLES["alf"]}
    assert BoundedCosts(make_problem(PLACES_M, 1.0, **early)).earliest_s == 0.0


def test_a_profile_attains_the_costs(make_problem: MakeProblem) -> None:
    """Its potential is N times its last arrival and the costs for that."""
    costs = BoundedCosts(make_problem(PLACES_M, 1.0, **TABLES))
    profile = costs.profile((0, 1), 20.0)
    assert profile.candidate == (1, 0)
    assert costs.meeting_s(profile) == 20.0
    assert costs.potential_s(profile) == 2 * 20.0 - 19.5 - 2.0
    assert costs.profile((0, 1), 19.0).candidate == (0, 0)
