"""Where a moving point meets an obstacle or the workspace's border.

``Obstacles``  the closed boxes of a workspace, and the contact of a course with them
"""

import math
from typing import Final

import numpy as np
from numpy.typing import NDArray

from tlcomm_core.geometry import Pose
from tlcomm_core.workspace.grid import Grid
from tlcomm_core.world.course import Course
from tlcomm_core.world.unicycle import positions

__all__ = ["Obstacles"]

# Far above the rounding of coordinates, far below anything that matters.
_SKIN_M: Final = 1e-9
_SAMPLE_NS: Final = 10_000_000
_FOREVER_S: Final = 1e9


class Obstacles:
    """The boxes that a point can't enter, and the outside of the workspace.

    A point *collides* when its way leads deeper than a nanometre into a box; it is stopped a
    nanometre before. So one that stands at a wall, or drives along one, may go on or turn away.
    """

    def __init__(self, grid: Grid) -> None:
        """Take the obstacles as given, not the cells that they close; the border is four more."""
        (left, bottom), (width, height) = grid.origin_m, grid.size_m
        outside = (
            (-np.inf, -np.inf, left, np.inf),
            (left + width, -np.inf, np.inf, np.inf),
            (-np.inf, -np.inf, np.inf, bottom),
            (-np.inf, bottom + height, np.inf, np.inf),
        )
        boxes = np.concatenate((grid.boxes, outside))
        low, high = boxes[:, :2], boxes[:, 2:]
        self._count = len(boxes)
        self._low = np.concatenate((low + _SKIN_M, low - _SKIN_M))
        self._high = np.concatenate((high - _SKIN_M, high + _SKIN_M))

    def contain(self, x_m: float, y_m: float) -> bool:
        """Tell whether a point is inside a box or outside the workspace; borders don't count."""
        return bool(self._inside(np.array((x_m, y_m)), np.arange(self._count)).any())

    def touch(self, x_m: float, y_m: float) -> bool:
        """Tell whether a point is inside a box, or no more than a nanometre outside."""
        near = np.arange(self._count, 2 * self._count)
        return bool(self._inside(np.array((x_m, y_m)), near).any())

    def contact_ns(self, course: Course, from_ns: int, until_ns: int) -> int | None:
        """Return when the course must stop for not entering a box.

        Args:
            course: what moves.
            from_ns: where to begin to look.
            until_ns: how far as an arc is followed; a line is followed to its end.

        Returns:
            The last time before the contact, ``from_ns`` at the earliest; None if there is none.

        Deviates:
            An arc is sampled every 10 ms: it may cut a corner that it is in for a shorter time.
        """
        if course.linear_mps == 0.0:
            return None
        if course.angular_radps == 0.0:
            return self._straight_contact_ns(course, from_ns)
        return self._arc_contact_ns(course, from_ns, until_ns)

    def _straight_contact_ns(self, course: Course, from_ns: int) -> int | None:
        pose = course.pose_at(from_ns)
        start = np.array((pose.x_m, pose.y_m))
        velocity = course.linear_mps * np.array((math.cos(pose.yaw_rad), math.sin(pose.yaw_rad)))
        # Beside a wall that it drives along: 0 / 0, and NaN compares as no contact.
        with np.errstate(divide="ignore", invalid="ignore"):
            to_low_s = (self._low - start) / velocity
            to_high_s = (self._high - start) / velocity
        enter_s = np.minimum(to_low_s, to_high_s).max(axis=1)
        leave_s = np.maximum(to_low_s, to_high_s).min(axis=1)
        deep, near = slice(self._count), slice(self._count, None)
        hit = (enter_s[deep] < leave_s[deep]) & (leave_s[deep] > 0.0)
        contact_s = enter_s[near][hit].min(initial=np.inf)
        return from_ns + int(max(contact_s, 0.0) * 1e9) if contact_s < _FOREVER_S else None

    def _arc_contact_ns(self, course: Course, from_ns: int, until_ns: int) -> int | None:
        steps = -(-(until_ns - from_ns) // _SAMPLE_NS)
        times_ns = np.minimum(from_ns + _SAMPLE_NS * np.arange(steps + 1), until_ns)
        reachable = self._reachable(course, from_ns, until_ns)
        inside = self._inside(_places_m(course, times_ns), reachable)
        samples, columns = np.nonzero(inside)
        if not len(samples):
            return None
        first = int(samples[0])
        low_ns, high_ns = int(times_ns[max(first - 1, 0)]), int(times_ns[first])
        entered = reachable[columns[samples == first]].tolist()
        return min(self._entry_ns(course, self._count + box, low_ns, high_ns) for box in entered)

    def _entry_ns(self, course: Course, box: int, low_ns: int, high_ns: int) -> int:
        """Return the last time before a box is entered, or ``low_ns`` if it was already."""
        while high_ns - low_ns > 1:
            middle_ns = (low_ns + high_ns) // 2
            if self._holds(box, course.pose_at(middle_ns)):
                high_ns = middle_ns
            else:
                low_ns = middle_ns
        return low_ns

    def _reachable(self, course: Course, from_ns: int, until_ns: int) -> NDArray[np.intp]:
        """Return the boxes that the course is close enough to for entering in time."""
        pose = course.pose_at(from_ns)
        place_m = np.array((pose.x_m, pose.y_m))
        reach_m = abs(course.linear_mps) * (until_ns - from_ns) * 1e-9
        low, high = self._low[: self._count], self._high[: self._count]
        return np.flatnonzero(((low < place_m + reach_m) & (place_m - reach_m < high)).all(axis=1))

    def _inside(self, places_m: NDArray[np.float64], boxes: NDArray[np.intp]) -> NDArray[np.bool_]:
        """Tell for points float[..., 2] which of the boxes they are inside of: bool[..., B]."""
        places_m = places_m[..., np.newaxis, :]
        inside = (self._low[boxes] < places_m) & (places_m < self._high[boxes])
        all_inside: NDArray[np.bool_] = inside.all(axis=-1)
        return all_inside

    def _holds(self, box: int, pose: Pose) -> bool:
        x_min, y_min = self._low[box].tolist()
        x_max, y_max = self._high[box].tolist()
        return bool(x_min < pose.x_m < x_max and y_min < pose.y_m < y_max)


def _places_m(course: Course, times_ns: NDArray[np.int64]) -> NDArray[np.float64]:
    """Return the course's positions at times, float[T, 2]."""
    anchor = course.anchor
    return positions(
        np.array(((anchor.x_m, anchor.y_m, anchor.yaw_rad),)),
        np.array((course.linear_mps,)),
        np.array((course.angular_radps,)),
        (times_ns - course.anchor_ns)[:, np.newaxis] * 1e-9,
    )[:, 0]
