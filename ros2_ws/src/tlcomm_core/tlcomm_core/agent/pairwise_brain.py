"""An agent of a team that meets by pairs: its plan, interleaved with one partner after another.

``PairwiseBrain``  a brain with several partners

An agent meets each partner in the windows of their pair (``pairs``), so at most one in a window. A
meeting goes as that of a team of two; they plan their next one, after all that both have agreed to
attend before (``diary``). Then the agent leaves for the next in its diary.

At t = 0 all are together: an agent plans with its partners one after another, in the order of
their first windows, all within D_c of the start. Whom it has already agreed with it still answers.

Where two don't agree, ``whereabouts`` says for the two of them where they meet next: for all other
pairs nothing changes.
"""

from collections import deque
from collections.abc import Iterable
from dataclasses import replace
from typing import Final

from tlcomm_core.agent.actions import Action
from tlcomm_core.agent.diary import Appointment, Diary, Prospect
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
from tlcomm_core.agent.offering import Presence, later_offer
from tlcomm_core.agent.pairs import Pair
from tlcomm_core.agent.settings import Settings
from tlcomm_core.agent.visit import Encounter, Partner, Visit, partner_of
from tlcomm_core.game.strategy import Strategy, TeamStrategy
from tlcomm_core.geometry import Pose
from tlcomm_core.protocol.actions import CountIgnored
from tlcomm_core.protocol.messages import Message
from tlcomm_core.protocol.negotiation import Negotiation, Phase
from tlcomm_core.protocol.whereabouts import Ending, Whereabouts
from tlcomm_core.workspace.travel import TravelTimes

__all__ = ["PairwiseBrain"]


class PairwiseBrain:
    """One agent of a team that meets by pairs."""

    def __init__(self, settings: Settings, pairs: Iterable[Pair]) -> None:
        """Be ready for the first odometry.

        Args:
            settings: with the whole team.
            pairs: those that the agent belongs to, by their first windows; at least one.
        """
        self._settings: Final = settings
        self._journey: Final = Journey(settings)
        self._itinerary: Final = self._journey.itinerary
        partners = [partner_of(settings.name, pair, settings.team) for pair in pairs]
        self._partners: Final = {partner.name: partner for partner in partners}
        self._diary: Final = Diary(settings.team.duration_s)
        self._heading: Appointment | None = None
        self._visit: Visit | None = None
        self._is_located = False
        self._meetings_ended = 0
        self._map_ns = 0

    @property
    def travel(self) -> TravelTimes:
        """Travel times on the latest map that it was told of."""
        return self._journey.travel

    @property
    def meetings_ended(self) -> int:
        """How many meetings have ended; all of those at t = 0 count as one."""
        return self._meetings_ended

    @property
    def phase(self) -> Phase | None:
        """Where planning with the present partner stands; ``None`` when not at a meeting."""
        return None if self._visit is None else self._visit.latest.meeting.negotiation.phase

    @property
    def awaited(self) -> str | None:
        """A partner without whose word a meeting can't go on; ``None`` if anyone's may matter."""
        return None if self._visit is None else self._visit.latest.meeting.negotiation.awaited

    @property
    def next_start(self) -> Pose | None:
        """Where the agent will be when another plan can begin; ``None`` until that is agreed."""
        if self._visit is None:
            return self._itinerary.meeting_pose(self._journey.pose) if self._is_located else None
        first = self._diary.first
        return None if first is None else first.pose

    @property
    def next_need_s(self) -> float:
        """When the brain must be told that time has passed; inf if only events matter."""
        return self._journey.next_need_s if self._visit is None else self._visit.next_need_s

    def handle(self, event: Event, now_s: float) -> tuple[Action, ...]:
        """Take an event at the time ``now_s``, as ``Brain`` says."""
        match event:
            case OdometryReceived():
                return tuple(self._locate(event, now_s))
            case MessageHeard(message):
                return self._hear(message)
            case TaskChanged():
                self._itinerary.change(event)
                return ()
            case MapChanged():
                return tuple(self._see_map(event, now_s))
            case TimePassed():
                return tuple(self._proceed(now_s))

    def _locate(self, odometry: OdometryReceived, now_s: float) -> list[Action]:
        self._journey.locate(odometry)
        if self._is_located:
            return []
        self._is_located = True
        pose = self._journey.pose = odometry.pose
        for partner in self._partners.values():
            partner.whereabouts = Whereabouts((pose.x_m, pose.y_m))
        actions = self._journey.reach_meeting(0, now_s)
        self._begin_visit(self._partners.values(), now_s, now_s)
        return actions

    def _hear(self, message: Message) -> tuple[Action, ...]:
        """Pass a message on to the meeting with its sender.

        One whose turn hasn't come says it again when it is told that it hasn't been heard.
        """
        encounter = None if self._visit is None else self._visit.with_sender(message.sender)
        if encounter is None:
            return (CountIgnored("not meeting"),)
        return encounter.meeting.negotiation.hear(message)

    def _see_map(self, change: MapChanged, now_s: float) -> list[Action]:
        """Go by another map.

        An agent that it had cut off from its place of meeting, and nobody has joined, goes there.
        """
        self._map_ns = change.map_ns
        self._journey.see_map(change, now_s)
        self._diary.stand(self._pose_at)
        if self._visit is None or self._heading is None:
            return []
        if not self._visit.is_alone or not self._itinerary.calls_away(self._journey.pose):
            return []
        self._visit = None
        return self._journey.set_out(now_s, self._heading.window)

    def _pose_at(self, appointment: Appointment) -> Pose:
        """Return the pose at a meeting: as near its place as the map lets the agent come."""
        own, here = appointment.own, self._journey.pose
        is_there = appointment.pose.distance_m(own.x_m, own.y_m) == 0.0
        if is_there == self._itinerary.reaches(here, own):
            return appointment.pose
        return self._itinerary.leg(here, own).arrival

    def _proceed(self, now_s: float) -> list[Action]:
        """Do whatever is due; a visit may end and a journey begin at one instant."""
        actions: list[Action] = []
        while True:
            if (visit := self._visit) is not None:
                actions += self._meet(visit, now_s)
            else:
                actions += self._journey.proceed(now_s)
                if self._journey.take_arrival() is not None:
                    actions += self._arrive(now_s)
            if self._visit is visit:
                return actions

    def _arrive(self, now_s: float) -> list[Action]:
        heading = self._heading
        assert heading is not None, "an agent sets out for an appointment only"
        actions = self._journey.reach_meeting(heading.window, now_s, heading.own)
        done = self._itinerary.done
        self._diary.postpone(heading.own.task_index - done)
        self._heading = replace(heading, own=replace(heading.own, task_index=done))
        self._begin_visit([self._partners[heading.partner]], now_s, heading.meeting_s)
        return actions

    def _begin_visit(self, partners: Iterable[Partner], now_s: float, meeting_s: float) -> None:
        departure_s = max(now_s, meeting_s) + self._settings.team.duration_s
        presence = Presence(self._journey.pose, self._map_ns, now_s, departure_s)
        self._visit = Visit(presence, deque(partners))
        self._meet_next(self._visit)

    def _meet_next(self, visit: Visit) -> None:
        """Begin to plan with the next partner who is here, if there is one."""
        if not visit.ahead:
            return
        partner = visit.ahead.popleft()
        settings, team = self._settings, partner.team
        window = partner.next_window
        offer = later_offer(
            settings,
            self._itinerary,
            visit.presence,
            self._prospect(visit.presence.departure_s),
            team.opens_s(window + 1),
        )
        negotiation = Negotiation(offer, window, team, settings.rounds)
        meeting = Meeting(settings.name, negotiation, team, self._leave_by_s)
        visit.encounters.append(Encounter(partner, meeting, offer.stops))

    def _prospect(self, departure_s: float) -> Prospect:
        now = Prospect(self._journey.pose, self._itinerary.done, departure_s)
        return self._diary.prospect(now)

    def _leave_by_s(self, confirmed: TeamStrategy) -> float:
        """Return when to leave at the latest to be punctual at what comes next."""
        first, pose = self._diary.first, self._journey.pose
        if first is not None:
            return first.meeting_s - self._itinerary.leg(pose, first.own).duration_s
        way = self._itinerary.leg(pose, confirmed.part_of(self._settings.name))
        return confirmed.communication_s - way.duration_s

    def _meet(self, visit: Visit, now_s: float) -> list[Action]:
        actions: list[Action] = []
        for encounter in visit.encounters:
            meeting = encounter.meeting
            actions += meeting.proceed(now_s)
            for news in meeting.news(now_s):
                if news is News.AGREED:
                    self._book(encounter, now_s)
                # All meetings at the start begin as one.
                if news is not News.STARTED or encounter is visit.encounters[0]:
                    actions.append(self._journey.report_meeting(meeting.tell(news)))
            if (ending := encounter.ending(now_s)) is not None:
                actions += self._end(encounter, ending, now_s)
            if encounter.is_booked and encounter is visit.latest:
                self._meet_next(visit)
        return [*actions, *self._leave(visit, now_s)] if visit.is_over else actions

    def _leave(self, visit: Visit, now_s: float) -> list[Action]:
        """Set out for the next meeting in the diary."""
        meetings = [own.meeting for own in visit.encounters]
        agreed = [own for own in meetings if own.negotiation.agreed is not None]
        actions = [self._journey.report_meeting(own.tell(Ending.AGREED)) for own in agreed[:1]]
        self._visit = None
        self._meetings_ended += 1
        self._heading = heading = self._diary.take()
        self._itinerary.agree(heading.own, heading.meeting_s)
        self._itinerary.keep_time(self._journey.pose, self._leeway_s(heading))
        return [*actions, *self._journey.set_out(now_s, heading.window)]

    def _leeway_s(self, heading: Appointment) -> float:
        """Return how late an agent may be rather than leave a step out.

        That is D_c, or half of what is left of the window: it may lose more on the last leg.
        """
        team = self._settings.team
        closes_s = team.opens_s(heading.window + 1) - team.margin_s
        return max(0.0, min(team.duration_s, 0.5 * (closes_s - heading.meeting_s)))

    def _book(self, encounter: Encounter, now_s: float) -> None:
        """Put the pair's next meeting in the diary: as confirmed, or else by its whereabouts."""
        if encounter.is_booked:
            return
        encounter.is_booked = True
        confirmed = encounter.meeting.negotiation.confirmed
        if confirmed is None:
            self._diary.add(self._return(encounter.partner, now_s))
            return
        own = encounter.meeting.own_part(confirmed)
        pose = self._itinerary.leg(encounter.pose_after(own.task_index), own).arrival
        name, t_c_s = encounter.partner.name, confirmed.communication_s
        self._diary.add(Appointment(name, confirmed.round, own, t_c_s, pose))

    def _return(self, partner: Partner, now_s: float) -> Appointment:
        """Return the appointment where the two are to be though they haven't agreed."""
        last = self._prospect(now_s)
        place = Strategy(self._settings.name, *partner.place_m, last.done, last.free_s, 0.0)
        leg = self._itinerary.leg(last.pose, place)
        own = replace(place, arrival_s=last.free_s + leg.duration_s)
        meeting_s = max(own.arrival_s, partner.team.opens_s(partner.window))
        return Appointment(partner.name, partner.window, own, meeting_s, leg.arrival)

    def _end(self, encounter: Encounter, ending: Ending, now_s: float) -> list[Action]:
        """Be free to leave, as far as this partner is concerned."""
        encounter.is_over = True
        confirmed = encounter.meeting.negotiation.confirmed
        own = None if confirmed is None else encounter.meeting.own_part(confirmed)
        encounter.partner.part(ending, None if own is None else (own.x_m, own.y_m))
        self._book(encounter, now_s)
        if ending is Ending.AGREED:
            return []
        return [self._journey.report_meeting(encounter.meeting.tell(ending))]
