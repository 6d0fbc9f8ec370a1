"""What holds for every leg on every grid."""

import math
from itertools import pairwise

import numpy as np
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from tlcomm_core.geometry import Pose, wrap_angle
from tlcomm_core.workspace.grid import Grid
from tlcomm_core.workspace.travel import HEADINGS_RAD, Leg, Motion, TravelTimes

CELL_M = 0.5
MOTION = Motion(linear_mps=0.7, angular_radps=1.1)


@st.composite
def grids(draw: st.DrawFn) -> Grid:
    """Small grids with any cells closed."""
    columns, rows = draw(st.integers(1, 7)), draw(st.integers(1, 7))
    closed = draw(st.sets(st.tuples(st.integers(0, columns - 1), st.integers(0, rows - 1))))
    boxes = [(x * CELL_M, y * CELL_M, (x + 1) * CELL_M, (y + 1) * CELL_M) for x, y in closed]
    grid = Grid((columns * CELL_M, rows * CELL_M), CELL_M, boxes)
    assume(len(grid) > 0)
    return grid


def is_told_apart(yaw_rad: float) -> bool:
    """Whether a yaw isn't taken for a lattice heading, or is one."""
    off_rad = min(abs(wrap_angle(yaw_rad - heading_rad)) for heading_rad in HEADINGS_RAD)
    return off_rad == 0.0 or off_rad > 1e-6


@st.composite
def poses(draw: st.DrawFn, grid: Grid) -> Pose:
    """Poses on and off centres and lattice headings."""
    x_m, y_m = grid.locations_m[draw(st.integers(0, len(grid) - 1))].tolist()
    shift = st.sampled_from([0.0, 0.0, 0.1, -0.2])
    yaws = st.one_of(st.sampled_from(HEADINGS_RAD), st.floats(-3.1, 3.1).filter(is_told_apart))
    return Pose(x_m + draw(shift), y_m + draw(shift), draw(yaws))


def driven_s(start: Pose, leg: Leg) -> float:
    """Time of the leg from its geometry alone."""
    pose, time_s = start, 0.0
    for x_m, y_m in leg.waypoints_m:
        yaw_rad = math.atan2(y_m - pose.y_m, x_m - pose.x_m)
        time_s += abs(wrap_angle(yaw_rad - pose.yaw_rad)) / MOTION.angular_radps
        time_s += math.dist((pose.x_m, pose.y_m), (x_m, y_m)) / MOTION.linear_mps
        pose = Pose(x_m, y_m, yaw_rad)
    return time_s


@settings(max_examples=150, deadline=None)
@given(st.data())
def test_a_legs_time_is_that_of_its_geometry(data: st.DataObject) -> None:
    """Recomputed from the waypoints, duration, distance and arrival agree, as do the tables."""
    grid = data.draw(grids())
    travel, pose = TravelTimes(grid, MOTION), data.draw(poses(grid))
    target = data.draw(st.integers(0, len(grid) - 1))
    reach = travel.reach(pose)
    assume(math.isfinite(reach.time_s[target]))
    for leg in (travel.leg_to(pose, target), travel.leg_from(pose, target)):
        points = [(pose.x_m, pose.y_m), *leg.waypoints_m]
        length_m = sum(math.dist(*pair) for pair in pairwise(points))
        assert abs(driven_s(pose, leg) - leg.duration_s) < 1e-9
        assert abs(reach.time_s[target] - leg.duration_s) < 1e-9
        assert abs(length_m - leg.distance_m) < 1e-9
        assert math.dist(points[-1], grid.locations_m[target]) < 1e-9
        assert (leg.arrival.x_m, leg.arrival.y_m) == points[-1]
        if len(points) > 1:
            (x_m, y_m), (end_x_m, end_y_m) = points[-2:]
            driven_rad = math.atan2(end_y_m - y_m, end_x_m - x_m)
            assert abs(wrap_angle(driven_rad - leg.arrival.yaw_rad)) < 1e-9


@settings(max_examples=150, deadline=None)
@given(st.data())
def test_legs_between_centres_keep_half_a_cell_from_obstacles(data: st.DataObject) -> None:
    """No straight enters a closed cell or cuts a corner: half a cell stays clear on both sides."""
    grid = data.draw(grids())
    source, target = (data.draw(st.integers(0, len(grid) - 1)) for _ in range(2))
    x_m, y_m = grid.locations_m[source].tolist()
    pose = Pose(x_m, y_m, data.draw(st.sampled_from(HEADINGS_RAD)))
    travel = TravelTimes(grid, MOTION)
    assume(math.isfinite(travel.reach(pose).time_s[target]))
    for leg in (travel.leg_to(pose, target), travel.leg_from(pose, target)):
        points = np.array([(pose.x_m, pose.y_m), *leg.waypoints_m])
        for start, end in pairwise(points):
            samples = start + np.linspace(0.0, 1.0, 57)[:, None, None] * (end - start)
            outside = np.maximum(grid.boxes[:, :2] - samples, samples - grid.boxes[:, 2:])
            clearance_m = np.hypot(*np.moveaxis(np.maximum(outside, 0.0), -1, 0))
            assert (clearance_m >= CELL_M / 2.0 - 1e-9).all()


@settings(max_examples=60, deadline=None)
@given(st.data())
def test_times_obey_the_triangle_inequality(data: st.DataObject) -> None:
    """Going over a third place, with the heading one arrives with, is never faster."""
    grid = data.draw(grids())
    travel = TravelTimes(grid, MOTION)
    start, heading = data.draw(st.integers(0, len(grid) - 1)), data.draw(st.integers(0, 7))
    target = data.draw(st.integers(0, len(grid) - 1))
    x_m, y_m = grid.locations_m[start].tolist()
    reach = travel.reach(Pose(x_m, y_m, HEADINGS_RAD[heading]))
    onward_s = travel.time_to(target)[np.arange(len(grid)), reach.heading]
    assert (reach.time_s + onward_s >= reach.time_s[target] - 1e-9).all()


@settings(max_examples=60, deadline=None)
@given(st.data())
def test_the_way_back_takes_as_long(data: st.DataObject) -> None:
    """Reversed, a path has the same turns: free first and last headings make it symmetric."""
    grid = data.draw(grids())
    travel = TravelTimes(grid, MOTION)
    one, other = (data.draw(st.integers(0, len(grid) - 1)) for _ in range(2))
    there_s = travel.time_to(other)[one].min()
    back_s = travel.time_to(one)[other].min()
    assert there_s == back_s or abs(there_s - back_s) < 1e-9


@settings(max_examples=60, deadline=None)
@given(st.data(), st.floats(0.0, 0.5))
def test_the_allowance_covers_every_segment(data: st.DataObject, allowance_s: float) -> None:
    """The predicted time bounds the driven one with the allowance lost in each segment."""
    grid = data.draw(grids())
    slack = Motion(MOTION.linear_mps, MOTION.angular_radps, allowance_s)
    travel, pose = TravelTimes(grid, slack), data.draw(poses(grid))
    target = data.draw(st.integers(0, len(grid) - 1))
    reach = travel.reach(pose)
    assume(math.isfinite(reach.time_s[target]))
    for leg in (travel.leg_to(pose, target), travel.leg_from(pose, target)):
        points = [(pose.x_m, pose.y_m), *leg.waypoints_m]
        yaws = [math.atan2(b[1] - a[1], b[0] - a[0]) for a, b in pairwise(points)]
        turns = [
            abs(wrap_angle(b - a)) > 1e-6 for a, b in zip([pose.yaw_rad, *yaws], yaws, strict=False)
        ]
        segments = len(yaws) + sum(turns)
        assert leg.duration_s >= driven_s(pose, leg) + segments * allowance_s - 1e-9
        assert abs(leg.duration_s - reach.time_s[target]) < 1e-9


@settings(max_examples=60, deadline=None)
@given(st.data())
def test_the_tables_of_arrivals_are_those_of_the_legs(data: st.DataObject) -> None:
    """From every lattice state that reaches the target, the leg arrives as told."""
    grid = data.draw(grids())
    travel = TravelTimes(grid, MOTION)
    target = data.draw(st.integers(0, len(grid) - 1))
    arrivals, times_s = travel.arrivals_at(target), travel.time_to(target)
    for location, heading in np.argwhere(np.isfinite(times_s)).tolist():
        x_m, y_m = grid.locations_m[location].tolist()
        leg = travel.leg_to(Pose(x_m, y_m, HEADINGS_RAD[heading]), target)
        assert leg.arrival.yaw_rad == HEADINGS_RAD[arrivals.heading[location, heading]]
        distance_m = arrivals.distance_m[location, heading]
        assert math.isclose(leg.distance_m, distance_m, abs_tol=1e-9)
