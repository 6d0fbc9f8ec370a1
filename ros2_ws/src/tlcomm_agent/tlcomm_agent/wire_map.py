"""The map as messages carry it.

``decode_map``  which cells are free, validated
"""

import math
from typing import Final

import numpy as np
from nav_msgs.msg import OccupancyGrid
from numpy.typing import NDArray

from tlcomm_core.wire import world_messages
from tlcomm_core.wire.fields import WireError
from tlcomm_core.workspace.grid import Grid

__all__ = ["decode_map"]

# The message has the resolution as a 32-bit float.
_PRECISION: Final = 1e-6


def decode_map(message: OccupancyGrid, grid: Grid) -> tuple[int, NDArray[np.bool_]]:
    """Return from when on (ns) which cells are free, bool[rows, columns].

    Args:
        message: the map.
        grid: the scenario's, whose cells the map must have.

    Raises:
        WireError: it has other cells.
    """
    info = message.info
    rows, columns = grid.shape
    if (info.width, info.height) != (columns, rows) or len(message.data) != rows * columns:
        raise WireError(f"size: {info.width} x {info.height} cells, not {columns} x {rows}")
    if not math.isclose(info.resolution, grid.cell_m, rel_tol=_PRECISION):
        raise WireError(f"resolution: {info.resolution!r} m, not {grid.cell_m!r}")
    origin_m = (info.origin.position.x, info.origin.position.y)
    slack_m = _PRECISION * grid.cell_m
    if not all(abs(a - b) <= slack_m for a, b in zip(origin_m, grid.origin_m, strict=True)):
        raise WireError(f"origin: {origin_m!r}, not {grid.origin_m!r}")
    if info.origin.orientation.x or info.origin.orientation.y or info.origin.orientation.z:
        raise WireError("origin: the map is turned")
    return world_messages.decode_map(message)
