"""Which agents hear each other, and when that may change while they drive straight.

``Reach``  range and, if obstacles matter, sight
"""

import math
from typing import Final

import numpy as np
from numpy.typing import NDArray

from tlcomm_core.workspace.grid import Grid
from tlcomm_core.workspace.sight import corners, sightlines
from tlcomm_core.world.radio import distances_m, pair_indices

__all__ = ["Reach"]

# What rounding may shift a time by, and a point along a line of sight.
_SLACK_S: Final = 2e-9
_SLACK_M2: Final = 1e-9


class Reach:
    """Range and, if obstacles matter, sight: what two agents need for hearing each other.

    Attributes:
        range_m: R.
    """

    def __init__(self, range_m: float, walls: Grid | None = None) -> None:
        """Take the range, and the grid whose boxes hide agents from each other, if they do."""
        self.range_m: Final = range_m
        self._walls: Final = walls
        self._corners_m: Final = np.empty((0, 2)) if walls is None else corners(walls)

    @property
    def is_hindered(self) -> bool:
        """Whether there is anything that hides agents from each other."""
        return len(self._corners_m) > 0

    def linked(self, places_m: NDArray[np.float64]) -> NDArray[np.bool_]:
        """Tell which pairs hear each other.

        Args:
            places_m: where all are, float[..., N, 2].

        Returns:
            bool[..., N(N-1)/2], in the order of ``pair_indices``.
        """
        linked = self.near(places_m)
        if self.is_hindered:
            *which, pairs = np.nonzero(linked)
            first, second = (members[pairs] for members in pair_indices(places_m.shape[-2]))
            linked[linked] = self.seen(places_m[(*which, first)], places_m[(*which, second)])
        return linked

    def near(self, places_m: NDArray[np.float64]) -> NDArray[np.bool_]:
        """Tell which pairs are within range, whatever is between them; as ``linked`` does."""
        near: NDArray[np.bool_] = distances_m(places_m) <= self.range_m
        return near

    def seen(self, from_m: NDArray[np.float64], to_m: NDArray[np.float64]) -> NDArray[np.bool_]:
        """Tell of pairs of places, float[K, 2] each, whether nothing hides them."""
        if self._walls is None:
            return np.ones(len(from_m), dtype=np.bool_)
        return sightlines(self._walls, from_m, to_m)

    def corner_times_s(
        self,
        places_m: NDArray[np.float64],
        velocities_mps: NDArray[np.float64],
        pairs: tuple[NDArray[np.intp], NDArray[np.intp]],
        within_s: float,
    ) -> NDArray[np.float64]:
        """Return when the straights between agents in range pass the corners of obstacles.

        Only then can sight come or go. (p + u·t − c) × (q + v·t − c) is zero at such a t: a
        quadratic for the places p and q, the velocities u and v and the corner c.

        Args:
            places_m: where all are, float[N, 2].
            velocities_mps: their velocities, which stay, float[N, 2].
            pairs: which ones are looked at, int[K] each.
            within_s: how far ahead.

        Returns:
            Times from now on, in no order; some without any change.

        Cost: O(N · corners), and a quadratic for each pair that may be near a corner.
        """
        pairs_at, corners_at = self._encounters(places_m, velocities_mps, pairs, within_s)
        first, second = (members[pairs_at] for members in pairs)
        p, q = (places_m[own] - self._corners_m[corners_at] for own in (first, second))
        u, v = velocities_mps[first], velocities_mps[second]
        times_s = _roots(_cross(u, v), _cross(u, q) + _cross(p, v), _cross(p, q))
        soon = (times_s > -_SLACK_S) & (times_s < within_s + _SLACK_S)
        times_s, at = times_s[soon], np.nonzero(soon)[1]
        to_first = p[at] + u[at] * times_s[:, np.newaxis]
        to_second = q[at] + v[at] * times_s[:, np.newaxis]
        between = (to_first * to_second).sum(axis=1) <= _SLACK_M2
        passed_s: NDArray[np.float64] = times_s[between]
        return passed_s

    def _encounters(
        self,
        places_m: NDArray[np.float64],
        velocities_mps: NDArray[np.float64],
        pairs: tuple[NDArray[np.intp], NDArray[np.intp]],
        within_s: float,
    ) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
        """Return which pairs may soon have which corners between them: both are in reach of it."""
        reach_m = self.range_m + np.abs(velocities_mps) * within_s
        offsets_m = np.abs(self._corners_m - places_m[:, np.newaxis])
        close = (offsets_m <= reach_m[:, np.newaxis]).all(axis=2)
        first, second = pairs
        pairs_at, corners_at = np.nonzero(close[first] & close[second])
        return pairs_at, corners_at


def _cross(one: NDArray[np.float64], other: NDArray[np.float64]) -> NDArray[np.float64]:
    product: NDArray[np.float64] = one[:, 0] * other[:, 1] - one[:, 1] * other[:, 0]
    return product


def _roots(
    a: NDArray[np.float64], b: NDArray[np.float64], c: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Return the roots of a·t² + b·t + c, float[2, K]; what isn't finite is none."""
    with np.errstate(divide="ignore", invalid="ignore"):
        root = np.sqrt(b * b - 4.0 * a * c)
        stable = -0.5 * (b + np.copysign(root, b))
        return np.where(root >= 0.0, np.stack((stable / a, c / stable)), math.nan)
