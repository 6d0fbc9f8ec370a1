"""The cells of a map: which are free, and where moves lead.

``HEADINGS``  how many directions moves have
``Cells``     the free cells
``Moves``     the moves between them
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from tlcomm_core.scenario.model import Region, Workspace
from tlcomm_tools.audit.sight import Box

__all__ = ["HEADINGS", "Cells", "Moves"]

# Columns and rows of a move along each heading, 45 degrees apart from +x on.
_STEPS: Final = ((1, 0), (1, 1), (0, 1), (-1, 1), (-1, 0), (-1, -1), (0, -1), (1, -1))
HEADINGS: Final = len(_STEPS)

# What an obstacle, a size or a region may be beyond a cell's edge through rounding, in cells.
_SLACK: Final = 1e-6


@dataclass(frozen=True, slots=True, eq=False)
class Moves:
    """All moves, one after the other.

    Attributes:
        start: [M] the cell that each leads from.
        end: [M] the cell that it leads to.
        heading: [M] its direction, from 0 to 7.
        length_m: [M].
    """

    start: NDArray[np.intp]
    end: NDArray[np.intp]
    heading: NDArray[np.intp]
    length_m: NDArray[np.float64]


class Cells:
    """The free cells of a map, numbered by row, then column.

    Attributes:
        free: bool[rows, columns]; a cell is closed if an obstacle covers some of its area.
        centres_m: [Z, 2] the middles of the free ones.
    """

    def __init__(self, workspace: Workspace, boxes: Sequence[Box]) -> None:
        """Lay cells over a workspace with obstacles."""
        self._cell_m: Final = workspace.cell_m
        self._origin_m: Final = workspace.origin_m
        columns, rows = (int(own / self._cell_m + _SLACK) for own in workspace.size_m)
        free = np.ones((rows, columns), dtype=np.bool_)
        for x_min, y_min, x_max, y_max in boxes:
            beside_x = self._overlap(columns, x_min - self._origin_m[0], x_max - self._origin_m[0])
            beside_y = self._overlap(rows, y_min - self._origin_m[1], y_max - self._origin_m[1])
            free &= ~np.outer(beside_y, beside_x)
        self.free: Final = free
        self._numbers: Final = np.where(free, np.cumsum(free).reshape(free.shape) - 1, -1)
        in_rows, in_columns = np.nonzero(free)
        middles = np.stack([in_columns, in_rows], axis=1) + 0.5
        self.centres_m: Final = np.array(self._origin_m) + middles * self._cell_m

    def __len__(self) -> int:
        """Return how many are free, Z."""
        return len(self.centres_m)

    def _overlap(self, count: int, low_m: float, high_m: float) -> NDArray[np.bool_]:
        """Tell which of a row of cells a stretch covers in part."""
        edges = np.arange(count)
        after: NDArray[np.bool_] = edges + 1 - low_m / self._cell_m > _SLACK
        return after & (high_m / self._cell_m - edges > _SLACK)

    def at(self, x_m: float, y_m: float) -> int | None:
        """Return the free cell that a point is in, if it is in one."""
        found = []
        for value_m, origin_m, count in zip(
            (y_m, x_m), self._origin_m[::-1], self.free.shape, strict=True
        ):
            if not origin_m <= value_m <= origin_m + count * self._cell_m:
                return None
            found.append(min(int((value_m - origin_m) / self._cell_m), count - 1))
        number = int(self._numbers[found[0], found[1]])
        return None if number < 0 else number

    def touching(self, region: Region) -> NDArray[np.bool_]:
        """Tell, [Z], which share more than an edge with a region's disc."""
        beyond_m = np.abs(self.centres_m - region.at_m) - self._cell_m / 2.0
        gap_m = np.hypot(*np.maximum(beyond_m, 0.0).T)
        touching: NDArray[np.bool_] = gap_m < region.radius_m - _SLACK * self._cell_m
        return touching

    def moves(self, avoided: NDArray[np.bool_]) -> Moves:
        """Return the moves to the eight neighbours, none of which enters or leaves what is avoided.

        A diagonal one needs both cells beside it.

        Args:
            avoided: [Z] which cells.
        """
        numbers = np.pad(self._numbers, 1, constant_values=-1)
        numbers[np.isin(numbers, np.flatnonzero(avoided))] = -1
        rows, columns = np.nonzero(numbers >= 0)
        found = []
        for heading, (dx, dy) in enumerate(_STEPS):
            ends = numbers[rows + dy, columns + dx]
            beside = (numbers[rows, columns + dx] >= 0) & (numbers[rows + dy, columns] >= 0)
            may = (ends >= 0) & beside
            starts = numbers[rows[may], columns[may]]
            found.append((starts, ends[may], np.full(len(starts), heading)))
        start, end, heading = (np.concatenate(column) for column in zip(*found, strict=True))
        unit_m = np.hypot(*np.array(_STEPS, dtype=np.float64).T) * self._cell_m
        return Moves(start, end, heading, unit_m[heading])

    def closed_boxes(self) -> tuple[Box, ...]:
        """Return boxes that together are the closed cells: each a stretch of one row."""
        closed = np.pad(~self.free, ((0, 0), (1, 1))).astype(np.int8)
        steps = np.diff(closed, axis=1)
        rows, begins = np.nonzero(steps > 0)
        _, ends = np.nonzero(steps < 0)
        corners = np.stack([begins, rows, ends, rows + 1], axis=1) * self._cell_m
        return tuple(
            (float(own[0]), float(own[1]), float(own[2]), float(own[3]))
            for own in corners + np.tile(self._origin_m, 2)
        )
