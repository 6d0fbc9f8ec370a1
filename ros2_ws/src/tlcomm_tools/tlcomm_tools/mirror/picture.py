"""What is known of a team at one time, from the messages up to then.

``AgentPicture``  of one agent
``Picture``       of the team
"""

from dataclasses import dataclass, field
from typing import Final

from tlcomm_core.agent.actions import TaskEventKind
from tlcomm_core.agent.charts import Charts
from tlcomm_core.game.offer import MemberOffer
from tlcomm_core.game.strategy import Strategy
from tlcomm_core.geometry import wrap_angle
from tlcomm_core.method import Method
from tlcomm_core.records import StrategyRecord, TaskRecord
from tlcomm_core.scenario.model import Scenario
from tlcomm_core.scenario.site import Site
from tlcomm_core.units import nanoseconds
from tlcomm_core.workspace.atlas import Atlas
from tlcomm_core.world.observation import Connectivity, Odometry
from tlcomm_tools.mirror.window_watch import WindowWatch

__all__ = ["AgentPicture", "Picture"]

# A trail keeps a sample that is so far from its last corner, or another heading.
_APART_M: Final = 0.05
_STRAIGHT_RAD: Final = 0.02
_DONE: Final = frozenset({TaskEventKind.ACTION_FINISHED, TaskEventKind.REGION_VISITED})
_NEW_PLAN: Final = frozenset({TaskEventKind.TASK_CHANGED, TaskEventKind.PLAN_CHANGED})


@dataclass(slots=True)
class AgentPicture:
    """What is known of one agent.

    Attributes:
        odometry: its last.
        trail: corners of its path of the last T_c and its last sample, in order of time.
        offered: the last plan that it laid open, and for which round; ``None`` if that plan holds
            no longer.
        held: the last strategy that it holds as agreed.
        done_index: index of the last step of its plan that it has done.
        is_there: whether it has reached the place of the meeting that is next, or under way.
        departed_ns: when it left the last meeting.
        event: its last task event.
        fault: its last fault.
        satisfied: how often its task has been satisfied.
    """

    odometry: Odometry | None = None
    trail: list[Odometry] = field(default_factory=list)
    offered: tuple[int, MemberOffer] | None = None
    held: StrategyRecord | None = None
    done_index: int = -1
    is_there: bool = False
    departed_ns: int = 0
    event: TaskRecord | None = None
    fault: TaskRecord | None = None
    satisfied: int = 0

    def strategy_of(self, agent: str) -> Strategy | None:
        """Return what an agent does by the strategy that this one holds."""
        if self.held is None:
            return None
        own = (one for one in self.held.strategy.strategies if one.agent == agent)
        return next(own, None)

    def take_odometry(self, odometry: Odometry, trail_ns: int) -> None:
        """Take a pose; forget what of the trail is older than ``trail_ns``."""
        self.odometry = odometry
        trail = self.trail
        if len(trail) > 1 and _is_between(trail[-2], trail[-1], odometry):
            trail.pop()
        trail.append(odometry)
        while len(trail) > 1 and trail[1].stamp_ns < odometry.stamp_ns - trail_ns:
            del trail[0]

    def take_event(self, record: TaskRecord) -> None:
        """Take what it did."""
        event = record.event
        self.event = record
        if event.kind in _DONE:
            self.done_index = event.plan_index
        elif event.kind in _NEW_PLAN:
            self.offered, self.done_index = None, -1
        elif event.kind is TaskEventKind.MEETING_REACHED:
            self.is_there = True
        elif event.kind is TaskEventKind.MEETING_ENDED:
            self.is_there, self.departed_ns = False, record.stamp_ns
        elif event.kind is TaskEventKind.TASK_SATISFIED:
            self.satisfied += 1
        elif event.kind is TaskEventKind.FAULT:
            self.fault = record


def _is_between(corner: Odometry, last: Odometry, new: Odometry) -> bool:
    """Return whether a trail needn't have its last sample for the path to be the same."""
    if corner.pose.distance_m(last.pose.x_m, last.pose.y_m) < _APART_M:
        return True
    yaw_rad = last.pose.yaw_rad
    turns_rad = (wrap_angle(own.pose.yaw_rad - yaw_rad) for own in (corner, new))
    return all(abs(turn_rad) < _STRAIGHT_RAD for turn_rad in turns_rad)


class Picture:
    """What is known of a team.

    Attributes:
        site: the scenario and what follows from it.
        method: of coordination.
        agents: each agent's, in the scenario's order.
        connectivity: the last.
        windows: which are kept.
        charts: the maps.
    """

    def __init__(self, scenario: Scenario, method: Method) -> None:
        """Begin with nothing but the scenario."""
        communication = scenario.communication
        self.site: Final = Site.from_scenario(scenario)
        self.method: Final = method
        self.agents: Final = {name: AgentPicture() for name in scenario.agents}
        self.connectivity: Connectivity | None = None
        self.windows: Final = WindowWatch(
            nanoseconds(communication.period_s), nanoseconds(communication.duration_s)
        )
        self.charts: Final = Charts(Atlas(self.site.grid, self.site.region_discs))

    def take_connectivity(self, connectivity: Connectivity) -> None:
        """Take who hears whom."""
        self.connectivity = connectivity
        self.windows.observe(connectivity.stamp_ns, connected=connectivity.connected)

    def take_odometry(self, odometry: Odometry) -> None:
        """Take an agent's pose."""
        self.agents[odometry.agent].take_odometry(odometry, self.windows.period_ns)

    def take_event(self, record: TaskRecord) -> None:
        """Take what an agent did, if it is one of the team."""
        if record.agent in self.agents:
            self.agents[record.agent].take_event(record)
