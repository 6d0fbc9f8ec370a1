"""Ways to where another stands, on which the two go on hearing each other.

``Approaches``        between any two poses
``check_approaches``  whether a team can come together from where it starts
``Corners``           a way's corners
"""

from collections.abc import Sequence
from itertools import combinations
from typing import Final

import numpy as np
from numpy.typing import NDArray
from scipy.sparse.csgraph import connected_components

from tlcomm_core.errors import PlanningError
from tlcomm_core.game.links import LINK_TOLERANCE_M
from tlcomm_core.geometry import Pose
from tlcomm_core.protocol.team import Team
from tlcomm_core.scenario.model import Scenario
from tlcomm_core.workspace.grid import Grid
from tlcomm_core.workspace.sight import sightlines
from tlcomm_core.workspace.travel import TravelTimes

__all__ = ["Approaches", "Corners", "check_approaches"]

Corners = tuple[tuple[float, float], ...]
"""Points (m) to each of which a turn on the spot and a straight lead."""


class Approaches:
    """Ways to where another stands still, on which the two go on hearing each other.

    On a free straight to the other, the distance falls and sight stays. Where radios needn't see, a
    way round an obstacle does as well if its corners are in range of the other: a circle is convex,
    so all of the way is.
    """

    def __init__(self, travel: TravelTimes, team: Team) -> None:
        """Take travel times, round what is to be avoided, and a team's range and radios."""
        self._travel: Final = travel
        self._closed: Final = _closing_avoided(travel.grid)
        self._reach_m: Final = team.planned_range_m + LINK_TOLERANCE_M
        self._clearance_m: Final = team.clearance_m

    def corners_m(self, start: Pose, end: Pose) -> Corners | None:
        """Return the corners of a way, the last where the other stands; ``None`` if there is none.

        Both poses are on the grid.
        """
        start_m, end_m = (start.x_m, start.y_m), (end.x_m, end.y_m)
        if start.distance_m(*end_m) > self._reach_m:
            return None
        if start_m == end_m:
            return ()
        if self._sees(start_m, end_m) and self._closed.is_clear([start_m, end_m]):
            return (end_m,)
        return None if self._clearance_m is not None else self._round_about(start, end)

    def linked(self, poses: Sequence[Pose]) -> NDArray[np.bool_]:
        """Tell between which poses there are ways, there and back, bool[N, N]."""
        linked = np.eye(len(poses), dtype=np.bool_)
        for (one, start), (other, end) in combinations(enumerate(poses), 2):
            is_linked = self.corners_m(start, end) is not None
            linked[one, other] = is_linked and self.corners_m(end, start) is not None
        either: NDArray[np.bool_] = linked | linked.T
        return either

    def _sees(self, start_m: tuple[float, float], end_m: tuple[float, float]) -> bool:
        if self._clearance_m is None:
            return True
        grid, ends = self._travel.grid, (np.array(start_m), np.array(end_m))
        return bool(sightlines(grid, *ends, self._clearance_m))

    def _round_about(self, start: Pose, end: Pose) -> Corners | None:
        grid = self._travel.grid
        target = grid.location_at(end.x_m, end.y_m)
        if target is None or not grid.leads(start.x_m, start.y_m, target):
            return None
        corners_m = self._travel.leg_to(start, target).waypoints_m
        if any(end.distance_m(*corner_m) > self._reach_m for corner_m in corners_m):
            return None
        end_m = (end.x_m, end.y_m)
        return corners_m if corners_m[-1:] == (end_m,) else (*corners_m, end_m)


def check_approaches(scenario: Scenario, team: Team, travel: TravelTimes) -> None:
    """See whether the agents can come together from where they start.

    Args:
        scenario: whose agents.
        team: as for ``Approaches``.
        travel: as for ``Approaches``.

    Raises:
        PlanningError: some can't get to the others while they hear them.
    """
    names = list(scenario.agents)
    starts = [Pose(*scenario.agents[name].start) for name in names]
    linked = Approaches(travel, team).linked(starts)
    _, labels = connected_components(linked, directed=False)
    for name, start, label in zip(names, starts, labels.tolist(), strict=True):
        if label != labels[0]:
            raise PlanningError(
                f"agents.{name}.start: no ways within {team.planned_range_m:g} m from start to "
                f"start lead from {start.x_m!r}, {start.y_m!r} to {names[0]!r}; a team that stays "
                "connected must come together that way"
            )


def _closing_avoided(grid: Grid) -> Grid:
    """Return a grid on which cells to be avoided are obstacles."""
    cells = [location for own in grid.avoided.values() for location in own.tolist()]
    if not cells:
        return grid
    centres_m, half_m = grid.locations_m[cells], grid.cell_m / 2.0
    boxes = np.concatenate((grid.boxes, np.hstack((centres_m - half_m, centres_m + half_m))))
    return Grid(grid.size_m, grid.cell_m, boxes, grid.origin_m)
