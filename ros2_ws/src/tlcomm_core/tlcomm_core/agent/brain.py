"""Hybrid execution: an agent's plan, interleaved with the team's meetings.

``Brain``  events in, actions out; no clock, no logger, no transport inside

What it is doing is one of four activities, in this cycle (Section IV-C of the paper):

Meeting    at its place: negotiate the next meeting; leave at t_c + D_c. (``meeting``: later, or for
           the last meeting's place, if the network is so bad that there is no agreement by then.)
Driving    to the next step of its plan, or to the next place of meeting; anew, from where it is,
           when something has put it off its way, be it into what its task forbids, or when the map
           has closed that.
Acting     at a step's region, until the step is done, or begun anew since its action failed.
           Steps go on, through prefix and suffix, up to h; then to z, and Meeting again.
           (``itinerary``: up to fewer, if failures have taken the time.)

At t = 0 the team is connected: the first odometry finds the agent at the meeting of round 0.
"""

import math

from tlcomm_core.agent.actions import Action, Drive, Fault, ReportTask, TaskEvent, TaskEventKind
from tlcomm_core.agent.activities import Acting, Driving
from tlcomm_core.agent.controller import Follower
from tlcomm_core.agent.events import (
    Event,
    MapChanged,
    MessageHeard,
    OdometryReceived,
    TaskChanged,
    TimePassed,
)
from tlcomm_core.agent.itinerary import Itinerary
from tlcomm_core.agent.meeting import Meeting, News, is_due
from tlcomm_core.agent.offering import offer_of
from tlcomm_core.agent.reckoning import DeadReckoning
from tlcomm_core.agent.settings import Settings
from tlcomm_core.errors import PlanningError
from tlcomm_core.game.strategy import Strategy, TeamStrategy
from tlcomm_core.geometry import Pose, wrap_angle
from tlcomm_core.planning.plan import PlanStep
from tlcomm_core.protocol.actions import CountIgnored
from tlcomm_core.protocol.negotiation import Negotiation, Phase
from tlcomm_core.protocol.whereabouts import Ending, Whereabouts
from tlcomm_core.workspace.travel import TravelTimes

__all__ = ["Brain"]

# An agent that ends a leg as near as its tolerance and no further turned than this takes itself
# to be where the leg was to end: what it is off by is the controller's business.
_YAW_TOLERANCE_RAD = 0.1


class Brain:
    """One agent: executes its plan, and plans meetings with the others."""

    def __init__(self, settings: Settings) -> None:
        """Be ready for the first odometry."""
        self._settings = settings
        self._reckoning = DeadReckoning()
        self._activity: Driving | Acting | Meeting | None = None
        self._round = 0
        self._whereabouts: Whereabouts | None = None
        self._itinerary = Itinerary(settings.plan, settings.travel, settings.retries)
        self._pose = Pose(0.0, 0.0, 0.0)
        self._map_ns = 0

    @property
    def travel(self) -> TravelTimes:
        """Travel times on the latest map that it was told of."""
        return self._itinerary.travel

    @property
    def meetings_ended(self) -> int:
        """How many meetings have ended; that of round 0 is the first."""
        return self._round

    @property
    def phase(self) -> Phase | None:
        """Where planning the next round stands; ``None`` when not at a meeting."""
        return self._activity.negotiation.phase if isinstance(self._activity, Meeting) else None

    @property
    def awaited(self) -> str | None:
        """A member without whose word a meeting can't go on; ``None`` if anyone's may matter."""
        return self._activity.negotiation.awaited if isinstance(self._activity, Meeting) else None

    @property
    def next_start(self) -> Pose | None:
        """Where the agent will be when another plan can begin; ``None`` until that is agreed."""
        is_agreeing = isinstance(self._activity, Meeting) and not self._activity.is_agreed
        if self._activity is None or is_agreeing:
            return None
        return self._itinerary.meeting_pose(self._pose)

    @property
    def next_need_s(self) -> float:
        """When the brain must be told that time has passed; inf if only events matter."""
        match self._activity:
            case None:
                return math.inf
            case Driving(control_s=control_s):
                return control_s
            case Acting(until_s=until_s):
                return until_s
            case Meeting() as meeting:
                return meeting.next_need_s

    def handle(self, event: Event, now_s: float) -> tuple[Action, ...]:
        """Take an event at the time ``now_s`` (simulated time); return what to do.

        Of several events at one instant, ``TimePassed`` comes last: messages are only taken in
        before it, so that one answer is given to all of them.

        Raises:
            InfeasibleRoundError: the team has no admissible next meeting.
        """
        match event:
            case OdometryReceived():
                return tuple(self._locate(event, now_s))
            case MessageHeard(message):
                if isinstance(self._activity, Meeting):
                    return self._activity.negotiation.hear(message)
                return (CountIgnored("not meeting"),)
            case TaskChanged():
                self._itinerary.change(event)
                return ()
            case MapChanged():
                return tuple(self._see_map(event, now_s))
            case TimePassed():
                return tuple(self._proceed(now_s))

    def _locate(self, odometry: OdometryReceived, now_s: float) -> list[Action]:
        self._reckoning.take(odometry)
        if isinstance(self._activity, Driving):
            self._watch(self._activity, odometry.pose)
        if self._activity is not None:
            return []
        self._pose = odometry.pose
        self._whereabouts = Whereabouts((self._pose.x_m, self._pose.y_m))
        return self._reach_meeting(now_s)

    def _see_map(self, change: MapChanged, now_s: float) -> list[Action]:
        """Go by another map: at once if it closes the way under way, else with the next leg.

        An agent that it had cut off from its place of meeting, and nobody has joined, goes there.
        """
        driving = self._activity if isinstance(self._activity, Driving) else None
        pose = self._pose if driving is None else self._reckoning.pose_at(now_s)
        self._map_ns = change.map_ns
        self._itinerary.change_map(change.travel, pose)
        if driving is not None:
            ahead_m = [(pose.x_m, pose.y_m), *driving.follower.ahead_m]
            is_open = self._itinerary.still_leads(driving.leg, ahead_m, driving.meeting)
            driving.is_closed = not is_open
        meeting = self._activity
        is_alone = isinstance(meeting, Meeting) and meeting.negotiation.is_alone
        return self._set_out(now_s) if is_alone and self._itinerary.calls_away(pose) else []

    def _proceed(self, now_s: float) -> list[Action]:
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
                case Meeting():
                    actions += self._meet(activity, now_s)
            if self._activity is activity:
                return actions

    # Meeting.

    def _reach_meeting(self, now_s: float, detail: str = "") -> list[Action]:
        actions: list[Action] = [self._report(TaskEventKind.MEETING_REACHED, detail=detail)]
        if (change := self._itinerary.reach_meeting()) is not None:
            actions.append(self._report(TaskEventKind.TASK_CHANGED, detail=f"task={change.task}"))
        if self._itinerary.is_blocked(self._pose):
            actions.append(self._plan_anew())
        settings = self._settings
        offer = offer_of(settings, self._itinerary, self._pose, self._map_ns, self._round, now_s)
        self._activity = Meeting(
            settings.name,
            Negotiation(offer, self._round + 1, settings.team, settings.rounds),
            settings.team,
            lambda meeting: self._itinerary.leg(self._pose, meeting).duration_s,
        )
        return actions

    def _plan_anew(self) -> Action:
        """Take on another plan for the same task, if there is one on the map as it is."""
        itinerary = self._itinerary
        try:
            plan = self._settings.planner(itinerary.task, self._pose, itinerary.travel)
        except PlanningError as error:
            return self._report_fault(Fault.BLOCKED, str(error))
        itinerary.plan_anew(plan)
        return self._report(TaskEventKind.PLAN_CHANGED)

    def _meet(self, meeting: Meeting, now_s: float) -> list[Action]:
        actions: list[Action] = [*meeting.proceed(now_s)]
        actions += [self._take_news(news, meeting) for news in meeting.news(now_s)]
        if (ending := meeting.ending(now_s)) is not None:
            actions += self._end_meeting(meeting, ending, now_s)
        return actions

    def _take_news(self, news: News, meeting: Meeting) -> Action:
        """Report what happens at the meeting; plan for the next one once it is agreed."""
        negotiation = meeting.negotiation
        match news:
            case News.STARTED:
                detail = f"t_c_s={negotiation.meeting_s:.9f}"
                return self._report(TaskEventKind.MEETING_STARTED, detail=detail)
            case News.AGREED:
                agreed = negotiation.agreed
                assert agreed is not None
                self._agree(agreed, meeting.own_part(agreed), meeting.over_s)
                return self._report(TaskEventKind.ROUND_AGREED, round_=agreed.round)
            case News.OBSTRUCTED:
                return self._report_fault(Fault.INFEASIBLE, str(negotiation.obstacle))
            case News.OVERDUE:
                return self._report_disagreement("late", negotiation.round)

    def _agree(self, strategy: TeamStrategy, own: Strategy, departure_s: float) -> None:
        self._itinerary.agree(own, strategy.communication_s)
        self._itinerary.heed_map(self._pose, departure_s)

    def _end_meeting(self, meeting: Meeting, ending: Ending, now_s: float) -> list[Action]:
        """Leave for the next place of meeting, whichever that is by how this one ended."""
        assert self._whereabouts is not None
        window, confirmed = self._round, meeting.negotiation.confirmed
        own = None if confirmed is None else meeting.own_part(confirmed)
        new_m = None if own is None else (own.x_m, own.y_m)
        here_m = self._whereabouts.place(window)
        self._whereabouts = self._whereabouts.after(window, ending, new_m)
        if ending is Ending.AGREED:
            actions = [self._report(TaskEventKind.MEETING_ENDED)]
        else:
            actions = [self._report_disagreement(ending.value, window + 1)]
        agreed = meeting.negotiation.agreed
        self._round = window + 1 if agreed is None else agreed.round
        if own is not None and confirmed is not None:
            if not meeting.is_agreed:
                self._agree(confirmed, own, now_s)
            if meeting.is_prolonged:
                self._itinerary.delay()
            return [*actions, *self._set_out(now_s)]
        there_m = self._whereabouts.place(self._round)
        if there_m == here_m and not self._itinerary.calls_away(self._pose):
            return [*actions, *self._reach_meeting(now_s)]
        self._itinerary.return_to(there_m, self._settings.name, self._pose, now_s)
        return [*actions, *self._set_out(now_s)]

    def _report_disagreement(self, how: str, round_: int) -> ReportTask:
        return self._report_fault(Fault.DISAGREEMENT, f"{how} round={round_}")

    # Driving and acting.

    def _set_out(self, now_s: float) -> list[Action]:
        """Go to the next step or, when it is time to, to the meeting."""
        settings = self._settings
        meeting = self._itinerary.next_meeting(self._pose, now_s)
        leg = self._itinerary.leg(self._pose, meeting)
        follower = Follower(
            leg,
            self._pose,
            settings.travel.motion.linear_mps,
            settings.travel.motion.angular_radps,
            settings.position_tolerance_m,
            settings.pacing,
        )
        self._activity = Driving(leg, follower, meeting, now_s)
        if meeting is None or not self._itinerary.is_cut_off(self._pose):
            return []
        apart_m = leg.arrival.distance_m(meeting.x_m, meeting.y_m)
        return [self._report_fault(Fault.CUT_OFF, f"{apart_m:.3f}")]

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
        self._pose = self._taken_for(driving.leg.arrival, pose)
        actions: list[Action] = [Drive(0.0, 0.0)] if driving.leg.waypoints_m else []
        if driving.meeting is None:
            return [*actions, *self._begin_step(now_s)]
        predicted_s = driving.meeting.arrival_s
        detail = f"predicted_s={predicted_s:.9f} error_s={now_s - predicted_s:.9f}"
        return [*actions, *self._reach_meeting(now_s, detail)]

    def _watch(self, driving: Driving, pose: Pose) -> None:
        """See whether something has put the agent off its way."""
        deviation_m = driving.follower.deviation_m(pose)
        is_displaced = deviation_m > self._settings.most_deviation_m
        if is_displaced and self._itinerary.can_go_on(pose):
            driving.displaced_m = deviation_m

    def _recover(self, displaced_m: float, pose: Pose, now_s: float) -> list[Action]:
        """Go on from where something has put the agent, as far as there is time to."""
        detail = f"{Fault.DISPLACED}={displaced_m:.3f}"
        fault = self._report(
            TaskEventKind.FAULT, plan_index=self._itinerary.done + 1, detail=detail
        )
        return [fault, *self._set_out_anew(pose, now_s)]

    def _set_out_anew(self, pose: Pose, now_s: float) -> list[Action]:
        self._pose = pose
        self._itinerary.delay()
        return self._set_out(now_s)

    def _begin_step(self, now_s: float) -> list[Action]:
        step = self._itinerary.step
        self._activity = Acting(step, now_s + step.duration_s)
        if step.action is None:
            return []
        return [self._report(TaskEventKind.ACTION_STARTED, step, self._itinerary.done + 1)]

    def _act(self, acting: Acting, now_s: float) -> list[Action]:
        if not is_due(acting.until_s, now_s):
            return []
        has_acted = acting.step.action is not None
        if has_acted and self._settings.faults.strikes():
            return [self._fail(acting.step), *self._set_out(now_s)]
        self._itinerary.finish_step()
        kind = TaskEventKind.ACTION_FINISHED if has_acted else TaskEventKind.REGION_VISITED
        actions: list[Action] = [self._report(kind, acting.step)]
        if acting.step.satisfies:
            actions.append(self._report(TaskEventKind.TASK_SATISFIED, acting.step))
        return [*actions, *self._set_out(now_s)]

    def _fail(self, step: PlanStep) -> Action:
        detail = f"{Fault.FAILED}={step.action} attempt={self._itinerary.fail_step()}"
        return self._report(TaskEventKind.FAULT, step, self._itinerary.done + 1, detail=detail)

    # Where and when it is.

    def _taken_for(self, expected: Pose, actual: Pose) -> Pose:
        """Return the expected pose if the actual one is as near as can be expected."""
        off_m = actual.distance_m(expected.x_m, expected.y_m)
        off_rad = abs(wrap_angle(actual.yaw_rad - expected.yaw_rad))
        is_near = off_m <= self._settings.position_tolerance_m and off_rad <= _YAW_TOLERANCE_RAD
        return expected if is_near else actual

    def _report_fault(self, fault: Fault, what: str) -> ReportTask:
        return self._report(TaskEventKind.FAULT, detail=f"{fault}={what}")

    def _report(
        self,
        kind: TaskEventKind,
        step: PlanStep | None = None,
        plan_index: int | None = None,
        round_: int | None = None,
        detail: str = "",
    ) -> ReportTask:
        return ReportTask(
            TaskEvent(
                kind=kind,
                region="" if step is None else step.region,
                action="" if step is None or step.action is None else step.action,
                round=self._round if round_ is None else round_,
                plan_index=max(0, self._itinerary.done) if plan_index is None else plan_index,
                detail=detail,
            )
        )
