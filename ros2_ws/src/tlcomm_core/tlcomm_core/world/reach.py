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

    def sight_changes_s(
        self,
        places_m: NDArray[np.float64],
        velocities_mps: NDArray[np.float64],
        linked: NDArray[np.bool_],
        within_s: float,
    ) -> tuple[NDArray[np.float64], NDArray[np.intp]]:
        """Return when sight between agents in range comes or goes, if all go on straight.

        That is only when a corner of an obstacle is in line with both. Such times are left out if
        afterwards, as the middle before the pair's next one tells, sight is the same as now.

        Args:
            places_m: where all are, float[N, 2].
            velocities_mps: their velocities, which stay, float[N, 2].
            linked: the pairs that are linked now, bool[N(N-1)/2].
            within_s: how far ahead.

        Returns:
            Times from now on, in no order; and whose, as indices of pairs.

        Cost: O(N² + N · corners), and a quadratic for each pair that is near a corner.
        """
        times_s, pairs = self._in_line(places_m, velocities_mps, within_s)
        order = np.lexsort((times_s, pairs))
        times_s, pairs = times_s[order], pairs[order]
        is_last = np.ones(len(pairs), dtype=np.bool_)
        is_last[:-1] = pairs[1:] != pairs[:-1]
        middles_s = (times_s + np.where(is_last, within_s, np.roll(times_s, -1))) / 2.0
        from_m, to_m = (
            places_m[own] + velocities_mps[own] * middles_s[:, np.newaxis]
            for own in self._members(pairs, len(places_m))
        )
        linked_then = ((to_m - from_m) ** 2).sum(axis=1) <= self.range_m**2
        linked_then[linked_then] = self.seen(from_m[linked_then], to_m[linked_then])
        changed = linked_then != linked[pairs]
        return times_s[changed], pairs[changed]

    def _in_line(
        self,
        places_m: NDArray[np.float64],
        velocities_mps: NDArray[np.float64],
        within_s: float,
    ) -> tuple[NDArray[np.float64], NDArray[np.intp]]:
        """Return when corners are between agents and in line with both, and which pairs these are.

        (p + u·t − c) × (q + v·t − c) is zero then, for the places p and q, the velocities u and v
        and the corner c.
        """
        pairs, corners_at = self._encounters(places_m, velocities_mps, within_s)
        first, second = self._members(pairs, len(places_m))
        p, q = (places_m[own] - self._corners_m[corners_at] for own in (first, second))
        u, v = velocities_mps[first], velocities_mps[second]
        times_s = _roots(_cross(u, v), _cross(u, q) + _cross(p, v), _cross(p, q))
        soon = (times_s > -_SLACK_S) & (times_s < within_s + _SLACK_S)
        times_s, at = times_s[soon], np.nonzero(soon)[1]
        to_first = p[at] + u[at] * times_s[:, np.newaxis]
        to_second = q[at] + v[at] * times_s[:, np.newaxis]
        between = (to_first * to_second).sum(axis=1) <= _SLACK_M2
        return times_s[between], pairs[at[between]]

    def _encounters(
        self,
        places_m: NDArray[np.float64],
        velocities_mps: NDArray[np.float64],
        within_s: float,
    ) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
        """Return which pairs may soon be in range with which corners between them."""
        first, second = pair_indices(len(places_m))
        driven_m = np.abs(velocities_mps).sum(axis=1) * within_s
        near = distances_m(places_m) <= self.range_m + driven_m[first] + driven_m[second]
        moving = driven_m > 0.0
        pairs = np.flatnonzero(near & (moving[first] | moving[second]))
        offsets_m = np.abs(self._corners_m - places_m[:, np.newaxis])
        offsets_m = np.maximum(offsets_m[..., 0], offsets_m[..., 1])
        close = offsets_m <= (self.range_m + driven_m)[:, np.newaxis]
        at, corners_at = np.nonzero(close[first[pairs]] & close[second[pairs]])
        return pairs[at], corners_at

    def _members(
        self, pairs: NDArray[np.intp], count: int
    ) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
        first, second = pair_indices(count)
        return first[pairs], second[pairs]


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
