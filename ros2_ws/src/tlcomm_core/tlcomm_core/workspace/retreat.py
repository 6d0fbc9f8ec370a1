"""The way out of where no move leads, when something has put an agent there.

``Retreat``  legs that begin in avoided cells, or in cells that the map has closed
"""

from functools import cached_property
from typing import Final

import numpy as np
from numpy.typing import NDArray

from tlcomm_core.geometry import Pose
from tlcomm_core.workspace.travel import Leg, TravelTimes

__all__ = ["Retreat"]


class Retreat:
    """Legs out of cells that no move of an agent leads to or from.

    Out of avoided cells they lead on ways that avoid nothing but obstacles; out of cells that the
    map has closed, on ways of the map before.
    """

    def __init__(self, travel: TravelTimes, before: TravelTimes | None = None) -> None:
        """Lead back to where some travel times hold.

        Args:
            travel: the agent's, on a grid that may avoid something.
            before: its travel times on the map before; ``None`` if it has never changed.
        """
        self._travel: Final = travel
        self._before: Final = before

    def leg(self, pose: Pose, home: int) -> Leg | None:
        """Return the fastest leg from such a cell to one that is connected with a location.

        Args:
            pose: where the agent is.
            home: the location.

        Returns:
            ``None`` if the pose isn't in such a cell, or if obstacles are in the way.

        Cost: one Dijkstra search per pose in such a cell; none elsewhere.
        """
        ways = self._ways(pose)
        if ways is None:
            return None
        components = self._travel.grid.components
        number, time_s = self._exits(pose, ways)
        time_s = np.where(components[number] == components[home], time_s, np.inf)
        nearest = int(time_s.argmin())
        return ways.leg_from(pose, nearest) if np.isfinite(time_s[nearest]) else None

    def reached(self, pose: Pose) -> NDArray[np.bool_]:
        """Return for each location whether it can be reached from a pose, in whatever cell."""
        grid, ways = self._travel.grid, self._ways(pose)
        if ways is None:
            here = grid.location_at(pose.x_m, pose.y_m)
            starts = np.array([] if here is None else [here], dtype=np.int32)
        else:
            number, time_s = self._exits(pose, ways)
            starts = number[np.isfinite(time_s)]
        reached: NDArray[np.bool_] = np.isin(grid.components, grid.components[starts])
        return reached

    def _exits(
        self, pose: Pose, ways: TravelTimes
    ) -> tuple[NDArray[np.int32], NDArray[np.float64]]:
        """Return each location of the ways as the grid has it, and its time from the pose.

        The time is infinite where the grid has closed it or avoids it.
        """
        number = ways.grid.numbers_in(self._travel.grid)
        lost = (number < 0) | self._is_avoided[number]
        return number, np.where(lost, np.inf, ways.reach(pose).time_s)

    def _ways(self, pose: Pose) -> TravelTimes | None:
        """Return the ways out; ``None`` if the pose needs none, or there are none."""
        here = self._travel.grid.location_at(pose.x_m, pose.y_m)
        if here is not None:
            return self._unhindered if self._is_avoided[here] else None
        if self._before is None or not len(self._travel.grid):
            return None
        if self._before.grid.location_at(pose.x_m, pose.y_m) is None:
            return None
        return self._before

    @cached_property
    def _is_avoided(self) -> NDArray[np.bool_]:
        """Whether each location is avoided."""
        grid = self._travel.grid
        is_avoided = np.zeros(len(grid), dtype=np.bool_)
        for cells in grid.avoided.values():
            is_avoided[cells] = True
        return is_avoided

    @cached_property
    def _unhindered(self) -> TravelTimes:
        """Travel times that avoid nothing but obstacles."""
        return TravelTimes(self._travel.grid.avoiding({}), self._travel.motion)
