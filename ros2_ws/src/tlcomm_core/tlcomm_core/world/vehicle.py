"""One simulated body: what moves it, what stops it, what it reports.

``Body``     name, start and limits, as given
``Vehicle``  the body over time
"""

import math
from dataclasses import dataclass
from typing import Final

from tlcomm_core.errors import LocalMisuseError
from tlcomm_core.geometry import Pose
from tlcomm_core.world.collision import Obstacles
from tlcomm_core.world.course import Course
from tlcomm_core.world.observation import Odometry

__all__ = ["Body", "Vehicle"]

_MOVING_HEARTBEAT_NS: Final = 500_000_000
_RESTING_HEARTBEAT_NS: Final = 1_000_000_000
# Nearer than this is contact already, also for a body that was stopped a nanosecond early.
_TOUCH_M: Final = 1e-8
# A body that has driven no more than this since its last contact makes no new one.
_SAME_CONTACT_M: Final = 1e-6


@dataclass(frozen=True, slots=True)
class Body:
    """An agent's body.

    Attributes:
        name: the agent.
        start: pose at t = 0.
        linear_mps: the most |v| that it can drive.
        angular_radps: the most |ω| that it can turn.
    """

    name: str
    start: Pose
    linear_mps: float
    angular_radps: float


class Vehicle:
    """A simulated body.

    Its course is anchored anew when the velocity changes and only then, so readings in between
    change nothing. Whoever integrates from any odometry with its velocity has the world's pose to
    rounding.

    Attributes:
        name: the agent.
        course: as it is now.
        collisions: how many times it ran into something; pushing on doesn't count again.
    """

    def __init__(self, body: Body, obstacles: Obstacles) -> None:
        """Put the body at rest at its start."""
        if obstacles.contain(body.start.x_m, body.start.y_m):
            raise LocalMisuseError(
                f"{body.name!r} starts inside an obstacle or outside the workspace: {body.start!r}"
            )
        self.name: Final = body.name
        self.course = Course(0, body.start)
        self.collisions = 0
        self._obstacles = obstacles
        self._coming: Obstacles | None = None
        self._heartbeat_ns = 0
        self._contact_ns: int | None = None
        self._since_contact_m = math.inf

    @property
    def due_ns(self) -> int:
        """When it has something to report next: a stop or a heartbeat."""
        if self._contact_ns is None:
            return self._heartbeat_ns
        return min(self._contact_ns, self._heartbeat_ns)

    def drive(self, now_ns: int, linear_mps: float, angular_radps: float) -> bool:
        """Set the velocity, or stop if that leads into an obstacle at once.

        Returns:
            Whether the velocity has changed.
        """
        if self._has_velocity(linear_mps, angular_radps):
            return False
        self._settle(now_ns)
        course = self._course_from(now_ns, linear_mps, angular_radps)
        contact_ns = self._obstacles.contact_ns(course, now_ns, now_ns + _MOVING_HEARTBEAT_NS)
        if contact_ns is not None and _way_m(course, contact_ns) < _TOUCH_M:
            changed = self.course.moving
            self._stop(now_ns)
            return changed
        self._adopt(course, contact_ns)
        return True

    def surround(self, obstacles: Obstacles, now_ns: int) -> None:
        """Put other obstacles round the body.

        One in whose place an obstacle appears isn't held by it: only what was there before stops
        it, until a new command or its odometry's time finds it outside all that is there now.
        """
        self._coming = obstacles
        pose = self.course.pose_at(now_ns)
        if not obstacles.contain(pose.x_m, pose.y_m):
            self._heed(obstacles, now_ns)

    def advance_to(self, now_ns: int) -> bool:
        """Stop if contact is made now.

        Returns:
            Whether the velocity has changed.
        """
        if self._contact_ns == now_ns:
            self._stop(now_ns)
            return True
        return False

    def odometry(self, now_ns: int) -> Odometry:
        """Return pose and velocity; changes nothing."""
        course = self.course
        pose = course.pose_at(now_ns).as_transmitted()
        return Odometry(now_ns, self.name, pose, course.linear_mps, course.angular_radps)

    def report(self, now_ns: int) -> Odometry:
        """Return the odometry that goes out now, and set the time of the next one."""
        period_ns = _MOVING_HEARTBEAT_NS if self.course.moving else _RESTING_HEARTBEAT_NS
        self._heartbeat_ns = now_ns + period_ns
        self._settle(now_ns)
        if self.course.curved and self.course.anchor_ns < now_ns:
            until_ns = self._heartbeat_ns
            self._contact_ns = self._obstacles.contact_ns(self.course, now_ns, until_ns)
        return self.odometry(now_ns)

    def _settle(self, now_ns: int) -> None:
        """Heed the obstacles that have come round the body, once it touches none of them."""
        pose = self.course.pose_at(now_ns)
        # Where two of them meet it is inside neither.
        if self._coming is not None and not self._coming.touch(pose.x_m, pose.y_m):
            self._heed(self._coming, now_ns)

    def _heed(self, obstacles: Obstacles, now_ns: int) -> None:
        self._obstacles, self._coming = obstacles, None
        until_ns = max(self._heartbeat_ns, now_ns)
        self._contact_ns = obstacles.contact_ns(self.course, now_ns, until_ns)

    def _stop(self, now_ns: int) -> None:
        if self.course.moving:
            self._adopt(self._course_from(now_ns, 0.0, 0.0), None)
        if self._since_contact_m > _SAME_CONTACT_M:
            self.collisions += 1
        self._since_contact_m = 0.0

    def _has_velocity(self, linear_mps: float, angular_radps: float) -> bool:
        course = self.course
        return course.linear_mps == linear_mps and course.angular_radps == angular_radps

    def _course_from(self, now_ns: int, linear_mps: float, angular_radps: float) -> Course:
        return Course(now_ns, self.course.pose_at(now_ns), linear_mps, angular_radps)

    def _adopt(self, course: Course, contact_ns: int | None) -> None:
        self._since_contact_m += _way_m(self.course, course.anchor_ns)
        self.course = course
        self._contact_ns = contact_ns


def _way_m(course: Course, until_ns: int) -> float:
    """Return the length of the way from the anchor on."""
    return abs(course.linear_mps) * (until_ns - course.anchor_ns) * 1e-9
