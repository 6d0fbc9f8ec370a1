"""What an agent does between two meetings: steps of its plan, then the way to the next meeting.

``Itinerary``  the plan, how far it is done, and when to leave it for the meeting

As agreed, an agent goes to meet after its step h. An action that fails is begun anew at once, and
takes time that nobody reckoned with. From then on each step, and each further attempt, is begun
only if it can be finished and the place still reached by t_c. So an agent leaves for the meeting
after fewer steps rather than late; what is left comes after the meeting, from the step that failed.

This never comes too late: from where an attempt has just failed, the way straight to the meeting
is no longer than the rest of what had fitted in, which leads there too.

The agreed h counts the plan's steps, and others reckon with them. So another plan begins at the
next meeting, with what the agent offers there.
"""

from typing import Final

from tlcomm_core.agent.events import TaskChanged
from tlcomm_core.errors import LocalMisuseError
from tlcomm_core.game.offer import PlannedStop, next_stops
from tlcomm_core.game.strategy import Strategy
from tlcomm_core.geometry import Pose
from tlcomm_core.planning.plan import LocalPlan, PlanStep
from tlcomm_core.workspace.retreat import Retreat
from tlcomm_core.workspace.travel import Leg, TravelTimes

__all__ = ["Itinerary"]

# What sums of times may be off by, each rounded to nanoseconds.
_ROUNDING_S: Final = 1e-6


class Itinerary:
    """The plan, how far it is done, and when to leave it for the meeting.

    Attributes:
        done: index of the last step done; −1 before the first.
    """

    def __init__(self, plan: LocalPlan, travel: TravelTimes, retries: int) -> None:
        """Begin with the plan's first step.

        Args:
            plan: what to do.
            travel: travel times with the agent's own motion.
            retries: how often a failed action is begun anew before the next meeting.
        """
        self.done = -1
        self._plan = plan
        self._travel: Final = travel
        self._retreat: Final = Retreat(travel)
        self._retries: Final = retries
        self._meeting: Strategy | None = None
        self._meeting_s = 0.0
        self._failures = 0
        self._is_delayed = False
        self._change: TaskChanged | None = None

    @property
    def step(self) -> PlanStep:
        """The step to do next, or under way."""
        return self._plan.step(self.done + 1)

    def agree(self, meeting: Strategy, meeting_s: float) -> None:
        """Take the agent's own part in what the team has agreed on.

        Args:
            meeting: where to be, and after which step.
            meeting_s: t_c, when the team is to be there.
        """
        self._meeting = meeting
        self._meeting_s = meeting_s
        self._failures = 0
        self._is_delayed = False

    def change(self, change: TaskChanged) -> None:
        """Note another plan; it begins at the next meeting, unless yet another comes before."""
        self._change = change

    def reach_meeting(self) -> TaskChanged | None:
        """Begin the other plan, if there is one; return what has changed."""
        change, self._change = self._change, None
        if change is not None:
            self._plan = change.plan
            self.done = -1
        return change

    def meeting_pose(self, pose: Pose) -> Pose:
        """Return where the agent will be at the meeting if nothing fails.

        Args:
            pose: where the agent has set out from.
        """
        meeting = self._agreed()
        pose, _ = self._let_out(pose)
        for index in range(self.done + 1, meeting.task_index + 1):
            pose = self._travel.leg_to(pose, self._plan.step(index).location).arrival
        return self.leg(pose, meeting).arrival

    def finish_step(self) -> None:
        """Note that the step has been done."""
        self.done += 1
        self._failures = 0

    def fail_step(self) -> int:
        """Note that the step's action has failed; return how often it has since the meeting."""
        self._failures += 1
        self.delay()
        return self._failures

    def delay(self) -> None:
        """Note that time was lost: from now on until the meeting, time decides on each step."""
        self._is_delayed = True

    def can_go_on(self, pose: Pose) -> bool:
        """Return whether a way leads from a pose to what is planned."""
        grid = self._travel.grid
        pose, _ = self._let_out(pose)
        here = grid.location_at(pose.x_m, pose.y_m)
        return here is not None and grid.components[here] == grid.components[self.step.location]

    def next_meeting(self, pose: Pose, now_s: float) -> Strategy | None:
        """Return the meeting if it is time to go there; ``None`` if a step comes first.

        Args:
            pose: where the agent is to set out from.
            now_s: the time.
        """
        meeting = self._agreed()
        if self.done >= meeting.task_index:
            return meeting
        if not self._is_delayed:
            return None
        is_possible = self._failures <= self._retries and self._has_time(pose, now_s)
        return None if is_possible else meeting

    def leg(self, pose: Pose, meeting: Strategy | None) -> Leg:
        """Return the way to a meeting or, with ``None``, to the next step.

        It begins with the way out of what the task forbids, if something has put the agent there.
        """
        pose, retreat = self._let_out(pose)
        if meeting is None:
            onward = self._travel.leg_to(pose, self.step.location)
        else:
            onward = self._travel.leg_from(pose, self._place(meeting))
        return onward if retreat is None else _joined(retreat, onward)

    def next_stops(self, pose: Pose, horizon_s: float) -> tuple[PlannedStop, ...]:
        """Return the next steps with the times and poses at which they are finished.

        Args:
            pose: where the agent stands at the present meeting.
            horizon_s: time from the departure to the end of the window to plan.
        """
        return next_stops(self._plan, self.done + 1, pose, self._travel, horizon_s)

    def _let_out(self, pose: Pose) -> tuple[Pose, Leg | None]:
        """Return where the plan goes on from, and the way out that leads there, if it takes one."""
        retreat = self._retreat.leg(pose, self.step.location)
        return (pose, None) if retreat is None else (retreat.arrival, retreat)

    def _has_time(self, pose: Pose, now_s: float) -> bool:
        """Return whether the next step can be done before the meeting."""
        there = self.leg(pose, None)
        onward = self.leg(there.arrival, self._agreed())
        needed_s = there.duration_s + self.step.duration_s + onward.duration_s
        return now_s + needed_s <= self._meeting_s + _ROUNDING_S

    def _agreed(self) -> Strategy:
        if self._meeting is None:
            raise LocalMisuseError("an agent set out before any meeting was agreed")
        return self._meeting

    def _place(self, meeting: Strategy) -> int:
        place = self._travel.grid.location_at(meeting.x_m, meeting.y_m)
        if place is None:
            raise LocalMisuseError(f"the agreed place of {meeting!r} isn't free")
        return place


def _joined(leg: Leg, onward: Leg) -> Leg:
    """Return a leg and the one that begins where it arrives as one."""
    return Leg(
        waypoints_m=leg.waypoints_m + onward.waypoints_m,
        duration_s=leg.duration_s + onward.duration_s,
        distance_m=leg.distance_m + onward.distance_m,
        arrival=onward.arrival,
    )
