"""An agent's way, thinned as it grows.

``Way``  the way
"""

import math
from typing import Final

from tlcomm_core.world.observation import Odometry
from tlcomm_tools.figures import reduction
from tlcomm_tools.live.growing import Growing

__all__ = ["Way"]

# So many samples are thinned together; then what is left of them stays.
_MOST_LOOSE: Final = 256


class Way:
    """An agent's way, thinned as it grows: the same as of a whole run, but for a few corners more.

    Attributes:
        corners: (s, m, m), straight in between.
        length_m: of the way.
    """

    def __init__(self, corners: Growing) -> None:
        """Begin nowhere."""
        self.corners: Final = corners
        self.length_m = 0.0
        self._loose: list[Odometry] = []
        self._settled = 0
        self._is_drawn = True

    def take(self, seen: Odometry) -> None:
        """Take a sample; one that is older than the last, or nowhere, isn't part of the way."""
        pose = seen.pose
        if not (math.isfinite(pose.x_m) and math.isfinite(pose.y_m)):
            return
        if self._loose:
            last = self._loose[-1]
            if seen.stamp_ns < last.stamp_ns:
                return
            self.length_m += last.pose.distance_m(pose.x_m, pose.y_m)
        self._loose.append(seen)
        self._is_drawn = False

    def draw(self) -> None:
        """Bring the corners up to date."""
        if self._is_drawn:
            return
        drawn = reduction.path(self._loose)
        rows = list(zip(drawn.times_s, drawn.x_m, drawn.y_m, strict=True))
        self.corners.replace(self._settled, rows)
        if len(self._loose) > _MOST_LOOSE:
            self._settled += len(rows) - 1
            del self._loose[:-1]
        self._is_drawn = True
