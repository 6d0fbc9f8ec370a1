"""Hybrid execution: an agent's plan, interleaved with the team's meetings.

``Brain``      events in, actions out; no clock, no logger, no transport inside
``TeamBrain``  of a team that meets as a whole

An agent is either under way (``journey``) or at its place of meeting, in this cycle (Section IV-C
of the paper):

Meeting  negotiate the next meeting; leave at t_c + D_c. (``meeting``: later, or for the last
         meeting's place, if the network is so bad that there is no agreement by then.)
Journey  steps go on, through prefix and suffix, up to h; then to z, and Meeting again.
         (``itinerary``: up to fewer, if failures have taken the time.)

At t = 0 the team is connected: the first odometry finds the agent at the meeting of round 0.
"""

from typing import Protocol

from tlcomm_core.agent.actions import Action
from tlcomm_core.agent.events import (
    Event,
    MapChanged,
    MessageHeard,
    OdometryReceived,
    TaskChanged,
    TimePassed,
)
from tlcomm_core.agent.journey import Journey
from tlcomm_core.agent.meeting import Meeting, News
from tlcomm_core.agent.offering import offer_of
from tlcomm_core.agent.settings import Settings
from tlcomm_core.game.offer import MemberOffer
from tlcomm_core.game.strategy import Strategy, TeamStrategy
from tlcomm_core.geometry import Pose
from tlcomm_core.protocol.actions import CountIgnored
from tlcomm_core.protocol.negotiation import Negotiation, Phase
from tlcomm_core.protocol.whereabouts import Ending, Whereabouts
from tlcomm_core.workspace.travel import TravelTimes

__all__ = ["Brain", "TeamBrain"]


class Brain(Protocol):
    """What decides for one agent, whatever the method of coordination."""

    @property
    def travel(self) -> TravelTimes:
        """Travel times on the latest map that it was told of."""

    @property
    def meetings_ended(self) -> int:
        """How many meetings have ended; that of round 0 is the first."""

    @property
    def phase(self) -> Phase | None:
        """Where planning the next round stands; ``None`` when not at a meeting."""

    @property
    def awaited(self) -> str | None:
        """A member without whose word a meeting can't go on; ``None`` if anyone's may matter."""

    @property
    def next_start(self) -> Pose | None:
        """Where the agent will be when another plan can begin; ``None`` until that is agreed."""

    @property
    def next_need_s(self) -> float:
        """When the brain must be told that time has passed; inf if only events matter."""

    def handle(self, event: Event, now_s: float) -> tuple[Action, ...]:
        """Take an event at the time ``now_s`` (simulated time); return what to do.

        Of several events at one instant, ``TimePassed`` comes last: messages are only taken in
        before it, so that one answer is given to all of them.

        Raises:
            InfeasibleRoundError: the team has no admissible next meeting.
        """


class TeamBrain:
    """One agent of a team that meets as a whole: executes its plan, and plans meetings."""

    def __init__(self, settings: Settings) -> None:
        """Be ready for the first odometry."""
        self._settings = settings
        self._journey = Journey(settings)
        self._itinerary = self._journey.itinerary
        self._meeting: Meeting | None = None
        self._round = 0
        self._whereabouts: Whereabouts | None = None
        self._map_ns = 0

    @property
    def travel(self) -> TravelTimes:
        """Travel times on the latest map that it was told of."""
        return self._journey.travel

    @property
    def meetings_ended(self) -> int:
        """How many meetings have ended; that of round 0 is the first."""
        return self._round

    @property
    def phase(self) -> Phase | None:
        """Where planning the next round stands; ``None`` when not at a meeting."""
        return None if self._meeting is None else self._meeting.negotiation.phase

    @property
    def awaited(self) -> str | None:
        """A member without whose word a meeting can't go on; ``None`` if anyone's may matter."""
        return None if self._meeting is None else self._meeting.negotiation.awaited

    @property
    def next_start(self) -> Pose | None:
        """Where the agent will be when another plan can begin; ``None`` until that is agreed."""
        is_agreeing = self._meeting is not None and not self._meeting.is_agreed
        if self._whereabouts is None or is_agreeing:
            return None
        return self._itinerary.meeting_pose(self._journey.pose)

    @property
    def next_need_s(self) -> float:
        """When the brain must be told that time has passed; inf if only events matter."""
        return self._journey.next_need_s if self._meeting is None else self._meeting.next_need_s

    def handle(self, event: Event, now_s: float) -> tuple[Action, ...]:
        """Take an event at the time ``now_s``, as ``Brain`` says."""
        match event:
            case OdometryReceived():
                return tuple(self._locate(event, now_s))
            case MessageHeard(message):
                if self._meeting is not None:
                    return self._meeting.negotiation.hear(message)
                return (CountIgnored("not meeting"),)
            case TaskChanged():
                self._itinerary.change(event)
                return ()
            case MapChanged():
                return tuple(self._see_map(event, now_s))
            case TimePassed():
                return tuple(self._proceed(now_s))

    def _locate(self, odometry: OdometryReceived, now_s: float) -> list[Action]:
        self._journey.locate(odometry)
        if self._whereabouts is not None:
            return []
        pose = self._journey.pose = odometry.pose
        self._whereabouts = Whereabouts((pose.x_m, pose.y_m))
        return self._reach_meeting(now_s)

    def _see_map(self, change: MapChanged, now_s: float) -> list[Action]:
        """Go by another map.

        An agent that it had cut off from its place of meeting, and nobody has joined, goes there.
        """
        self._map_ns = change.map_ns
        self._journey.see_map(change, now_s)
        is_alone = self._meeting is not None and self._meeting.negotiation.is_alone
        calls_away = is_alone and self._itinerary.calls_away(self._journey.pose)
        return self._set_out(now_s) if calls_away else []

    def _proceed(self, now_s: float) -> list[Action]:
        """Do whatever is due; a meeting may end and a journey begin at one instant."""
        actions: list[Action] = []
        while True:
            if (meeting := self._meeting) is not None:
                actions += self._meet(meeting, now_s)
            else:
                actions += self._journey.proceed(now_s)
                if (arrived := self._journey.take_arrival()) is not None:
                    actions += self._reach_meeting(now_s, arrived)
            if self._meeting is meeting:
                return actions

    def _set_out(self, now_s: float) -> list[Action]:
        self._meeting = None
        return self._journey.set_out(now_s, self._round)

    def _reach_meeting(self, now_s: float, expected: Strategy | None = None) -> list[Action]:
        actions = self._journey.reach_meeting(self._round, now_s, expected)
        settings, offer = self._settings, self._offer(now_s)
        self._meeting = Meeting(
            settings.name,
            Negotiation(offer, self._round + 1, settings.team, settings.rounds),
            settings.team,
            self._leave_by_s,
        )
        return actions

    def _offer(self, now_s: float) -> MemberOffer:
        pose = self._journey.pose
        return offer_of(self._settings, self._itinerary, pose, self._map_ns, self._round, now_s)

    def _leave_by_s(self, strategy: TeamStrategy) -> float:
        """Return when to leave at the latest to be punctual, going straight to the next meeting."""
        way = self._itinerary.leg(self._journey.pose, strategy.part_of(self._settings.name))
        return strategy.communication_s - way.duration_s

    def _meet(self, meeting: Meeting, now_s: float) -> list[Action]:
        actions: list[Action] = [*meeting.proceed(now_s)]
        actions += [self._take_news(news, meeting) for news in meeting.news(now_s)]
        if (ending := meeting.ending(now_s)) is not None:
            actions += self._end_meeting(meeting, ending, now_s)
        return actions

    def _take_news(self, news: News, meeting: Meeting) -> Action:
        """Report what happens at the meeting; plan for the next one once it is agreed."""
        if news is News.AGREED:
            agreed = meeting.negotiation.agreed
            assert agreed is not None
            self._agree(agreed, meeting.own_part(agreed), meeting.over_s)
        return self._journey.report_meeting(meeting.tell(news))

    def _agree(self, strategy: TeamStrategy, own: Strategy, departure_s: float) -> None:
        self._itinerary.agree(own, strategy.communication_s)
        self._itinerary.heed_map(self._journey.pose, departure_s)

    def _end_meeting(self, meeting: Meeting, ending: Ending, now_s: float) -> list[Action]:
        """Leave for the next place of meeting, whichever that is by how this one ended."""
        assert self._whereabouts is not None
        window, confirmed = self._round, meeting.negotiation.confirmed
        own = None if confirmed is None else meeting.own_part(confirmed)
        new_m = None if own is None else (own.x_m, own.y_m)
        here_m = self._whereabouts.place(window)
        self._whereabouts = self._whereabouts.after(window, ending, new_m)
        actions = [self._journey.report_meeting(meeting.tell(ending))]
        agreed = meeting.negotiation.agreed
        self._round = window + 1 if agreed is None else agreed.round
        if own is not None and confirmed is not None:
            if not meeting.is_agreed:
                self._agree(confirmed, own, now_s)
            if meeting.is_prolonged:
                self._itinerary.delay()
            return [*actions, *self._set_out(now_s)]
        pose, there_m = self._journey.pose, self._whereabouts.place(self._round)
        if there_m == here_m and not self._itinerary.calls_away(pose):
            return [*actions, *self._reach_meeting(now_s)]
        self._itinerary.return_to(there_m, self._settings.name, pose, now_s)
        return [*actions, *self._set_out(now_s)]
