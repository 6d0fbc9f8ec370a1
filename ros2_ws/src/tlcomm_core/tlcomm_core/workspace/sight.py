"""Which places see each other past the obstacles.

``sightlines``  of pairs of points, whether nothing solid is between them
``corners``     past which points sight comes and goes
"""

from collections.abc import Iterator
from typing import Final

import numpy as np
from numpy.typing import NDArray

from tlcomm_core.workspace.grid import Grid

__all__ = ["corners", "sightlines"]

# Far above the rounding of coordinates, far below anything that matters: what drives along a wall
# still sees along it.
_SKIN_M: Final = 1e-9
# Segments at a time: what is near each other in the order given meets few boxes at once.
_CHUNK: Final = 2048


def sightlines(
    grid: Grid,
    from_m: NDArray[np.float64],
    to_m: NDArray[np.float64],
    clearance_m: float = 0.0,
) -> NDArray[np.bool_]:
    """Tell of pairs of points whether they see each other.

    They do if the straight between them stays out of every obstacle as given, not of the cells
    that it closes; touching one doesn't matter. Either way round the answer is the same, to the
    bit.

    Args:
        grid: the workspace; its boxes are the obstacles.
        from_m: one point of each pair, float[..., 2], on the grid.
        to_m: the other, float[..., 2], of a shape to broadcast with.
        clearance_m: how far along x and y the straight must stay away from obstacles; when each
            point may be off by this, they still see each other.

    Returns:
        bool[...], of the shape to which the points broadcast.

    Deviates:
        Two obstacles that only touch let sight through along the line where they do.

    Source: slab test of T. L. Kay and J. T. Kajiya, "Ray tracing complex scenes", SIGGRAPH 1986.

    Cost: O(pairs · boxes), less where pairs that follow each other are close to each other.
    """
    from_m, to_m = np.broadcast_arrays(from_m, to_m)
    shape = from_m.shape[:-1]
    starts_m, ends_m = _ordered(from_m.reshape(-1, 2), to_m.reshape(-1, 2))
    inset_m = _SKIN_M - clearance_m
    low_m, high_m = grid.boxes[:, :2] + inset_m, grid.boxes[:, 2:] - inset_m
    seen = np.ones(len(starts_m), dtype=np.bool_)
    for chunk in _chunks(len(starts_m)):
        ends = np.stack((starts_m[chunk], ends_m[chunk]))
        reached = _reached(ends, low_m, high_m)
        seen[chunk] = ~_cross(ends, low_m[reached], high_m[reached])
    return seen.reshape(shape)


def corners(grid: Grid) -> NDArray[np.float64]:
    """Return the corners of the obstacles, float[4·boxes, 2], as ``sightlines`` sees them.

    While two points move freely, sight between them changes only when the straight between them
    passes a corner.
    """
    low_m, high_m = grid.boxes[:, :2] + _SKIN_M, grid.boxes[:, 2:] - _SKIN_M
    x_m = np.stack((low_m[:, 0], high_m[:, 0], high_m[:, 0], low_m[:, 0]), axis=1)
    y_m = np.stack((low_m[:, 1], low_m[:, 1], high_m[:, 1], high_m[:, 1]), axis=1)
    points_m: NDArray[np.float64] = np.stack((x_m, y_m), axis=2).reshape(-1, 2)
    return points_m


def _ordered(
    from_m: NDArray[np.float64], to_m: NDArray[np.float64]
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return the points with the lesser of each pair first, by x, then y."""
    (x_m, y_m), (other_x_m, other_y_m) = from_m.T, to_m.T
    swapped = (x_m > other_x_m) | ((x_m == other_x_m) & (y_m > other_y_m))
    swapped = swapped[:, np.newaxis]
    return np.where(swapped, to_m, from_m), np.where(swapped, from_m, to_m)


def _chunks(count: int) -> Iterator[slice]:
    return (slice(start, start + _CHUNK) for start in range(0, count, _CHUNK))


def _reached(
    ends_m: NDArray[np.float64], low_m: NDArray[np.float64], high_m: NDArray[np.float64]
) -> NDArray[np.intp]:
    """Return the boxes that overlap with the rectangle round all segments, float[2, S, 2]."""
    least_m, most_m = ends_m.min(axis=(0, 1)), ends_m.max(axis=(0, 1))
    return np.flatnonzero(((low_m < most_m) & (least_m < high_m)).all(axis=1))


def _cross(
    ends_m: NDArray[np.float64], low_m: NDArray[np.float64], high_m: NDArray[np.float64]
) -> NDArray[np.bool_]:
    """Tell of segments, float[2, S, 2], which lead through a box, bool[S]."""
    enter, leave = 0.0, 1.0
    # Axis by axis, which is quicker than reducing over two of them.
    for axis in (0, 1):
        start_m, end_m = ends_m[0][:, np.newaxis, axis], ends_m[1][:, np.newaxis, axis]
        # Along a side's very line: 0 / 0, and NaN compares as not crossing.
        with np.errstate(divide="ignore", invalid="ignore"):
            to_low = (low_m[:, axis] - start_m) / (end_m - start_m)
            to_high = (high_m[:, axis] - start_m) / (end_m - start_m)
        enter = np.maximum(enter, np.minimum(to_low, to_high))
        leave = np.minimum(leave, np.maximum(to_low, to_high))
    crossing: NDArray[np.bool_] = ((low_m < high_m).all(axis=1) & (enter < leave)).any(axis=1)
    return crossing
