"""Ways to where another stands, on which the two go on hearing each other."""

import math
from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest

from support.hall import hall
from tlcomm_core.agent.approach import Approaches, check_approaches
from tlcomm_core.errors import PlanningError
from tlcomm_core.geometry import Pose
from tlcomm_core.protocol.team import Team
from tlcomm_core.workspace.grid import Grid
from tlcomm_core.workspace.travel import Motion, TravelTimes

SIZE_M = (6.0, 2.0)
TEAM = Team(frozenset({"one", "two"}), 1.2, 30.0, 3.0)
HERE, THERE = Pose(2.25, 0.75, 0.0), Pose(3.25, 0.75, 0.0)
# Between the two; one can go round it within 1.2 m of either.
PILLAR = (2.5, 0.5, 3.0, 1.0)


def approaches(grid: Grid, team: Team = TEAM) -> Approaches:
    """Return the approaches on a map."""
    return Approaches(TravelTimes(grid, Motion(1.0, 1.5)), team)


def test_a_free_straight_is_the_way() -> None:
    """As far as one hears the other, and to its very place; nobody has to move to its own."""
    free = approaches(Grid(SIZE_M, 0.5))
    off = Pose(3.31, 0.83, 2.0)
    assert free.corners_m(HERE, THERE) == ((3.25, 0.75),)
    assert free.corners_m(HERE, off) == ((3.31, 0.83),)
    assert free.corners_m(HERE, replace(HERE, yaw_rad=1.0)) == ()
    assert free.corners_m(HERE, Pose(3.46, 0.75, 0.0)) is None


def test_an_obstacle_is_gone_round_within_range() -> None:
    """Each corner is in range of the other, the straights are free, and the end is its place."""
    pillar = Grid(SIZE_M, 0.5, [PILLAR])
    for end in (THERE, Pose(3.31, 0.75, 2.0)):
        corners_m = approaches(pillar).corners_m(HERE, end)
        assert corners_m is not None
        assert len(corners_m) > 1
        assert corners_m[-1] == (end.x_m, end.y_m)
        assert pillar.is_clear([(HERE.x_m, HERE.y_m), *corners_m])
        assert max(end.distance_m(*corner_m) for corner_m in corners_m) <= 1.2
        assert all(one != other for one, other in pairwise(corners_m))


@pytest.mark.parametrize(
    ("grid", "team"),
    [
        (Grid(SIZE_M, 0.5, [(2.5, 0.0, 3.0, 1.5)]), TEAM),
        (Grid(SIZE_M, 0.5, [(2.5, 0.0, 3.0, 2.0)]), TEAM),
        (Grid(SIZE_M, 0.5, [PILLAR]), replace(TEAM, clearance_m=0.02)),
    ],
    ids=["too far round", "no way", "out of sight"],
)
def test_where_one_would_lose_the_other_there_is_no_way(grid: Grid, team: Team) -> None:
    """A longer way may exist."""
    assert approaches(grid, team).corners_m(HERE, THERE) is None


def test_what_is_to_be_avoided_is_gone_round_too() -> None:
    """As if it were an obstacle."""
    grid = Grid(SIZE_M, 0.5)
    avoiding = grid.avoiding({"danger": grid.locations_within(2.75, 0.75, 0.1)})
    corners_m = approaches(avoiding).corners_m(HERE, THERE)
    assert corners_m is not None
    assert Grid(SIZE_M, 0.5, [PILLAR]).is_clear([(HERE.x_m, HERE.y_m), *corners_m])


def test_where_radios_must_see_straights_keep_clear_of_walls() -> None:
    """By what each may be off its place."""
    near = Grid(SIZE_M, 0.5, [(2.0, 0.5, 3.0, 1.0)])
    start, end = Pose(2.25, 0.48, 0.0), Pose(2.75, 0.48, 0.0)
    for clearance_m, is_linked in ((0.01, True), (0.03, False)):
        seeing = approaches(near, replace(TEAM, clearance_m=clearance_m))
        assert (seeing.corners_m(start, end) is not None) == is_linked


def test_links_hold_there_and_back() -> None:
    """Like the way, as far as both can take one."""
    poses = [HERE, THERE, Pose(4.25, 0.75, math.pi)]
    linked = approaches(Grid(SIZE_M, 0.5)).linked(poses)
    np.testing.assert_array_equal(linked, np.eye(3) + np.eye(3, k=1) + np.eye(3, k=-1) > 0)


def test_a_team_that_can_not_come_together_is_told_so() -> None:
    """Who stands apart from whom, and why that matters, in one line."""
    site = hall(3)
    team = replace(TEAM, planned_range_m=0.96)
    motion = Motion(1.0, 1.5)
    check_approaches(site.scenario, team, TravelTimes(site.grid, motion))
    cut = Grid(SIZE_M, 0.5, [(3.4, 0.0, 3.6, 2.0)])
    with pytest.raises(PlanningError, match=r"agents\.two\.start: no ways .* to 'one'"):
        check_approaches(site.scenario, team, TravelTimes(cut, motion))
