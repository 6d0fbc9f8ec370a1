"""How one body moves between two velocity changes.

``Course``  an anchor pose and a constant velocity, read at any time
"""

from dataclasses import dataclass

from tlcomm_core.geometry import Pose
from tlcomm_core.world.unicycle import integrate

__all__ = ["Course"]


@dataclass(frozen=True, slots=True)
class Course:
    """Constant velocity from an anchor on.

    Every pose is computed from the anchor, never from another reading, so that reading more often
    changes no bit.
    """

    anchor_ns: int
    anchor: Pose
    linear_mps: float = 0.0
    angular_radps: float = 0.0

    @property
    def moving(self) -> bool:
        """Whether the pose changes at all."""
        return self.linear_mps != 0.0 or self.angular_radps != 0.0

    @property
    def curved(self) -> bool:
        """Whether the position moves along a circle instead of a line or not at all."""
        return self.linear_mps != 0.0 and self.angular_radps != 0.0

    def pose_at(self, time_ns: int) -> Pose:
        """Return the pose at a time."""
        if not self.moving:
            return self.anchor
        duration_s = (time_ns - self.anchor_ns) * 1e-9
        return integrate(self.anchor, self.linear_mps, self.angular_radps, duration_s)
