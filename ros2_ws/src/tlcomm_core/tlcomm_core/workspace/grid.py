"""The workspace as a grid of square cells, some of them closed by obstacles.

``Grid``          cells, their centres (*locations*) and the moves between them
``HEADING_STEPS`` cell steps (columns, rows) of the eight lattice headings, 45° apart from +x on
``Box``           a closed rectangle: x_min, y_min, x_max, y_max in metres
``Disc``          a closed disc: x, y of its middle and radius in metres
"""

import math
from collections.abc import Mapping, Sequence
from functools import cached_property
from itertools import pairwise
from types import MappingProxyType
from typing import Final, TypeVar

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

__all__ = ["HEADING_STEPS", "Box", "Disc", "Grid"]

Box = tuple[float, float, float, float]
Disc = tuple[float, float, float]

HEADING_STEPS: Final = ((1, 0), (1, 1), (0, 1), (-1, 1), (-1, 0), (-1, -1), (0, -1), (1, -1))

_Array = TypeVar("_Array", bound=NDArray[np.generic])

_NOTHING: Final[Mapping[str, NDArray[np.intp]]] = MappingProxyType({})

# Share of a cell that a box may overlap, or a size fall short, through rounding alone.
_ROUNDING_SHARE: Final = 1e-6


class Grid:
    """Square cells over a rectangle; immutable.

    A *location* is an index z into ``locations_m``, the centres of the free cells. A cell is
    closed when an obstacle covers some of its area; touching edges don't count, and obstacles are
    not inflated. What is to be avoided keeps its locations, but no move leads there.

    Attributes:
        cell_m: edge length of a cell.
        origin_m: lower left corner (x, y).
        shape: (rows along y, columns along x).
        boxes: the obstacles as given, float[B, 4] in metres; read-only.
        free: bool[rows, columns]; read-only.
        locations_m: centres of the free cells, float[Z, 2], by y, then x; read-only.
        avoided: by name, the locations that no move leads to or from.
    """

    def __init__(
        self,
        size_m: tuple[float, float],
        cell_m: float,
        boxes: Sequence[Box] | NDArray[np.float64] = (),
        origin_m: tuple[float, float] = (0.0, 0.0),
        avoided: Mapping[str, NDArray[np.intp]] = _NOTHING,
    ) -> None:
        """Lay cells over a rectangle and close those that an obstacle covers in part.

        Args:
            size_m: extent along x and y; what is left over beyond whole cells is closed.
            cell_m: edge length of a cell.
            boxes: closed rectangles (x_min, y_min, x_max, y_max); may reach outside.
            origin_m: lower left corner.
            avoided: what no move leads to or from: locations by name.
        """
        self.cell_m: Final = cell_m
        self.origin_m: Final = origin_m
        columns, rows = (math.floor(length_m / cell_m + _ROUNDING_SHARE) for length_m in size_m)
        self.shape: Final = (rows, columns)
        self.boxes: Final = _read_only(np.array(boxes, dtype=np.float64).reshape(-1, 4))
        free = np.ones(self.shape, dtype=np.bool_)
        for box in self.boxes:
            free[self._covered(box)] = False
        self.free: Final = _read_only(free)
        occupied_rows, occupied_columns = np.nonzero(free)
        cells = np.column_stack((occupied_columns, occupied_rows))
        self.locations_m: Final = _read_only(np.array(origin_m) + (cells + 0.5) * cell_m)
        self.avoided: Final = avoided

    def __len__(self) -> int:
        """Return the number of locations Z."""
        return len(self.locations_m)

    @property
    def size_m(self) -> tuple[float, float]:
        """Extent of the whole cells along x and y."""
        return self.shape[1] * self.cell_m, self.shape[0] * self.cell_m

    def contains(self, x_m: float, y_m: float) -> bool:
        """Tell whether a point lies on the grid, free or not, its border included."""
        return all(
            origin_m <= value_m <= origin_m + length_m
            for value_m, origin_m, length_m in zip(
                (x_m, y_m), self.origin_m, self.size_m, strict=True
            )
        )

    def location_at(self, x_m: float, y_m: float) -> int | None:
        """Return the location whose cell contains a point; None if closed or outside."""
        if not self.contains(x_m, y_m):
            return None
        row = min(int((y_m - self.origin_m[1]) / self.cell_m), self.shape[0] - 1)
        column = min(int((x_m - self.origin_m[0]) / self.cell_m), self.shape[1] - 1)
        index = int(self.numbers[row, column])
        return None if index < 0 else index

    def locations_within(self, x_m: float, y_m: float, radius_m: float) -> NDArray[np.intp]:
        """Return the locations, in order, whose centres lie in a closed disc. Cost: O(Z)."""
        return np.flatnonzero(self._distances_m(x_m, y_m) <= radius_m)

    def touched_by(self, x_m: float, y_m: float, radius_m: float) -> NDArray[np.intp]:
        """Return the locations, in order, whose cells share more than an edge with a disc.

        Cost: O(Z).
        """
        beyond_m = np.abs(self.locations_m - (x_m, y_m)) - self.cell_m / 2.0
        gap_m = np.hypot(*np.maximum(beyond_m, 0.0).T)
        return np.flatnonzero(gap_m < radius_m - _ROUNDING_SHARE * self.cell_m)

    def avoiding(self, avoided: Mapping[str, NDArray[np.intp]]) -> "Grid":
        """Return a grid of the same locations, equally numbered, some of which no move touches.

        Args:
            avoided: what to avoid instead of what this grid does: locations by name.
        """
        return Grid(self.size_m, self.cell_m, self.boxes, self.origin_m, avoided)

    def numbers_in(self, other: "Grid") -> NDArray[np.int32]:
        """Return each location's number in a grid of the same cells, int32[Z]; -1 if closed."""
        numbers: NDArray[np.int32] = other.numbers[self.free]
        return numbers

    def near(self, location: int, range_m: float) -> NDArray[np.bool_]:
        """Tell for every location whether it is within ``range_m`` of ``location``. Cost: O(Z)."""
        x_m, y_m = self.locations_m[location]
        return self._distances_m(x_m, y_m) <= range_m

    def leads(self, x_m: float, y_m: float, location: int) -> bool:
        """Tell whether moves lead from a point to a location; none do out of a closed cell."""
        here = self.location_at(x_m, y_m)
        if here is None or location < 0:
            return False
        return bool(self.components[here] == self.components[location])

    def is_clear(self, points_m: Sequence[tuple[float, float]]) -> bool:
        """Tell whether straights along points on the grid touch no closed cell, nor its corners."""
        return all(
            self._is_clear(np.array(point_m), np.array(following_m))
            for point_m, following_m in pairwise(points_m)
        )

    def _is_clear(self, start_m: NDArray[np.float64], end_m: NDArray[np.float64]) -> bool:
        low_m, high_m = np.minimum(start_m, end_m), np.maximum(start_m, end_m)
        around = self._covered(np.concatenate((low_m - self.cell_m, high_m + self.cell_m)))
        rows, columns = np.nonzero(~self.free[around])
        corners = np.column_stack((columns + around[1].start, rows + around[0].start))
        # As seen from the start, in cells; touching counts although coordinates are rounded.
        low = corners - (start_m - self.origin_m) / self.cell_m - _ROUNDING_SHARE
        high = low + 1.0 + 2.0 * _ROUNDING_SHARE
        step = (end_m - start_m) / self.cell_m
        # Along an axis that it doesn't move along: ±inf, as slabs need it.
        with np.errstate(divide="ignore", invalid="ignore"):
            bounds = np.stack((low / step, high / step))
        enters = np.maximum(bounds.min(axis=0).max(axis=1), 0.0)
        leaves = np.minimum(bounds.max(axis=0).min(axis=1), 1.0)
        return not bool((enters <= leaves).any())

    @cached_property
    def moves(self) -> NDArray[np.int32]:
        """The neighbour of each location along each lattice heading, int32[Z, 8]; -1 for none.

        A diagonal move needs both cells beside it free and not avoided: no corner is cut.
        Read-only.
        """
        padded = np.full((self.shape[0] + 2, self.shape[1] + 2), -1, dtype=np.int32)
        padded[1:-1, 1:-1] = self.numbers
        closed = [location for own in self.avoided.values() for location in own.tolist()]
        padded[np.isin(padded, closed)] = -1
        rows, columns = (indices + 1 for indices in np.nonzero(self.free))
        moves = np.empty((len(self), 8), dtype=np.int32)
        for heading, (dx, dy) in enumerate(HEADING_STEPS):
            target = padded[rows + dy, columns + dx]
            open_sides = (padded[rows, columns + dx] >= 0) & (padded[rows + dy, columns] >= 0)
            moves[:, heading] = np.where(open_sides, target, -1)
        moves[closed] = -1
        return _read_only(moves)

    @cached_property
    def components(self) -> NDArray[np.int32]:
        """A label per location, int32[Z]; equal where moves lead from one to the other."""
        sources, headings = np.nonzero(self.moves >= 0)
        ones = np.ones(len(sources), dtype=np.int8)
        entries = (ones, (sources, self.moves[sources, headings]))
        graph = coo_array(entries, shape=(len(self), len(self)))
        _, labels = connected_components(graph, directed=False)
        return _read_only(np.asarray(labels, dtype=np.int32))

    @cached_property
    def numbers(self) -> NDArray[np.int32]:
        """Location of each cell, int32[rows, columns]; -1 where closed. Read-only."""
        index = np.full(self.shape, -1, dtype=np.int32)
        index[self.free] = np.arange(len(self), dtype=np.int32)
        return _read_only(index)

    def _distances_m(self, x_m: float, y_m: float) -> NDArray[np.float64]:
        distances_m: NDArray[np.float64] = np.hypot(
            self.locations_m[:, 0] - x_m, self.locations_m[:, 1] - y_m
        )
        return distances_m

    def _covered(self, box: NDArray[np.float64]) -> tuple[slice, slice]:
        """Return the rows and columns of the cells that a box covers in part."""
        x_min, y_min, x_max, y_max = box
        columns = self._span(x_min - self.origin_m[0], x_max - self.origin_m[0])
        rows = self._span(y_min - self.origin_m[1], y_max - self.origin_m[1])
        return rows, columns

    def _span(self, low_m: float, high_m: float) -> slice:
        first = math.floor(low_m / self.cell_m + _ROUNDING_SHARE)
        end = math.ceil(high_m / self.cell_m - _ROUNDING_SHARE)
        return slice(max(first, 0), max(end, 0))


def _read_only(array: _Array) -> _Array:
    array.setflags(write=False)
    return array
