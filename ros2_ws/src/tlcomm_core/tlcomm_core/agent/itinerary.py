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

Who agrees on meetings far ahead (``keep_time``) lets time decide on each step that it is late for.

When the map changes, ways may become longer: if what is left takes more time than before, time
decides on each step as after a failure. A step that can't be reached any more ends what is done
before the meeting; a place of meeting that can't is replaced by the nearest one that can.
"""

import math
from collections.abc import Sequence
from dataclasses import replace
from typing import Final

from tlcomm_core.agent.convoy import AgreedLeg
from tlcomm_core.agent.events import TaskChanged
from tlcomm_core.agent.ways import Ways
from tlcomm_core.errors import LocalMisuseError
from tlcomm_core.game.offer import PlannedStop, next_stops
from tlcomm_core.game.strategy import Strategy
from tlcomm_core.geometry import Pose
from tlcomm_core.planning.plan import LocalPlan, PlanStep
from tlcomm_core.workspace.grid import Grid
from tlcomm_core.workspace.travel import Leg, TravelTimes

__all__ = ["Itinerary"]

# What sums of times may be off by, each rounded to nanoseconds.
_ROUNDING_S: Final = 1e-6
# An offer lists the next step and the one that it leads on to.
_LEAST_STOPS: Final = 2


class Itinerary:
    """The plan, how far it is done, and when to leave it for the meeting.

    Attributes:
        done: index of the last step done; −1 before the first.
        task: the task that was given last; ``None`` for the scenario's.
    """

    def __init__(self, plan: LocalPlan, travel: TravelTimes, retries: int) -> None:
        """Begin with the plan's first step.

        Args:
            plan: what to do.
            travel: travel times with the agent's own motion.
            retries: how often a failed action is begun anew before the next meeting.
        """
        self.done = -1
        self.task: str | None = None
        self._plan = plan
        self._made: tuple[LocalPlan, Grid] = (plan, travel.grid)
        self._ways: Final = Ways(travel)
        self._is_map_new = False
        self._has_reached = False
        self._retries: Final = retries
        self._meeting: Strategy | None = None
        self._agreed_leg: AgreedLeg | None = None
        self._goes_together = False
        self._meeting_s = 0.0
        self._failures = 0
        self._is_delayed = False
        self._set_out_by_s: dict[int, float] = {}
        self._change: TaskChanged | None = None

    @property
    def step(self) -> PlanStep:
        """The step to do next, or under way."""
        return self._plan.step(self.done + 1)

    @property
    def steps_to_action(self) -> int:
        """How many steps there are up to the next that takes time; at least two."""
        ahead = len(self._plan.prefix) + len(self._plan.suffix)
        steps = (self._plan.step(self.done + count) for count in range(1, ahead + 1))
        count = next((n for n, step in enumerate(steps, start=1) if step.duration_s > 0.0), 0)
        return max(count, _LEAST_STOPS)

    @property
    def travel(self) -> TravelTimes:
        """Travel times on the map as it is."""
        return self._ways.travel

    def agree(
        self, meeting: Strategy, meeting_s: float, agreed_leg: AgreedLeg | None = None
    ) -> None:
        """Take the agent's own part in what the team has agreed on.

        Args:
            meeting: where to be, and after which step.
            meeting_s: t_c, when the team is to be there.
            agreed_leg: how to go first, if that is agreed too.
        """
        self._meeting = meeting
        self._agreed_leg = agreed_leg
        self._goes_together = agreed_leg is not None
        self._meeting_s = meeting_s
        self._failures = 0
        self._is_delayed = False
        self._set_out_by_s = {}
        self._has_reached = False

    def heed_map(self, pose: Pose, departure_s: float) -> None:
        """Note whether what was agreed takes longer on a map that is newer than the agreement's.

        Args:
            pose: where the agent stands at the meeting.
            departure_s: when it leaves.
        """
        if self._is_map_new and departure_s + self._left_s(pose) > self._latest_s():
            self.delay()
        self._is_map_new = False

    def keep_time(self, pose: Pose, leeway_s: float) -> None:
        """Let time decide on each step that is begun later than what was agreed leaves time for.

        Args:
            pose: where the agent sets out from.
            leeway_s: how much later than agreed it may be at the meeting.
        """
        legs, steps = self._legs(pose), self._steps_left()
        if len(legs) <= len(steps):
            self.delay()
            return
        by_s = self._latest_s() + leeway_s - legs[-1].duration_s
        for number in reversed(range(len(steps))):
            by_s -= legs[number].duration_s + steps[number].duration_s
            self._set_out_by_s[self.done + 1 + number] = by_s

    def change_map(self, travel: TravelTimes, pose: Pose) -> None:
        """Go by another map from now on.

        Args:
            travel: travel times on it.
            pose: where the agent is.
        """
        before_s = self._left_s(pose)
        self._ways.change(travel, pose)
        self._locate_plan()
        self._is_map_new = True
        if self._left_s(pose) > before_s + _ROUNDING_S:
            self.delay()

    def return_to(self, place_m: tuple[float, float], name: str, pose: Pose, now_s: float) -> None:
        """Go straight to a place (m) where the team may meet, as agent ``name``, from a pose."""
        place = Strategy(name, *place_m, self.done, now_s, 0.0)
        arrival_s = now_s + self.leg(pose, place).duration_s
        self.agree(replace(place, arrival_s=arrival_s), now_s)

    def change(self, change: TaskChanged) -> None:
        """Note another plan; it begins at the next meeting, unless yet another comes before."""
        self._change = change

    def reach_meeting(self) -> TaskChanged | None:
        """Do no more until the next agreement; begin the other plan, if any, and return it."""
        self._has_reached = True
        self._agreed_leg = None
        change, self._change = self._change, None
        if change is not None:
            self.task = change.task
            self._begin(change.plan, change.grid)
        return change

    def plan_anew(self, plan: LocalPlan) -> None:
        """Begin another plan for the same task, made on the present map."""
        self._begin(plan, self.travel.grid)

    def is_blocked(self, pose: Pose) -> bool:
        """Return whether the plan has a step ahead that can't be reached from a pose."""
        ahead = (*self._plan.prefix[self.done + 1 :], *self._plan.suffix)
        return not all(self._ways.lead(pose, place) for place in {s.location for s in ahead})

    def meeting_pose(self, pose: Pose) -> Pose:
        """Return where the agent will be at the meeting if nothing fails.

        Args:
            pose: where the agent has set out from.
        """
        return self._legs(pose)[-1].arrival

    def finish_step(self) -> None:
        """Note that the step has been done."""
        self.done += 1
        self._failures = 0
        self._agreed_leg = None

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
        return self._ways.lead(pose, self.step.location)

    def still_leads(
        self, leg: Leg, ahead_m: Sequence[tuple[float, float]], meeting: Strategy | None
    ) -> bool:
        """Return whether a leg under way ends where the agent is to go, and its rest is free.

        Args:
            leg: the leg.
            ahead_m: where the agent is, and the waypoints that are left.
            meeting: where it leads, as for ``leg``.
        """
        grid = self.travel.grid
        pose = Pose(*ahead_m[0], 0.0)
        end = grid.location_at(leg.arrival.x_m, leg.arrival.y_m)
        return end is not None and end == self._target(pose, meeting) and grid.is_clear(ahead_m)

    def next_meeting(self, pose: Pose, now_s: float) -> Strategy | None:
        """Return the meeting if it is time to go there; ``None`` if a step comes first.

        Without a meeting ahead, steps follow one another for ever.

        Args:
            pose: where the agent is to set out from.
            now_s: the time.
        """
        meeting = self._meeting
        if meeting is None:
            return None
        if not self._steps_left() or not self._ways.lead(pose, self.step.location):
            return meeting
        is_late = now_s > self._set_out_by_s.get(self.done + 1, math.inf)
        if not self._is_delayed and not is_late:
            return None
        is_possible = self._failures <= self._retries and self._has_time(pose, now_s)
        return None if is_possible else meeting

    def leg(self, pose: Pose, meeting: Strategy | None) -> Leg:
        """Return the way to a meeting or, with ``None``, to the next step.

        It begins with the way out of what the task forbids or the map has closed, if the agent is
        there. Where the place of meeting can't be reached, it leads to the nearest that can; it is
        empty if none can. A leg that is agreed comes before all, where it begins, as far as it is
        free.
        """
        agreed = self._agreed_leg
        if agreed is not None and agreed.start == pose and self._is_free(agreed):
            return agreed.leg
        target = self._target(pose, meeting)
        if target is None:
            return Leg((), 0.0, 0.0, pose)
        # Those who agreed to go together find the same way anew.
        if meeting is None or self._goes_together:
            return self._ways.leg_to(pose, target)
        return self._ways.leg_from(pose, target)

    def hours(self, leg: Leg) -> tuple[float, float]:
        """Return when a leg begins and ends at the earliest, as far as that is agreed."""
        agreed = self._agreed_leg
        if agreed is None or agreed.leg is not leg:
            return -math.inf, -math.inf
        return agreed.begins_s, agreed.ends_s

    def is_cut_off(self, pose: Pose) -> bool:
        """Return whether the agreed place of meeting can't be reached."""
        return not self.reaches(pose, self._agreed())

    def reaches(self, pose: Pose, meeting: Strategy) -> bool:
        """Return whether a way leads from a pose to the place of a meeting."""
        return self._ways.lead(pose, self._place(meeting))

    def calls_away(self, pose: Pose) -> bool:
        """Return whether the agreed place of meeting is elsewhere, and can be reached."""
        if self._meeting is None:
            return False
        place, here = self._place(self._meeting), self.travel.grid.location_at(pose.x_m, pose.y_m)
        return place != here and self._ways.lead(pose, place)

    def next_stops(
        self, pose: Pose, horizon_s: float, done: int | None = None
    ) -> tuple[PlannedStop, ...]:
        """Return the next steps with the times and poses at which they are finished.

        Args:
            pose: where the agent stands at a meeting: the present one, or a later one.
            horizon_s: time from its departure there to the end of the window to plan.
            done: index of the last step that will be done then, unless that is the last one done.
        """
        index = (self.done if done is None else done) + 1
        return next_stops(self._plan, index, pose, self.travel, horizon_s)

    def _has_time(self, pose: Pose, now_s: float) -> bool:
        """Return whether the next step can be done before the meeting."""
        there = self.leg(pose, None)
        onward = self.leg(there.arrival, self._agreed())
        needed_s = there.duration_s + self.step.duration_s + onward.duration_s
        return now_s + needed_s <= self._meeting_s + _ROUNDING_S

    def _is_free(self, agreed: AgreedLeg) -> bool:
        """Return whether an agreed leg leads past all obstacles of the present map."""
        start_m = (agreed.start.x_m, agreed.start.y_m)
        return self.travel.grid.is_clear([start_m, *agreed.leg.waypoints_m])

    def _agreed(self) -> Strategy:
        if self._meeting is None:
            raise LocalMisuseError("an agent set out before any meeting was agreed")
        return self._meeting

    def _target(self, pose: Pose, meeting: Strategy | None) -> int | None:
        if meeting is None:
            return self.step.location
        place = self._place(meeting)
        if self._ways.lead(pose, place):
            return place
        return self._ways.nearest(pose, meeting.x_m, meeting.y_m)

    def _place(self, meeting: Strategy) -> int:
        """Return the location of a meeting; −1 if the map has closed it."""
        place = self.travel.grid.location_at(meeting.x_m, meeting.y_m)
        return -1 if place is None else place

    def _legs(self, pose: Pose) -> list[Leg]:
        """Return the legs that are left to the meeting, as far as they can be driven."""
        legs: list[Leg] = []
        for step in self._steps_left():
            if not self._ways.lead(pose, step.location):
                break
            legs.append(self._ways.leg_to(pose, step.location))
            pose = legs[-1].arrival
        return [*legs, self.leg(pose, self._agreed())]

    def _steps_left(self) -> list[PlanStep]:
        if self._has_reached:
            return []
        last = self._agreed().task_index
        return [self._plan.step(index) for index in range(self.done + 1, last + 1)]

    def _left_s(self, pose: Pose) -> float:
        """Return what is left to the meeting takes from a pose; inf if it can't be done."""
        if self._meeting is None:
            return 0.0
        legs, steps = self._legs(pose), self._steps_left()
        if len(legs) <= len(steps):
            return math.inf
        return sum(leg.duration_s for leg in legs) + sum(step.duration_s for step in steps)

    def _latest_s(self) -> float:
        """Return when the agent is to be at the meeting, as agreed."""
        return self._agreed().arrival_s + _ROUNDING_S

    def _begin(self, plan: LocalPlan, grid: Grid) -> None:
        self._made = (plan, grid)
        self.done = -1
        self._locate_plan()

    def _locate_plan(self) -> None:
        """Find the plan's places on the present map."""
        plan, grid = self._made
        self._plan = plan.relocated(grid.numbers_in(self.travel.grid))
