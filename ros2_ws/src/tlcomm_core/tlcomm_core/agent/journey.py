"""What an agent does between two meetings, as a course of drives and actions.

``Journey``  drives to the plan's steps, acts there, and drives to the meeting when it is time to

Driving    to the next step of the plan, or to the next place of meeting; anew, from where the agent
           is, when something has put it off its way, be it into what its task forbids, or when the
           map has closed that.
Acting     at a step's region, until the step is done, or begun anew since its action failed.

Which comes next is the itinerary's business.
"""

import math
from typing import Final

from tlcomm_core.agent.actions import Action, Drive, Fault, ReportTask, TaskEvent, TaskEventKind
from tlcomm_core.agent.activities import Acting, Driving
from tlcomm_core.agent.controller import Follower
from tlcomm_core.agent.events import MapChanged, OdometryReceived
from tlcomm_core.agent.itinerary import Itinerary
from tlcomm_core.agent.reckoning import DeadReckoning
from tlcomm_core.agent.settings import Settings
from tlcomm_core.errors import PlanningError
from tlcomm_core.game.strategy import Strategy
from tlcomm_core.geometry import Pose, wrap_angle
from tlcomm_core.planning.plan import PlanStep
from tlcomm_core.units import is_due
from tlcomm_core.workspace.travel import TravelTimes

__all__ = ["Journey"]

# An agent that ends a leg as near as its tolerance and no further turned than this takes itself
# to be where the leg was to end: what it is off by is the controller's business.
_YAW_TOLERANCE_RAD: Final = 0.1


class Journey:
    """One agent's drives and actions, from setting out to the arrival at a meeting.

    Attributes:
        itinerary: the plan, and when to leave it for the meeting.
        pose: where the agent stands, or has set out from.
    """

    def __init__(self, settings: Settings) -> None:
        """Be nowhere yet."""
        self.itinerary: Final = Itinerary(settings.plan, settings.travel, settings.retries)
        self.pose = Pose(0.0, 0.0, 0.0)
        self._settings: Final = settings
        self._reckoning: Final = DeadReckoning()
        self._activity: Driving | Acting | None = None
        self._round = 0
        self._arrived: Strategy | None = None

    @property
    def is_under_way(self) -> bool:
        """Whether it is driving or acting; without a meeting ahead it may find no way on."""
        return self._activity is not None

    @property
    def travel(self) -> TravelTimes:
        """Travel times on the latest map that it was told of."""
        return self.itinerary.travel

    @property
    def next_need_s(self) -> float:
        """When it must go on, whatever happens until then; inf if it isn't under way."""
        match self._activity:
            case None:
                return math.inf
            case Driving(control_s=control_s):
                return control_s
            case Acting(until_s=until_s):
                return until_s

    def locate(self, odometry: OdometryReceived) -> None:
        """Take an odometry, and see whether something has put the agent off its way."""
        self._reckoning.take(odometry)
        if isinstance(self._activity, Driving):
            self._watch(self._activity, odometry.pose)

    def see_map(self, change: MapChanged, now_s: float) -> None:
        """Go by another map: at once if it closes the way under way, else with the next leg."""
        driving = self._activity if isinstance(self._activity, Driving) else None
        pose = self.pose if driving is None else self._reckoning.pose_at(now_s)
        self.itinerary.change_map(change.travel, pose)
        if driving is not None:
            ahead_m = [(pose.x_m, pose.y_m), *driving.follower.ahead_m]
            is_open = self.itinerary.still_leads(driving.leg, ahead_m, driving.meeting)
            driving.is_closed = not is_open

    def set_out(self, now_s: float, round_: int) -> list[Action]:
        """Go to the next step or, when it is time to, to the meeting of a round."""
        self._round = round_
        return self._set_out(now_s)

    def redirect(self, now_s: float) -> list[Action]:
        """Stop where it is, and set out from there as the itinerary now says."""
        return [Drive(0.0, 0.0), *self._set_out_anew(self._reckoning.pose_at(now_s), now_s)]

    def proceed(self, now_s: float) -> list[Action]:
        """Do whatever is due; one activity may end and the next begin at one instant."""
        actions: list[Action] = []
        while True:
            activity = self._activity
            match activity:
                case None:
                    return actions
                case Driving():
                    actions += self._drive(activity, now_s)
                case Acting():
                    actions += self._act(activity, now_s)
            if self._activity is activity:
                return actions

    def reach_meeting(
        self, round_: int, now_s: float, expected: Strategy | None = None
    ) -> list[Action]:
        """Report the arrival at a meeting; take on another task or plan from here on, if need be.

        Args:
            round_: the meeting's.
            now_s: the time.
            expected: when, if that was foreseen.
        """
        itinerary, self._round = self.itinerary, round_
        detail = "" if expected is None else _foreseen(expected.arrival_s, now_s)
        actions: list[Action] = [self.report(TaskEventKind.MEETING_REACHED, round_, detail=detail)]
        if (change := itinerary.reach_meeting()) is not None:
            detail = f"task={change.task}"
            actions.append(self.report(TaskEventKind.TASK_CHANGED, round_, detail=detail))
        if itinerary.is_blocked(self.pose):
            actions.append(self._plan_anew())
        return actions

    def take_arrival(self) -> Strategy | None:
        """Return, once, the meeting that the agent has come to; ``None`` if it hasn't."""
        arrived, self._arrived = self._arrived, None
        return arrived

    def report_fault(self, fault: Fault, what: str) -> ReportTask:
        """Return the report of what the agent copes with."""
        return self.report(TaskEventKind.FAULT, self._round, detail=f"{fault}={what}")

    def report_meeting(self, told: tuple[TaskEventKind, int, str]) -> ReportTask:
        """Return the report of what happens at a meeting: kind, round and detail."""
        kind, round_, detail = told
        return self.report(kind, round_, detail=detail)

    def report(
        self,
        kind: TaskEventKind,
        round_: int,
        step: PlanStep | None = None,
        plan_index: int | None = None,
        detail: str = "",
    ) -> ReportTask:
        """Return the report of what the agent does."""
        return ReportTask(
            TaskEvent(
                kind=kind,
                region="" if step is None else step.region,
                action="" if step is None or step.action is None else step.action,
                round=round_,
                plan_index=max(0, self.itinerary.done) if plan_index is None else plan_index,
                detail=detail,
            )
        )

    def _plan_anew(self) -> Action:
        """Take on another plan for the same task, if there is one on the map as it is."""
        itinerary = self.itinerary
        try:
            plan = self._settings.planner(itinerary.task, self.pose, itinerary.travel)
        except PlanningError as error:
            return self.report_fault(Fault.BLOCKED, str(error))
        itinerary.plan_anew(plan)
        return self.report(TaskEventKind.PLAN_CHANGED, self._round)

    def _set_out(self, now_s: float) -> list[Action]:
        settings = self._settings
        meeting = self.itinerary.next_meeting(self.pose, now_s)
        if meeting is None and not self.itinerary.can_go_on(self.pose):
            self._activity = None
            return []
        leg = self.itinerary.leg(self.pose, meeting)
        follower = Follower(
            leg,
            self.pose,
            settings.travel.motion.linear_mps,
            settings.travel.motion.angular_radps,
            settings.position_tolerance_m,
            settings.pacing,
        )
        begins_s, ends_s = self.itinerary.hours(leg)
        self._activity = Driving(leg, follower, meeting, max(now_s, begins_s), ends_s)
        if meeting is None or not self.itinerary.is_cut_off(self.pose):
            return []
        apart_m = leg.arrival.distance_m(meeting.x_m, meeting.y_m)
        return [self.report_fault(Fault.CUT_OFF, f"{apart_m:.3f}")]

    def _drive(self, driving: Driving, now_s: float) -> list[Action]:
        pose = self._reckoning.pose_at(now_s)
        if driving.displaced_m is not None:
            return self._recover(driving.displaced_m, pose, now_s)
        if driving.is_closed:
            return [Drive(0.0, 0.0), *self._set_out_anew(pose, now_s)]
        if not is_due(driving.control_s, now_s):
            return []
        control = driving.follower.control(pose, now_s)
        if control is not None:
            drive, driving.control_s = control
            return [drive]
        return self._end_leg(driving, pose, now_s)

    def _end_leg(self, driving: Driving, pose: Pose, now_s: float) -> list[Action]:
        """Stop, and go on to what the leg led to, as soon as that is agreed."""
        moves = bool(driving.leg.waypoints_m) and not driving.is_early
        actions: list[Action] = [Drive(0.0, 0.0)] if moves else []
        if not is_due(driving.ends_s, now_s):
            driving.is_early, driving.control_s = True, driving.ends_s
            return actions
        self.pose = self._taken_for(driving.leg.arrival, pose)
        if driving.meeting is None:
            return [*actions, *self._begin_step(now_s)]
        self._activity, self._arrived = None, driving.meeting
        return actions

    def _watch(self, driving: Driving, pose: Pose) -> None:
        deviation_m = driving.follower.deviation_m(pose)
        is_displaced = deviation_m > self._settings.most_deviation_m
        if is_displaced and self.itinerary.can_go_on(pose):
            driving.displaced_m = deviation_m

    def _recover(self, displaced_m: float, pose: Pose, now_s: float) -> list[Action]:
        """Go on from where something has put the agent, as far as there is time to."""
        detail = f"{Fault.DISPLACED}={displaced_m:.3f}"
        ahead = self.itinerary.done + 1
        fault = self.report(TaskEventKind.FAULT, self._round, plan_index=ahead, detail=detail)
        return [fault, *self._set_out_anew(pose, now_s)]

    def _set_out_anew(self, pose: Pose, now_s: float) -> list[Action]:
        self.pose = pose
        self.itinerary.delay()
        return self._set_out(now_s)

    def _begin_step(self, now_s: float) -> list[Action]:
        step = self.itinerary.step
        self._activity = Acting(step, now_s + step.duration_s)
        if step.action is None:
            return []
        return [self._report_step(TaskEventKind.ACTION_STARTED, step, self.itinerary.done + 1)]

    def _act(self, acting: Acting, now_s: float) -> list[Action]:
        if not is_due(acting.until_s, now_s):
            return []
        has_acted = acting.step.action is not None
        if has_acted and self._settings.faults.strikes():
            return [self._fail(acting.step), *self._set_out(now_s)]
        self.itinerary.finish_step()
        kind = TaskEventKind.ACTION_FINISHED if has_acted else TaskEventKind.REGION_VISITED
        actions: list[Action] = [self._report_step(kind, acting.step)]
        if acting.step.satisfies:
            actions.append(self._report_step(TaskEventKind.TASK_SATISFIED, acting.step))
        return [*actions, *self._set_out(now_s)]

    def _fail(self, step: PlanStep) -> Action:
        detail = f"{Fault.FAILED}={step.action} attempt={self.itinerary.fail_step()}"
        return self._report_step(TaskEventKind.FAULT, step, self.itinerary.done + 1, detail)

    def _report_step(
        self, kind: TaskEventKind, step: PlanStep, plan_index: int | None = None, detail: str = ""
    ) -> ReportTask:
        return self.report(kind, self._round, step, plan_index, detail)

    def _taken_for(self, expected: Pose, actual: Pose) -> Pose:
        """Return the expected pose if the actual one is as near as can be expected."""
        off_m = actual.distance_m(expected.x_m, expected.y_m)
        off_rad = abs(wrap_angle(actual.yaw_rad - expected.yaw_rad))
        is_near = off_m <= self._settings.position_tolerance_m and off_rad <= _YAW_TOLERANCE_RAD
        return expected if is_near else actual


def _foreseen(predicted_s: float, now_s: float) -> str:
    return f"predicted_s={predicted_s:.9f} error_s={now_s - predicted_s:.9f}"
