"""Where an agent is between two odometries.

``DeadReckoning``  the last odometry, driven on
"""

from tlcomm_core.agent.events import OdometryReceived
from tlcomm_core.errors import LocalMisuseError
from tlcomm_core.geometry import Pose
from tlcomm_core.world.unicycle import integrate

__all__ = ["DeadReckoning"]


class DeadReckoning:
    """The last odometry, driven on."""

    def __init__(self) -> None:
        """Know nothing before the first odometry."""
        self._odometry: OdometryReceived | None = None

    def take(self, odometry: OdometryReceived) -> None:
        """Reckon from an odometry on."""
        self._odometry = odometry

    def pose_at(self, now_s: float) -> Pose:
        """Return the pose at a time, not before the last odometry.

        Raises:
            LocalMisuseError: there was no odometry yet.
        """
        odometry = self._odometry
        if odometry is None:
            raise LocalMisuseError("an agent drove before its first odometry")
        return integrate(
            odometry.pose,
            odometry.linear_mps,
            odometry.angular_radps,
            max(0.0, now_s - odometry.stamp_s),
        )
