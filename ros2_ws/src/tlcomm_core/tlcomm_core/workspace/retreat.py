"""The way out of what an agent avoids, when something has put it there.

``Retreat``  legs that begin in avoided cells
"""

from functools import cached_property
from typing import Final

import numpy as np

from tlcomm_core.geometry import Pose
from tlcomm_core.workspace.travel import Leg, TravelTimes

__all__ = ["Retreat"]


class Retreat:
    """Legs out of cells that no move of an agent leads to or from."""

    def __init__(self, travel: TravelTimes) -> None:
        """Lead back to where some travel times hold.

        Args:
            travel: the agent's, on a grid that may avoid something.
        """
        self._travel: Final = travel

    def leg(self, pose: Pose, home: int) -> Leg | None:
        """Return the fastest leg from an avoided cell to one that is connected with a location.

        Args:
            pose: where the agent is.
            home: the location.

        Returns:
            ``None`` if the pose isn't in an avoided cell, or if obstacles are in the way.

        Cost: one Dijkstra search per pose in an avoided cell; none elsewhere.
        """
        grid = self._travel.grid
        here = grid.location_at(pose.x_m, pose.y_m)
        if here is None or not any(here in cells for cells in grid.avoided.values()):
            return None
        time_s = self._unhindered.reach(pose).time_s
        time_s = np.where(grid.components == grid.components[home], time_s, np.inf)
        nearest = int(time_s.argmin())
        return self._unhindered.leg_from(pose, nearest) if np.isfinite(time_s[nearest]) else None

    @cached_property
    def _unhindered(self) -> TravelTimes:
        """Travel times that avoid nothing but obstacles."""
        return TravelTimes(self._travel.grid.avoiding({}), self._travel.motion)
