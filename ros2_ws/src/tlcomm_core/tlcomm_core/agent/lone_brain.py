"""An agent that nobody meets: its plan alone, as fast as it can.

``LoneBrain``  a brain that only executes
"""

import math
from typing import Final

from tlcomm_core.agent.actions import Action, Fault, TaskEventKind
from tlcomm_core.agent.events import (
    Event,
    MapChanged,
    MessageHeard,
    OdometryReceived,
    TaskChanged,
    TimePassed,
)
from tlcomm_core.agent.journey import Journey
from tlcomm_core.agent.settings import Settings
from tlcomm_core.errors import PlanningError
from tlcomm_core.geometry import Pose
from tlcomm_core.protocol.actions import CountIgnored
from tlcomm_core.protocol.negotiation import Phase
from tlcomm_core.workspace.travel import TravelTimes

__all__ = ["LoneBrain"]


class LoneBrain:
    """One agent by itself.

    Another task begins at once. Where the map has closed its plan, it makes another as soon as
    there is one.
    """

    def __init__(self, settings: Settings) -> None:
        """Be ready for the first odometry."""
        self._settings: Final = settings
        self._journey: Final = Journey(settings)
        self._is_located = False
        self._is_stuck = False
        self._change: TaskChanged | None = None

    @property
    def travel(self) -> TravelTimes:
        """Travel times on the latest map that it was told of."""
        return self._journey.travel

    @property
    def meetings_ended(self) -> int:
        """None."""
        return 0

    @property
    def phase(self) -> Phase | None:
        """``None``: it never plans a round."""
        return None

    @property
    def awaited(self) -> str | None:
        """``None``: it never waits for anybody."""
        return None

    @property
    def next_start(self) -> Pose | None:
        """Where another plan is to begin: from where it has last stood, as it is there or near."""
        return self._journey.pose if self._is_located else None

    @property
    def next_need_s(self) -> float:
        """When the brain must be told that time has passed; inf if only events matter."""
        return self._journey.next_need_s if self._change is None else -math.inf

    def handle(self, event: Event, now_s: float) -> tuple[Action, ...]:
        """Take an event at the time ``now_s``; as ``Brain`` says."""
        match event:
            case OdometryReceived():
                self._journey.locate(event)
                return tuple(self._begin(event.pose, now_s))
            case MessageHeard():
                return (CountIgnored("not meeting"),)
            case TaskChanged():
                self._change = event
                return ()
            case MapChanged():
                self._journey.see_map(event, now_s)
                self._is_stuck = False
                return ()
            case TimePassed():
                return tuple(self._proceed(now_s))

    def _begin(self, pose: Pose, now_s: float) -> list[Action]:
        if self._is_located:
            return []
        self._is_located = True
        self._journey.pose = pose
        return self._journey.set_out(now_s, 0)

    def _proceed(self, now_s: float) -> list[Action]:
        actions = self._journey.proceed(now_s)
        if not self._is_located:
            return actions
        if self._change is not None:
            actions += self._change_task(self._change, now_s)
        if not self._journey.is_under_way and not self._is_stuck:
            actions += self._plan_anew(now_s)
        return [*actions, *self._journey.proceed(now_s)]

    def _plan_anew(self, now_s: float) -> list[Action]:
        itinerary, pose = self._journey.itinerary, self._journey.pose
        try:
            plan = self._settings.planner(itinerary.task, pose, itinerary.travel)
        except PlanningError as error:
            self._is_stuck = True
            return [self._journey.report_fault(Fault.BLOCKED, str(error))]
        itinerary.plan_anew(plan)
        report = self._journey.report(TaskEventKind.PLAN_CHANGED, 0)
        return [report, *self._journey.set_out(now_s, 0)]

    def _change_task(self, change: TaskChanged, now_s: float) -> list[Action]:
        self._change = None
        self._journey.itinerary.change(change)
        self._journey.itinerary.reach_meeting()
        report = self._journey.report(TaskEventKind.TASK_CHANGED, 0, detail=f"task={change.task}")
        return [report, *self._journey.redirect(now_s)]
