"""The way that an agent has before it, from stop to stop to its next meeting.

``Corner``  a point of the way
``Way``     the corners that are left
"""

import math
import sys
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import Final

from tlcomm_core.game.offer import MemberOffer
from tlcomm_core.geometry import Pose
from tlcomm_core.units import nanoseconds, seconds
from tlcomm_core.workspace.travel import TravelTimes
from tlcomm_tools.mirror.picture import AgentPicture, Picture

__all__ = ["Corner", "Way"]

_MEETING: Final = sys.maxsize
# In cells: how far an agent may be off its way before another is looked for.
_OFF: Final = 0.5


@dataclass(frozen=True, slots=True)
class Corner:
    """A point of a way.

    Attributes:
        task_index: the step of the plan that it leads to; beyond all steps for the meeting.
        stamp_ns: when that step will be done, or the meeting be reached, as offered and agreed.
        pose: the point, with the heading of the straight that ends there.
    """

    task_index: int
    stamp_ns: int
    pose: Pose


class Way:
    """The corners before an agent. It is searched anew only if what it follows from changes."""

    def __init__(self, name: str) -> None:
        """Begin without any.

        Args:
            name: the agent's.
        """
        self._name: Final = name
        self._follows_from: tuple[object, ...] = ()
        self._corners: Sequence[Corner] = ()
        self._begin = Pose(0.0, 0.0, 0.0)

    def ahead(self, picture: Picture) -> Sequence[Corner]:
        """Return the corners before an agent, in order.

        There are none for an agent that has no agreement, or has arrived; and none beyond a stop
        that no way leads to.

        Cost: one search per stop that no agent with the same motion had before.
        """
        agent = picture.agents[self._name]
        if agent.odometry is None or agent.held is None or agent.is_there:
            return ()
        pose = agent.odometry.pose
        origin = (agent.held, agent.offered, picture.charts.latest_ns)
        if origin != self._follows_from or not self._advance(pose, agent.done_index, picture):
            self._follows_from = origin
            self._begin = pose
            self._corners = tuple(_search(picture, self._name))
        return self._corners

    def _advance(self, pose: Pose, done_index: int, picture: Picture) -> bool:
        """Drop what has been driven; return whether the agent is on the rest."""
        corners = self._corners
        begin = self._begin
        near_m = _OFF * picture.site.grid.cell_m
        for number, corner in enumerate(corners):
            if corner.task_index > done_index and _distance_m(pose, begin, corner.pose) <= near_m:
                self._begin, self._corners = begin, corners[number:]
                return True
            begin = corner.pose
        return not corners


def _distance_m(pose: Pose, begin: Pose, end: Pose) -> float:
    """Return how far a pose is from the straight between two others."""
    along_x_m, along_y_m = end.x_m - begin.x_m, end.y_m - begin.y_m
    square = along_x_m**2 + along_y_m**2
    to_x_m, to_y_m = pose.x_m - begin.x_m, pose.y_m - begin.y_m
    share = (to_x_m * along_x_m + to_y_m * along_y_m) / square if square else 0.0
    share = min(1.0, max(0.0, share))
    return math.hypot(to_x_m - share * along_x_m, to_y_m - share * along_y_m)


def _search(picture: Picture, name: str) -> Iterator[Corner]:
    agent = picture.agents[name]
    assert agent.odometry is not None
    avoided = () if agent.offered is None else agent.offered[1].avoided
    travel = picture.charts.latest.travel(picture.site.motion_of(name), frozenset(avoided))
    pose = agent.odometry.pose
    for stop in _stops(agent, name):
        leg = _drive(travel, pose, stop)
        if leg is None:
            return
        yield from leg
        pose = leg[-1].pose if leg else pose


def _stops(agent: AgentPicture, name: str) -> Iterator[Corner]:
    """Yield where an agent stops, its place of meeting last."""
    strategy = agent.strategy_of(name)
    if strategy is None or agent.held is None:
        return
    if agent.offered is not None and agent.offered[0] == agent.held.strategy.round:
        departed_s = seconds(agent.departed_ns)
        yield from _tasks(
            agent.offered[1], range(agent.done_index + 1, strategy.task_index + 1), departed_s
        )
    place = Pose(strategy.x_m, strategy.y_m, 0.0)
    yield Corner(_MEETING, nanoseconds(strategy.arrival_s), place)


def _tasks(offer: MemberOffer, wanted: range, departed_s: float) -> Iterable[Corner]:
    for stop in offer.stops:
        if stop.task_index in wanted:
            done_ns = nanoseconds(departed_s + stop.finish_offset_s)
            yield Corner(stop.task_index, done_ns, Pose(stop.x_m, stop.y_m, stop.yaw_rad))


def _drive(travel: TravelTimes, pose: Pose, stop: Corner) -> Sequence[Corner] | None:
    """Return the corners from a pose to a stop, or ``None`` if there is no way."""
    here = travel.grid.location_at(pose.x_m, pose.y_m)
    there = travel.grid.location_at(stop.pose.x_m, stop.pose.y_m)
    if here is None or there is None or math.isinf(travel.time_to(there)[here].min()):
        return None
    corners = []
    for x_m, y_m in travel.leg_to(pose, there).waypoints_m:
        pose = Pose(x_m, y_m, math.atan2(y_m - pose.y_m, x_m - pose.x_m))
        corners.append(Corner(stop.task_index, stop.stamp_ns, pose))
    return corners
