"""An agent's ways on the map as it is, also from where no move leads.

``Ways``  the shortest legs to what can be reached
"""

import numpy as np

from tlcomm_core.geometry import Pose
from tlcomm_core.workspace.retreat import Retreat
from tlcomm_core.workspace.travel import Leg, TravelTimes

__all__ = ["Ways"]


class Ways:
    """The shortest legs to what can be reached.

    Out of a cell that the task forbids or the map has closed, a leg begins with the way out.
    """

    def __init__(self, travel: TravelTimes) -> None:
        """Begin with travel times on the first map."""
        self.travel = travel
        self._before: TravelTimes | None = None
        self._retreat = Retreat(travel)

    def change(self, travel: TravelTimes, pose: Pose) -> None:
        """Go by another map from now on.

        Args:
            travel: travel times on it.
            pose: where the agent is.
        """
        # What it stands in, an earlier map may have closed.
        if self.travel.grid.location_at(pose.x_m, pose.y_m) is not None:
            self._before = self.travel
        self.travel = travel
        self._retreat = Retreat(travel, self._before)

    def lead(self, pose: Pose, place: int) -> bool:
        """Return whether a location can be reached, which −1 can't."""
        if place < 0 or self.travel.grid.leads(pose.x_m, pose.y_m, place):
            return place >= 0
        return self._retreat.leg(pose, place) is not None

    def nearest(self, pose: Pose, x_m: float, y_m: float) -> int | None:
        """Return the location nearest to a point that can be reached; ``None`` if none can be.

        Ties go to the lowest location.
        """
        reached = self._retreat.reached(pose)
        if not reached.any():
            return None
        offsets_m = self.travel.grid.locations_m - (x_m, y_m)
        return int(np.argmin(np.where(reached, np.hypot(*offsets_m.T), np.inf)))

    def leg_to(self, pose: Pose, place: int) -> Leg:
        """Return the shortest leg along the tree of paths into a location that can be reached."""
        out = self._retreat.leg(pose, place)
        if out is None:
            return self.travel.leg_to(pose, place)
        return _joined(out, self.travel.leg_to(out.arrival, place))

    def leg_from(self, pose: Pose, place: int) -> Leg:
        """Return the shortest leg along the tree of paths out of the pose, as ``leg_to``."""
        out = self._retreat.leg(pose, place)
        if out is None:
            return self.travel.leg_from(pose, place)
        return _joined(out, self.travel.leg_from(out.arrival, place))


def _joined(leg: Leg, onward: Leg) -> Leg:
    """Return a leg and the one that begins where it arrives as one."""
    return Leg(
        waypoints_m=leg.waypoints_m + onward.waypoints_m,
        duration_s=leg.duration_s + onward.duration_s,
        distance_m=leg.distance_m + onward.distance_m,
        arrival=onward.arrival,
    )
