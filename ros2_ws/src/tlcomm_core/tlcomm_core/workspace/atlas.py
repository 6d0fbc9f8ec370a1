"""Travel times on one grid for whatever motions its agents have, and whatever they avoid.

``Atlas``  travel times by motion and avoided regions, shared by all that drive alike
"""

from collections.abc import Mapping
from types import MappingProxyType
from typing import Final
from weakref import WeakValueDictionary

import numpy as np
from numpy.typing import NDArray

from tlcomm_core.workspace.grid import Disc, Grid
from tlcomm_core.workspace.map_image import OccupancyMap
from tlcomm_core.workspace.travel import Motion, TravelTimes

__all__ = ["Atlas"]

_NO_REGIONS: Final[Mapping[str, Disc]] = MappingProxyType({})


class Atlas:
    """Travel times by motion and avoided regions, made when they are first asked for."""

    def __init__(self, grid: Grid, regions: Mapping[str, Disc] = _NO_REGIONS) -> None:
        """Begin without any.

        Args:
            grid: what all drive on.
            regions: what can be avoided, by name.
        """
        self.grid: Final = grid
        self._regions: Final = regions
        self._grids: dict[frozenset[str], Grid] = {frozenset(): grid}
        self._travel: dict[tuple[Motion, frozenset[str]], TravelTimes] = {}
        # All that maps of the same cells have in use, this one among them, by what is free.
        self._family: WeakValueDictionary[bytes, Atlas] = WeakValueDictionary()
        self._family[grid.free.tobytes()] = self

    def on(self, free: NDArray[np.bool_]) -> "Atlas":
        """Return the atlas of the map on which other cells are free; what isn't is an obstacle.

        The same object for equal cells, for all who ask any of its kind, as long as one is in use.

        Args:
            free: bool[rows, columns].
        """
        key = free.tobytes()
        atlas = self._family.get(key)
        if atlas is None:
            grid = self.grid
            boxes = OccupancyMap(~free, grid.cell_m, grid.origin_m).boxes()
            other = Grid(grid.size_m, grid.cell_m, boxes, grid.origin_m)
            atlas = Atlas(other, self._regions)
            atlas._family = self._family
            self._family[key] = atlas
        return atlas

    def knows(self, regions: frozenset[str]) -> bool:
        """Return whether these are regions that can be avoided."""
        return regions <= self._regions.keys()

    def grid_avoiding(self, avoided: frozenset[str]) -> Grid:
        """Return the grid on which no move enters a cell that shares area with some regions.

        The same object for equal regions.
        """
        if avoided not in self._grids:
            cells = {name: self.grid.touched_by(*self._regions[name]) for name in sorted(avoided)}
            self._grids[avoided] = self.grid.avoiding(cells)
        return self._grids[avoided]

    def travel(self, motion: Motion, avoided: frozenset[str] = frozenset()) -> TravelTimes:
        """Return the travel times of a motion that keeps out of some regions.

        The same object for equal motions and regions.
        """
        key = (motion, avoided)
        if key not in self._travel:
            self._travel[key] = TravelTimes(self.grid_avoiding(avoided), motion)
        return self._travel[key]
