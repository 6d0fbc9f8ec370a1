"""Round problems from offers."""

from dataclasses import replace

import numpy as np
import pytest

from support.hall import hall, make_member
from tlcomm_core.agent.charts import Charts
from tlcomm_core.agent.rounds import MeetingRounds
from tlcomm_core.game.algorithm import solve
from tlcomm_core.game.offer import MemberOffer, PlannedStop, next_stops
from tlcomm_core.game.rules import Rules
from tlcomm_core.game.search.exact import solve_exactly
from tlcomm_core.geometry import Pose
from tlcomm_core.protocol.team import Team
from tlcomm_core.workspace.atlas import Atlas
from tlcomm_core.workspace.grid import Grid

TEAM = Team(frozenset({"one", "two"}), 0.96, 30.0, 3.0)
GRID = hall(2).grid
# A corner of the hall, as a region that may be avoided.
CORNER_DISC = (6.0, 2.0, 0.8)
CORNER = GRID.touched_by(*CORNER_DISC)
# Region a is shut off.
SHUT = Grid((6.0, 2.0), 0.5, [(1.0, 0.0, 1.5, 2.0)])
ATLAS = Atlas(GRID, {"corner": CORNER_DISC})
ROUNDS = MeetingRounds(Charts(ATLAS), TEAM, 0.0)


@pytest.fixture(scope="module")
def offer() -> MemberOffer:
    """Return what the hall's first agent offers at the start."""
    settings = make_member("one", 2)._brain._settings
    pose = Pose(2.75, 0.75, 0.0)
    stops = next_stops(settings.plan, 0, pose, settings.travel, 57.0)
    return MemberOffer("one", 0.0, pose.x_m, pose.y_m, pose.yaw_rad, 1.0, 1.5, stops)


def test_a_problem_has_the_window_and_the_planned_range(offer: MemberOffer) -> None:
    """Places are planned with the range that tolerances leave."""
    problem = ROUNDS.problem(2, 33.0, [offer, replace(offer, agent="two")])
    assert (problem.round, problem.window_s) == (2, (60.0, 90.0))
    assert problem.range_m == 0.96
    assert problem.agents == ("one", "two")
    np.testing.assert_array_equal(problem.locations_m, ATLAS.grid.locations_m)


def test_the_teams_rules_and_margin_hold(offer: MemberOffer) -> None:
    """They are the problem's, and nobody arrives in the margin."""
    strict = replace(TEAM, rules=Rules(0.5, 1), margin_s=12.0)
    problem = MeetingRounds(Charts(ATLAS), strict, 0.0).problem(1, 3.0, [offer])
    (free,) = ROUNDS.problem(1, 3.0, [offer]).candidates
    (own,) = problem.candidates
    assert problem.rules == Rules(0.5, 1)
    assert own.arrival_s[np.isfinite(own.arrival_s)].max() < 60.0 - 12.0
    assert free.arrival_s[np.isfinite(free.arrival_s)].max() > 60.0 - 12.0


def test_each_members_own_speeds_count(offer: MemberOffer) -> None:
    """Who drives slower reaches a place later, from the same stops."""
    slow = replace(offer, agent="two", linear_mps=0.5)
    fast_table, slow_table = ROUNDS.problem(1, 3.0, [offer, slow]).candidates
    rows = min(len(fast_table.arrival_s), len(slow_table.arrival_s))
    both = np.isfinite(fast_table.arrival_s[:rows]) & np.isfinite(slow_table.arrival_s[:rows])
    assert (fast_table.arrival_s[:rows][both] <= slow_table.arrival_s[:rows][both] + 1e-9).all()
    assert (fast_table.arrival_s[:rows][both] < slow_table.arrival_s[:rows][both] - 0.5).any()


@pytest.mark.parametrize("slow", ["one", "two"])
def test_the_team_meets_where_the_slow_member_is(slow: str) -> None:
    """Of two at the ends of the hall, with nothing to do elsewhere, the faster one comes."""
    homes_m = {"one": 0.75, "two": 5.25}
    offers = []
    for name, x_m in homes_m.items():
        stops = tuple(PlannedStop(index, x_m, 0.75, 0.0, 5.0 * index) for index in range(2))
        speed_mps = 0.25 if name == slow else 1.0
        offers.append(MemberOffer(name, 0.0, x_m, 0.75, 0.0, speed_mps, 1.5, stops))
    problem = ROUNDS.problem(1, 3.0, offers)
    solution = solve(problem)
    for profile in (solution.nash, solve_exactly(problem, solution.initial).profile):
        places_m = problem.locations_m[list(profile.location), 0]
        assert np.abs(places_m - homes_m[slow]).max() <= 1.0


def test_all_members_are_reckoned_with_the_allowance(offer: MemberOffer) -> None:
    """In free running arrivals are later than in lock step."""
    allowing = MeetingRounds(Charts(ATLAS), TEAM, 0.06)
    (exact,) = ROUNDS.problem(1, 3.0, [offer]).candidates
    (later,) = allowing.problem(1, 3.0, [offer]).candidates
    assert later.arrival_s[0].min() >= exact.arrival_s[0].min()
    assert np.nanmean(later.arrival_s[0] - exact.arrival_s[0]) > 0.05


def test_an_unsound_offer_is_recognised(offer: MemberOffer) -> None:
    """What a peer says needn't be possible."""
    assert ROUNDS.is_sound(offer)
    assert not ROUNDS.is_sound(replace(offer, x_m=-5.0))
    assert not ROUNDS.is_sound(replace(offer, linear_mps=0.0))


def test_what_a_member_avoids_is_closed_to_it_alone(offer: MemberOffer) -> None:
    """Its arrivals in the corner are impossible, the other's aren't."""
    careful = replace(offer, agent="two", avoided=("corner",))
    assert ROUNDS.is_sound(careful)
    bold_table, careful_table = ROUNDS.problem(1, 3.0, [offer, careful]).candidates
    assert np.isinf(careful_table.arrival_s[:, CORNER]).all()
    assert np.isfinite(bold_table.arrival_s[:, CORNER]).any()
    assert np.isfinite(careful_table.arrival_s).any()


def test_an_offer_that_contradicts_what_it_avoids_is_unsound(offer: MemberOffer) -> None:
    """A region that nobody knows, or one that the member stands in."""
    assert not ROUNDS.is_sound(replace(offer, avoided=("cellar",)))
    x_m, y_m = GRID.locations_m[CORNER[0]].tolist()
    inside = replace(offer, x_m=x_m, y_m=y_m)
    assert ROUNDS.is_sound(inside)
    assert not ROUNDS.is_sound(replace(inside, avoided=("corner",)))


def shut_charts(*maps_ns: int) -> Charts:
    """Return charts that know the hall, shut off beside where the offers are, from some times."""
    charts = Charts(ATLAS)
    for map_ns in maps_ns:
        charts.take(map_ns, SHUT.free)
    return charts


def test_a_round_is_planned_on_the_oldest_map_that_was_offered_with(offer: MemberOffer) -> None:
    """Whatever later maps one knows."""
    with_new = replace(offer, agent="two", map_ns=5)
    old = ROUNDS.problem(1, 3.0, [offer, replace(offer, agent="two")])
    mixed = MeetingRounds(shut_charts(5, 9), TEAM, 0.0).problem(1, 3.0, [offer, with_new])
    new = MeetingRounds(shut_charts(5), TEAM, 0.0).problem(
        1, 3.0, [replace(offer, map_ns=5), with_new]
    )
    assert len(mixed.locations_m) == len(GRID)
    assert len(new.locations_m) == len(SHUT)
    for known, expected in zip(mixed.candidates, old.candidates, strict=True):
        np.testing.assert_array_equal(known.arrival_s, expected.arrival_s)
        np.testing.assert_array_equal(known.extra_s, expected.extra_s)


def test_an_offer_is_sound_on_the_map_that_it_was_made_with(offer: MemberOffer) -> None:
    """So one from behind what has closed is sound with the older map only."""
    rounds = MeetingRounds(shut_charts(5), TEAM, 0.0)
    assert rounds.is_sound(offer)
    assert not rounds.is_sound(replace(offer, map_ns=5))
    assert not rounds.is_sound(replace(offer, map_ns=4))
