"""Ways on a map that changes round an agent."""

import pytest

from tlcomm_core.agent.ways import Ways
from tlcomm_core.geometry import Pose
from tlcomm_core.workspace.grid import Box, Grid
from tlcomm_core.workspace.travel import Motion, TravelTimes

MOTION = Motion(1.0, 1.5)
# A corridor of seven cells, with a bay above its middle.
WALLS: tuple[Box, ...] = ((0.0, 0.5, 1.5, 1.0), (2.0, 0.5, 3.5, 1.0))
HERE = Pose(1.75, 0.25, 0.0)


def travel(*boxes: Box) -> TravelTimes:
    """Return travel times in the corridor with some more boxes."""
    return TravelTimes(Grid((3.5, 1.0), 0.5, [*WALLS, *boxes]), MOTION)


def place(ways: Ways, x_m: float, y_m: float = 0.25) -> int:
    """Return the location of a point."""
    location = ways.travel.grid.location_at(x_m, y_m)
    assert location is not None
    return location


def changed(*boxes: Box, pose: Pose = HERE) -> Ways:
    """Return ways after boxes have come down while the agent was at a pose."""
    ways = Ways(travel())
    ways.change(travel(*boxes), pose)
    return ways


def test_on_a_free_cell_legs_are_those_of_the_new_map() -> None:
    """Nothing of the map before is left in them."""
    ways = changed((0.0, 0.0, 0.5, 0.5))
    target = place(ways, 3.25)
    assert ways.lead(HERE, target)
    assert ways.leg_to(HERE, target) == ways.travel.leg_to(HERE, target)
    assert ways.leg_from(HERE, target) == ways.travel.leg_from(HERE, target)


@pytest.mark.parametrize(("x_m", "exit_m"), [(3.25, 2.25), (0.25, 0.75)])
def test_out_of_a_closed_block_it_takes_the_side_of_its_target(x_m: float, exit_m: float) -> None:
    """Although the other side may be nearer; the way out ends in the first cell that is free."""
    ways = changed((1.0, 0.0, 2.0, 1.0))
    target = place(ways, x_m)
    assert ways.lead(HERE, target)
    leg = ways.leg_from(HERE, target)
    assert leg.waypoints_m[0] == (exit_m, 0.25)
    assert leg.waypoints_m[-1] == (leg.arrival.x_m, leg.arrival.y_m) == (x_m, 0.25)
    assert leg.distance_m == pytest.approx(abs(x_m - HERE.x_m))
    assert ways.leg_to(HERE, target).duration_s == pytest.approx(leg.duration_s)


def test_a_second_change_doesnt_forget_the_way_out() -> None:
    """The way out is that of the last map on which the agent's cell was free."""
    ways = changed((1.0, 0.0, 2.0, 1.0))
    ways.change(travel((0.5, 0.0, 2.5, 1.0)), HERE)
    assert ways.leg_from(HERE, place(ways, 3.25)).waypoints_m[0] == (2.75, 0.25)


def test_nothing_leads_through_a_wall() -> None:
    """What the map has cut off can't be reached, and the nearest that can is beside the wall."""
    ways = changed((2.5, 0.0, 3.0, 1.0))
    assert not ways.lead(HERE, place(ways, 3.25))
    assert not ways.lead(HERE, -1)
    assert ways.nearest(HERE, 3.25, 0.25) == place(ways, 2.25)


def test_of_equally_near_places_the_lowest_is_taken() -> None:
    """So that all who ask find the same."""
    ways = changed((1.5, 0.0, 2.0, 0.5), pose=Pose(1.75, 0.75, 0.0))
    assert ways.nearest(HERE, 1.75, 0.25) == place(ways, 1.25)


@pytest.mark.parametrize("boxes", [[(0.0, 0.0, 3.5, 1.0)], [(0.0, 0.0, 3.5, 0.5)]])
def test_enclosed_nothing_can_be_reached(boxes: list[Box]) -> None:
    """Neither where all is closed nor where no way out leads to what is free."""
    ways = changed(*boxes, pose=Pose(0.25, 0.75, 0.0))
    assert ways.nearest(Pose(0.25, 0.75, 0.0), 0.25, 0.25) is None
