"""Whether obstacles stand between two agents, from their tracks alone.

``Ways``              two agents' positions at common times, straight in between
``corner_passages_s``  when an obstacle's corner is in line with them
``hidden``            whether an obstacle is between them
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

__all__ = ["Box", "Ways", "corner_passages_s", "hidden"]

# What a straight may enter an obstacle by through rounding, or by driving along it.
_SLACK_M = 1e-6

Box = tuple[float, float, float, float]
"""Corners of an obstacle: x_min, y_min, x_max, y_max in metres."""


@dataclass(frozen=True, slots=True, eq=False)
class Ways:
    """Two agents' positions at common times, straight in between.

    Attributes:
        times_s: [S] ascending.
        one_m: the first agent's, [S, 2].
        other_m: the second's, [S, 2].
    """

    times_s: NDArray[np.float64]
    one_m: NDArray[np.float64]
    other_m: NDArray[np.float64]


def corner_passages_s(ways: Ways, boxes: Sequence[Box], reach_m: float) -> NDArray[np.float64]:
    """Return when a corner of an obstacle is in line with two agents.

    Only then can sight between them come or go; most often it doesn't.

    Args:
        ways: where they are.
        boxes: the obstacles.
        reach_m: further apart than this it doesn't matter what they see.
    """
    one_m, other_m = ways.one_m, ways.other_m
    apart_m = np.hypot(*(one_m - other_m).T)
    driven_m = np.hypot(*np.diff(one_m, axis=0).T) + np.hypot(*np.diff(other_m, axis=0).T)
    legs = np.flatnonzero(apart_m[:-1] - driven_m <= reach_m)
    durations_s = np.diff(ways.times_s)[legs]
    passages_s = [np.empty(0)]
    for corner_m in _corners_m(boxes):
        one, other = one_m - corner_m, other_m - corner_m
        p, q = one[legs], other[legs]
        dp, dq = one[legs + 1] - p, other[legs + 1] - q
        for share in _roots(_cross(dp, dq), _cross(dp, q) + _cross(p, dq), _cross(p, q)):
            inside = (share > 0.0) & (share < 1.0)
            passages_s.append(ways.times_s[legs][inside] + (share * durations_s)[inside])
    return np.concatenate(passages_s)


def hidden(
    one_m: NDArray[np.float64], other_m: NDArray[np.float64], boxes: Sequence[Box]
) -> NDArray[np.bool_]:
    """Tell whether a straight leads through an obstacle, for each pair of points.

    It doesn't if some line parts them: one along an axis, or the straight's own.

    Args:
        one_m: [K, 2].
        other_m: [K, 2].
        boxes: the obstacles.

    Source: separating axis theorem.
    """
    crossing = np.zeros(len(one_m), dtype=np.bool_)
    low_m, high_m = np.minimum(one_m, other_m), np.maximum(one_m, other_m)
    for box in boxes:
        corners_m = _corners_m([box])
        overlap = (low_m < corners_m.max(axis=0)) & (corners_m.min(axis=0) < high_m)
        sides = np.stack([_cross(other_m - one_m, corner_m - one_m) for corner_m in corners_m])
        crossing |= overlap.all(axis=1) & (sides.min(axis=0) < 0.0) & (sides.max(axis=0) > 0.0)
    return crossing


def _corners_m(boxes: Sequence[Box]) -> NDArray[np.float64]:
    """Return the corners of boxes, [4·B, 2], a hair inside."""
    corners_m: NDArray[np.float64] = np.array(
        [
            corner_m
            for x_min, y_min, x_max, y_max in boxes
            for x_m in (x_min + _SLACK_M, x_max - _SLACK_M)
            for corner_m in ((x_m, y_min + _SLACK_M), (x_m, y_max - _SLACK_M))
        ]
    ).reshape(-1, 2)
    return corners_m


def _cross(one: NDArray[np.float64], other: NDArray[np.float64]) -> NDArray[np.float64]:
    product: NDArray[np.float64] = one[:, 0] * other[:, 1] - one[:, 1] * other[:, 0]
    return product


def _roots(
    a: NDArray[np.float64], b: NDArray[np.float64], c: NDArray[np.float64]
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return both roots of a·s² + b·s + c; NaN or infinite where there is none."""
    with np.errstate(divide="ignore", invalid="ignore"):
        stable = -0.5 * (b + np.copysign(np.sqrt(b * b - 4.0 * a * c), b))
        return stable / a, c / stable
