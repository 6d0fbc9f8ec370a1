"""Ways out of what is avoided."""

import math

import numpy as np
import pytest

from tlcomm_core.geometry import Pose
from tlcomm_core.workspace.grid import Grid
from tlcomm_core.workspace.retreat import Retreat
from tlcomm_core.workspace.travel import Motion, TravelTimes

MOTION = Motion(1.0, 1.5)
# A street of eight cells; a wall parts the last two from the others.
STREET = Grid((8.0, 1.0), 1.0, [(5.9, 0.0, 6.0, 1.0)])


def avoiding(*cells: int) -> tuple[Grid, Retreat]:
    """Return the street without some of its cells, and the way out of them."""
    closed = np.isin(STREET.locations_m[:, 0] - 0.5, cells)
    grid = STREET.avoiding({"danger": np.flatnonzero(closed)})
    return grid, Retreat(TravelTimes(grid, MOTION))


def test_only_what_is_avoided_is_left() -> None:
    """Where an agent may be, behind a wall and outside there is nothing to leave."""
    grid, retreat = avoiding(2, 3)
    home = grid.location_at(0.5, 0.5)
    assert home is not None
    for x_m in (0.2, 1.9, 4.5, 5.95, 6.5, -1.0):
        assert retreat.leg(Pose(x_m, 0.5, 0.0), home) is None


@pytest.mark.parametrize(
    ("x_m", "yaw_rad", "home_m", "arrival_m", "duration_s"),
    [
        (2.5, math.pi, 0.5, 1.5, 1.0),
        (2.5, 0.0, 0.5, 1.5, 1.0 + math.pi / 1.5),
        (3.5, math.pi, 0.5, 1.5, 2.0),
        (3.5, 0.0, 4.5, 4.5, 1.0),
        (2.5, 0.0, 4.5, 4.5, 2.0),
    ],
)
def test_the_fastest_way_leads_to_where_the_agent_belongs(
    x_m: float, yaw_rad: float, home_m: float, arrival_m: float, duration_s: float
) -> None:
    """Turns count, and the other side of what is avoided is no way out."""
    grid, retreat = avoiding(2, 3)
    home = grid.location_at(home_m, 0.5)
    assert home is not None
    leg = retreat.leg(Pose(x_m, 0.5, yaw_rad), home)
    assert leg is not None
    assert leg.waypoints_m == ((arrival_m, 0.5),)
    assert leg.duration_s == pytest.approx(duration_s)


def test_no_way_leads_through_a_wall() -> None:
    """From what is avoided behind it, no way out leads home."""
    grid, retreat = avoiding(6, 7)
    home = grid.location_at(0.5, 0.5)
    assert home is not None
    assert retreat.leg(Pose(6.5, 0.5, 0.0), home) is None
