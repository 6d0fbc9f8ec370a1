"""Driving a leg by turning on the spot and driving straight.

``Pacing``    how often the controller is asked
``Follower``  the velocity commands that follow a leg's waypoints
"""

import math
from dataclasses import dataclass
from enum import Enum
from typing import Final

from tlcomm_core.agent.actions import Drive
from tlcomm_core.geometry import Pose, wrap_angle
from tlcomm_core.workspace.travel import Leg

__all__ = ["CONTROL_PERIOD_S", "LONGEST_STEP_S", "Follower", "Pacing"]

CONTROL_PERIOD_S: Final = 0.05
"""Time between control steps in free running, 20 Hz."""

LONGEST_STEP_S: Final = 0.5
"""The most time between control steps in lock step while driving."""

# When moves end exactly with the control steps, waypoints are met and headings held to within
# this: far above rounding, and far below anything that a prediction could notice.
_EXACT_M: Final = 1e-6

# Otherwise to within this share of the position tolerance: the rest of it covers what odometry
# and timers are off by.
_SHARE: Final = 0.25


class Pacing(Enum):
    """How often the controller is asked."""

    EVENT = "event"
    """At the end of each turn or straight, and at the multiples of ``LONGEST_STEP_S``."""
    PERIODIC = "periodic"
    """Every ``CONTROL_PERIOD_S``."""


@dataclass(frozen=True, slots=True)
class _Move:
    """A turn or a straight at full speed; its sign, and how long it takes."""

    linear_mps: float
    angular_radps: float
    duration_s: float


class Follower:
    """Follows a leg, from wherever the agent is when it is asked."""

    def __init__(
        self,
        leg: Leg,
        start: Pose,
        linear_mps: float,
        angular_radps: float,
        position_tolerance_m: float,
        pacing: Pacing,
    ) -> None:
        """Follow ``leg`` from ``start`` at the given speeds to within the tolerance."""
        self._waypoints = list(leg.waypoints_m)
        self._passed_m = (start.x_m, start.y_m)
        self._linear_mps = linear_mps
        self._angular_radps = angular_radps
        self._tolerance_m = position_tolerance_m
        self._precision_m = _EXACT_M if pacing is Pacing.EVENT else _SHARE * position_tolerance_m
        self._pacing = pacing
        self._is_approaching = False

    @property
    def ahead_m(self) -> tuple[tuple[float, float], ...]:
        """The waypoints that are left."""
        return tuple(self._waypoints)

    def deviation_m(self, pose: Pose) -> float:
        """Return how far a pose is from the straight that is being driven."""
        (x_m, y_m), *_ = self._waypoints or [self._passed_m]
        from_x_m, from_y_m = self._passed_m
        length_m = math.dist(self._passed_m, (x_m, y_m))
        if length_m == 0.0:
            return pose.distance_m(x_m, y_m)
        along_x, along_y = (x_m - from_x_m) / length_m, (y_m - from_y_m) / length_m
        way_m = (pose.x_m - from_x_m) * along_x + (pose.y_m - from_y_m) * along_y
        way_m = min(max(way_m, 0.0), length_m)
        return pose.distance_m(from_x_m + way_m * along_x, from_y_m + way_m * along_y)

    def control(self, pose: Pose, now_s: float) -> tuple[Drive, float] | None:
        """Return the velocity from now on, and when to ask again; ``None`` at the leg's end.

        With event pacing, a move ends exactly when the next step comes. Periodic steps come when
        they come: the last one of a move is slowed down to last a whole period, and asking again
        is welcome at once.
        """
        move = self._next_move(pose)
        if move is None:
            return None
        if self._pacing is Pacing.EVENT:
            grid_s = (math.floor(now_s / LONGEST_STEP_S + 1e-6) + 1) * LONGEST_STEP_S
            until_s = min(now_s + move.duration_s, grid_s)
            return Drive(move.linear_mps, move.angular_radps), until_s
        share = min(1.0, move.duration_s / CONTROL_PERIOD_S)
        return Drive(share * move.linear_mps, share * move.angular_radps), now_s

    def _next_move(self, pose: Pose) -> _Move | None:
        while self._waypoints:
            x_m, y_m = self._waypoints[0]
            distance_m = pose.distance_m(x_m, y_m)
            error_rad = wrap_angle(math.atan2(y_m - pose.y_m, x_m - pose.x_m) - pose.yaw_rad)
            is_behind = abs(error_rad) >= math.pi / 2.0
            if distance_m <= self._precision_m or (is_behind and distance_m <= self._tolerance_m):
                self._passed_m = self._waypoints.pop(0)
                self._is_approaching = False
                continue
            linear_mps = self._linear_mps
            if is_behind and self._is_approaching:
                # It was overshot: going back a little takes less time than turning round twice.
                linear_mps, is_behind = -linear_mps, False
                error_rad = wrap_angle(error_rad + math.pi)
            if is_behind or distance_m * math.sin(abs(error_rad)) > self._precision_m:
                rate_radps = math.copysign(self._angular_radps, error_rad)
                return _Move(0.0, rate_radps, abs(error_rad) / self._angular_radps)
            self._is_approaching = True
            return _Move(linear_mps, 0.0, distance_m / self._linear_mps)
        return None
