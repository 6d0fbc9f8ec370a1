"""Travel times on one grid for whatever motions its agents have.

``Atlas``  travel times by motion, shared by all that drive alike
"""

from typing import Final

from tlcomm_core.workspace.grid import Grid
from tlcomm_core.workspace.travel import Motion, TravelTimes

__all__ = ["Atlas"]


class Atlas:
    """Travel times by motion, made when they are first asked for."""

    def __init__(self, grid: Grid) -> None:
        """Begin without any."""
        self.grid: Final = grid
        self._travel: dict[Motion, TravelTimes] = {}

    def travel(self, motion: Motion) -> TravelTimes:
        """Return the travel times of a motion; the same object for equal motions."""
        if motion not in self._travel:
            self._travel[motion] = TravelTimes(self.grid, motion)
        return self._travel[motion]
