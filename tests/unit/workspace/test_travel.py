"""Legs and travel times on small grids, by hand."""

import math

import numpy as np
import pytest

from tlcomm_core.errors import LocalMisuseError
from tlcomm_core.geometry import Pose
from tlcomm_core.workspace.grid import Grid
from tlcomm_core.workspace.travel import HEADINGS_RAD, Motion, TravelTimes

OPEN = Grid((2.5, 2.5), 0.5)
MOTION = Motion(linear_mps=1.0, angular_radps=1.5)
QUARTER_TURN_S = math.pi / 2.0 / 1.5


def pose_at(grid: Grid, location: int, yaw_rad: float = 0.0) -> Pose:
    """The pose at a location's centre."""
    x_m, y_m = grid.locations_m[location].tolist()
    return Pose(x_m, y_m, yaw_rad)


def test_straight_ahead_takes_its_length() -> None:
    """Without a turn the time is length over speed, the heading kept."""
    leg = TravelTimes(OPEN, MOTION).leg_to(pose_at(OPEN, 0), 4)
    assert leg.waypoints_m == ((2.25, 0.25),)
    assert leg.duration_s == pytest.approx(2.0)
    assert leg.distance_m == pytest.approx(2.0)
    assert leg.arrival == pose_at(OPEN, 4)


def test_a_turn_takes_its_angle() -> None:
    """Facing east, going north costs a quarter turn first."""
    leg = TravelTimes(OPEN, MOTION).leg_from(pose_at(OPEN, 0), 20)
    assert leg.waypoints_m == ((0.25, 2.25),)
    assert leg.duration_s == pytest.approx(QUARTER_TURN_S + 2.0)
    assert leg.arrival == pose_at(OPEN, 20, HEADINGS_RAD[2])


@pytest.mark.parametrize("yaw_rad", [0.0, 0.3])
def test_staying_costs_nothing_and_keeps_the_pose(yaw_rad: float) -> None:
    """A leg from a centre to itself is empty, at any yaw."""
    travel, pose = TravelTimes(OPEN, Motion(1.0, 1.5, 0.1)), pose_at(OPEN, 7, yaw_rad)
    for leg in (travel.leg_to(pose, 7), travel.leg_from(pose, 7)):
        assert leg.waypoints_m == ()
        assert leg.duration_s == 0.0
        assert leg.distance_m == 0.0
        assert leg.arrival == pose
    assert travel.time_to(7)[7].tolist() == [0.0] * 8
    assert travel.reach(pose).time_s[7] == 0.0
    assert travel.reach(pose).heading[7] == 0


def test_a_pose_that_rounding_moved_is_its_lattice_state() -> None:
    """Poses within a micrometre and a microradian share one search and one leg."""
    travel, exact = TravelTimes(OPEN, MOTION), pose_at(OPEN, 12, math.pi)
    moved = Pose(exact.x_m + 5e-7, exact.y_m - 5e-7, -math.pi + 5e-7)
    assert travel.reach(moved) is travel.reach(exact)
    assert travel.leg_to(moved, 3) == travel.leg_to(exact, 3)


def test_a_yaw_off_the_lattice_turns_straight_to_the_first_drive() -> None:
    """At a centre, the first turn is the difference to the direction of travel."""
    travel = TravelTimes(OPEN, MOTION)
    for leg in (travel.leg_to(pose_at(OPEN, 0, 0.3), 4), travel.leg_from(pose_at(OPEN, 0, 0.3), 4)):
        assert leg.waypoints_m == ((2.25, 0.25),)
        assert leg.duration_s == pytest.approx(0.3 / 1.5 + 2.0)


def test_away_from_a_centre_the_leg_begins_with_the_centre_of_its_cell() -> None:
    """The approach is a turn and a straight; then the path goes on from there."""
    travel, pose = TravelTimes(OPEN, MOTION), Pose(0.35, 0.25, 0.0)
    for leg in (travel.leg_to(pose, 4), travel.leg_from(pose, 4)):
        assert leg.waypoints_m == ((0.25, 0.25), (2.25, 0.25))
        assert leg.duration_s == pytest.approx(2.0 * math.pi / 1.5 + 0.1 + 2.0)
        assert leg.distance_m == pytest.approx(2.1)
    assert travel.reach(pose).time_s[4] == pytest.approx(leg.duration_s)


def test_approaching_the_own_centre_keeps_the_direction_of_approach() -> None:
    """A leg to the own cell's centre arrives with the yaw that it drove with."""
    travel, pose = TravelTimes(OPEN, MOTION), Pose(0.20, 0.15, 0.0)
    yaw_rad = math.atan2(0.10, 0.05)
    for leg in (travel.leg_to(pose, 0), travel.leg_from(pose, 0)):
        assert leg.waypoints_m == ((0.25, 0.25),)
        assert leg.duration_s == pytest.approx(yaw_rad / 1.5 + math.hypot(0.05, 0.10))
        assert leg.arrival.yaw_rad == pytest.approx(yaw_rad)
    assert travel.reach(pose).time_s[0] == pytest.approx(leg.duration_s)
    assert travel.reach(pose).heading[0] == 1


def test_equal_paths_arrive_at_the_lowest_heading() -> None:
    """Two mirror paths around an obstacle tie; the lower arrival heading is taken."""
    grid = Grid((1.5, 1.5), 0.5, [(0.5, 0.5, 1.0, 1.0)])
    # From the west cell, facing east, to the east cell: over the north or over the south.
    reach = TravelTimes(grid, MOTION).reach(pose_at(grid, 3))
    mirrored = TravelTimes(grid, MOTION).leg_from(pose_at(grid, 3), 4)
    assert reach.heading[4] == 2
    assert mirrored.waypoints_m == ((0.25, 0.25), (1.25, 0.25), (1.25, 0.75))


def test_the_allowance_is_charged_per_turn_and_per_leg() -> None:
    """Twice per 45°, twice per leg, twice for a turn off the lattice."""
    plain, slack = TravelTimes(OPEN, MOTION), TravelTimes(OPEN, Motion(1.0, 1.5, 0.05))
    for yaw_rad, charges in ((0.0, 1), (math.pi / 4.0, 2), (math.pi, 5), (0.1, 2)):
        pose = pose_at(OPEN, 0, yaw_rad)
        for plain_leg, leg in (
            (plain.leg_to(pose, 4), slack.leg_to(pose, 4)),
            (plain.leg_from(pose, 4), slack.leg_from(pose, 4)),
        ):
            assert leg.duration_s - plain_leg.duration_s == pytest.approx(0.1 * charges)


def test_no_path_is_infinite_in_tables_and_an_error_as_a_leg() -> None:
    """What is cut off can be asked about, but not driven to."""
    grid = Grid((1.5, 0.5), 0.5, [(0.5, 0.0, 1.0, 0.5)])
    travel, pose = TravelTimes(grid, MOTION), pose_at(grid, 0)
    assert np.isinf(travel.reach(pose).time_s[1])
    assert np.isinf(travel.time_to(1)[0]).all()
    with pytest.raises(LocalMisuseError, match="no path"):
        travel.leg_to(pose, 1)
    with pytest.raises(LocalMisuseError, match="no path"):
        travel.leg_from(pose, 1)


def test_a_pose_in_a_closed_cell_is_refused() -> None:
    """There is no leg out of an obstacle or from outside."""
    grid = Grid((1.5, 0.5), 0.5, [(0.5, 0.0, 1.0, 0.5)])
    travel = TravelTimes(grid, MOTION)
    for x_m in (0.75, 2.0):
        with pytest.raises(LocalMisuseError, match="isn't in a free cell"):
            travel.leg_to(Pose(x_m, 0.25, 0.0), 0)


def test_tables_are_read_only_and_searched_once() -> None:
    """Callers share the cached arrays and can't change them."""
    travel = TravelTimes(OPEN, MOTION)
    reach = travel.reach(pose_at(OPEN, 0))
    for array in (travel.time_to(3), reach.time_s, reach.heading):
        assert not array.flags.writeable
    assert np.shares_memory(travel.time_to(3), travel.time_to(3))


def test_what_was_prepared_isnt_searched_again(monkeypatch: pytest.MonkeyPatch) -> None:
    """From a prepared location every lattice heading is at hand."""
    grid = Grid((3.0, 3.0), 0.5)
    travel = TravelTimes(grid, Motion(1.0, 1.5))
    travel.prepare([4])
    monkeypatch.delattr(TravelTimes, "_search_out_of")
    for heading_rad in HEADINGS_RAD:
        assert travel.reach(pose_at(grid, 4, heading_rad)).time_s[4] == 0.0
    with pytest.raises(AttributeError):
        travel.reach(pose_at(grid, 5))
