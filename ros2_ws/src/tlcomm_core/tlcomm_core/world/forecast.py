"""When the communication graph changes next, as long as no velocity does.

``LinkChange``  a time and the links from then on
``Forecast``    the next change, found for courses that are constant from a time on
"""

import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from operator import itemgetter
from typing import Final

import numpy as np
from numpy.typing import NDArray

from tlcomm_core.world.course import Course
from tlcomm_core.world.radio import pair_indices
from tlcomm_core.world.reach import Reach
from tlcomm_core.world.unicycle import positions

__all__ = ["Forecast", "LinkChange"]

# How far arcs are followed at a time, and how finely.
_WINDOW_NS: Final = 100_000_000
_SAMPLE_NS: Final = 20_000_000
# How long a computed crossing may take to show in rounded positions before it counts as a touch.
_PATIENCE_NS: Final = 1 << 20
_FOREVER_S: Final = 1e9
_FOREVER_NS: Final = 1 << 62


@dataclass(frozen=True, slots=True)
class LinkChange:
    """From ``time_ns`` on these pairs are linked, bool[N(N-1)/2] by ``pair_indices``."""

    time_ns: int
    linked: NDArray[np.bool_]


class Forecast:
    """The next link change of bodies that keep their velocities.

    A pair whose relative motion is linear crosses the range at a root of a quadratic, and so does
    its line of sight cross a corner. Pairs with an arc in them are sampled every 20 ms. Arcs and
    sight are followed in windows of 0.1 s. Whatever is found is then rounded up to the first
    nanosecond at which ``Reach`` sees the change in the positions as they are read. A crossing
    that never shows there (a grazing contact, a distance that stays equal to the range) is none.

    Everything is computed from ``from_ns`` and whole windows after it, so results don't depend on
    how often or when they are asked for.

    Deviates:
        Within 20 ms an arc may enter and leave range or sight, or the reverse, unnoticed.
    """

    def __init__(
        self, courses: Sequence[Course], linked: NDArray[np.bool_], reach: Reach, from_ns: int
    ) -> None:
        """Look ahead from ``from_ns``.

        Args:
            courses: all bodies'.
            linked: the pairs that are linked so far, bool[N(N-1)/2].
            reach: what links need.
            from_ns: from when on the courses are constant.
        """
        self._courses = courses
        self._linked = linked
        self._reach = reach
        self._curved = np.array([course.curved for course in courses])
        self._velocities_mps = np.array([_velocity_mps(course) for course in courses])
        self._followed_ns = _FOREVER_NS
        places_m = self._places_m(from_ns)
        now_linked = reach.linked(places_m)
        if (now_linked != linked).any():
            self._change: LinkChange | None = LinkChange(from_ns, now_linked)
            return
        self._change = self._first_shown(self._crossings_ns(from_ns, places_m))
        if self._curved.any() or (reach.is_hindered and self._velocities_mps.any()):
            self._followed_ns = from_ns

    def until(self, limit_ns: int) -> LinkChange | None:
        """Return the next change if it is at ``limit_ns`` or before, followed so far."""
        while self._followed_ns < self._end_ns(limit_ns):
            self._follow()
        if self._change is None or self._change.time_ns > limit_ns:
            return None
        return self._change

    def _end_ns(self, limit_ns: int) -> int:
        return limit_ns if self._change is None else min(limit_ns, self._change.time_ns)

    def _follow(self) -> None:
        """Look for changes by arcs and of sight in the next window."""
        start_ns = self._followed_ns
        self._followed_ns = start_ns + _WINDOW_NS
        brackets = [*self._seen_on_arcs(start_ns), *self._sight_changes_ns(start_ns)]
        change = self._first_shown(sorted(brackets, key=itemgetter(1)))
        if change and (self._change is None or change.time_ns < self._change.time_ns):
            self._change = change

    def _seen_on_arcs(self, start_ns: int) -> Iterator[tuple[int, int]]:
        """Yield between which samples pairs with an arc change."""
        if not self._curved.any():
            return
        times_ns = np.arange(start_ns, start_ns + _WINDOW_NS + 1, _SAMPLE_NS)
        first, second = pair_indices(len(self._courses))
        linked = self._reach.linked(_sampled_m(self._courses, times_ns))
        differs = (linked != self._linked)[:, self._curved[first] | self._curved[second]]
        for at in np.flatnonzero(differs.any(axis=1)).tolist():
            yield int(times_ns[max(at - 1, 0)]), int(times_ns[at])

    def _sight_changes_ns(self, start_ns: int) -> Iterator[tuple[int, int]]:
        """Yield when sight of pairs without an arc comes or goes: (before, at or after)."""
        if not self._reach.is_hindered:
            return
        first, second = pair_indices(len(self._courses))
        after_s, pairs = self._reach.sight_changes_s(
            self._places_m(start_ns), self._velocities_mps, self._linked, _WINDOW_NS * 1e-9
        )
        straight = ~(self._curved[first[pairs]] | self._curved[second[pairs]])
        for after_ns in np.ceil(after_s[straight] * 1e9).tolist():
            time_ns = start_ns + max(int(after_ns), 1)
            yield time_ns - 1, time_ns

    def _crossings_ns(
        self, from_ns: int, places_m: NDArray[np.float64]
    ) -> Iterator[tuple[int, int]]:
        """Yield when pairs without an arc cross the range, ascending: (before, at or after)."""
        first, second = pair_indices(len(self._courses))
        offset = places_m.take(second, axis=0) - places_m.take(first, axis=0)
        speeds_mps = self._velocities_mps
        closing = speeds_mps.take(second, axis=0) - speeds_mps.take(first, axis=0)
        a = (closing * closing).sum(axis=1)
        b = (offset * closing).sum(axis=1)
        c = (offset * offset).sum(axis=1) - self._reach.range_m * self._reach.range_m
        discriminant = b * b - a * c
        leaves = self._linked & (a > 0.0)
        enters = ~self._reach.near(places_m) & (b < 0.0) & (discriminant > 0.0)
        crossing = leaves | enters
        if self._curved.any():
            crossing &= ~(self._curved[first] | self._curved[second])
        root = np.sqrt(np.maximum(discriminant[crossing], 0.0))
        after_s = (np.where(leaves[crossing], root, -root) - b[crossing]) / a[crossing]
        seen = leaves[crossing] | self._seen_after(after_s, places_m, np.flatnonzero(crossing))
        for after_ns in np.sort(np.ceil(after_s[seen & (after_s < _FOREVER_S)] * 1e9)).tolist():
            time_ns = from_ns + max(int(after_ns), 1)
            yield time_ns - 1, time_ns

    def _seen_after(
        self,
        after_s: NDArray[np.float64],
        places_m: NDArray[np.float64],
        pairs: NDArray[np.intp],
    ) -> NDArray[np.bool_]:
        """Tell whether the members of each pair will see each other at its own time."""
        ends_m = (
            places_m[members] + self._velocities_mps[members] * after_s[:, np.newaxis]
            for members in (indices[pairs] for indices in pair_indices(len(self._courses)))
        )
        return self._reach.seen(*ends_m)

    def _first_shown(self, brackets: Iterable[tuple[int, int]]) -> LinkChange | None:
        """Return the first change that the positions as read show; each bracket is tried."""
        for before_ns, after_ns in brackets:
            low_ns, late_ns = before_ns, 0
            while late_ns <= _PATIENCE_NS:
                linked = self._linked_at(after_ns + late_ns)
                if (linked != self._linked).any():
                    return self._narrowed(low_ns, LinkChange(after_ns + late_ns, linked))
                low_ns, late_ns = after_ns + late_ns, max(2 * late_ns, 1)
        return None

    def _narrowed(self, low_ns: int, change: LinkChange) -> LinkChange:
        """Return the first change after ``low_ns``, given one that may be later.

        Only pairs that the later one changes are looked at, by their bodies.
        """
        if change.time_ns - low_ns == 1:
            return change
        first, second = pair_indices(len(self._courses))
        differs = change.linked != self._linked
        pairs = list(zip(first[differs].tolist(), second[differs].tolist(), strict=True))
        linked = self._linked[differs].tolist()
        high_ns = change.time_ns
        while high_ns - low_ns > 1:
            middle_ns = (low_ns + high_ns) // 2
            if [self._is_linked_at(middle_ns, pair) for pair in pairs] == linked:
                low_ns = middle_ns
            else:
                high_ns = middle_ns
        return LinkChange(high_ns, self._linked_at(high_ns))

    def _is_linked_at(self, time_ns: int, pair: tuple[int, int]) -> bool:
        poses = [self._courses[index].pose_at(time_ns) for index in pair]
        places_m = np.array([(pose.x_m, pose.y_m) for pose in poses])
        return bool(self._reach.linked(places_m)[0])

    def _linked_at(self, time_ns: int) -> NDArray[np.bool_]:
        return self._reach.linked(self._places_m(time_ns))

    def _places_m(self, time_ns: int) -> NDArray[np.float64]:
        poses = [course.pose_at(time_ns) for course in self._courses]
        return np.array([(pose.x_m, pose.y_m) for pose in poses])


def _velocity_mps(course: Course) -> tuple[float, float]:
    """Return the velocity along x and y at the anchor; of a straight course, ever."""
    yaw_rad = course.anchor.yaw_rad
    return course.linear_mps * math.cos(yaw_rad), course.linear_mps * math.sin(yaw_rad)


def _sampled_m(courses: Sequence[Course], times_ns: NDArray[np.int64]) -> NDArray[np.float64]:
    """Return all positions at times, float[T, N, 2], up to rounding."""
    anchors = [course.anchor for course in courses]
    anchors_ns = np.array([course.anchor_ns for course in courses])
    return positions(
        np.array([(anchor.x_m, anchor.y_m, anchor.yaw_rad) for anchor in anchors]),
        np.array([course.linear_mps for course in courses]),
        np.array([course.angular_radps for course in courses]),
        (times_ns[:, np.newaxis] - anchors_ns) * 1e-9,
    )
