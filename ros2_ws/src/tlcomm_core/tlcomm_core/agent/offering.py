"""What an agent lays open when it reaches a meeting.

``offer_of``     its presence and its plan from then on
``later_offer``  the same, where it has other meetings to attend before it goes on with the plan
``Presence``     how it is there
"""

from dataclasses import dataclass, replace

from tlcomm_core.agent.diary import Prospect
from tlcomm_core.agent.itinerary import Itinerary
from tlcomm_core.agent.settings import Settings
from tlcomm_core.game.offer import MemberOffer, PlannedStop
from tlcomm_core.geometry import Pose

__all__ = ["Presence", "later_offer", "offer_of"]


@dataclass(frozen=True, slots=True)
class Presence:
    """How an agent is at a meeting.

    Attributes:
        pose: where it stands.
        map_ns: the map that it plans on, by its stamp.
        arrival_s: when it has arrived.
        departure_s: when it will leave, as far as it can know.
    """

    pose: Pose
    map_ns: int
    arrival_s: float
    departure_s: float


def offer_of(
    settings: Settings,
    itinerary: Itinerary,
    pose: Pose,
    map_ns: int,
    window: int,
    now_s: float,
) -> MemberOffer:
    """Return an agent's offer for the next meeting.

    Args:
        settings: of the agent.
        itinerary: the agent's.
        pose: where it is.
        map_ns: the map that it plans on, by its stamp.
        window: in which the present meeting is.
        now_s: when it has arrived.
    """
    team = settings.team
    # The departure is D_c after now or after the window's opening at the earliest.
    earliest_s = max(now_s, team.opens_s(window)) + team.duration_s
    presence = Presence(pose, map_ns, now_s, earliest_s)
    stops = itinerary.next_stops(pose, team.horizon_s(window, earliest_s))
    return _offer(settings, presence, stops)


def later_offer(
    settings: Settings,
    itinerary: Itinerary,
    presence: Presence,
    prospect: Prospect,
    closes_s: float,
) -> MemberOffer:
    """Return an agent's offer for a meeting after others that it has agreed to.

    Stops are timed from the departure from the present meeting, as in any offer. If its partner is
    late, that departure is later than the agent could know, and so are its stops by the offer: then
    it has more time than it says.

    Args:
        settings: of the agent.
        itinerary: the agent's.
        presence: how it is at the present meeting.
        prospect: where it will be after the others.
        closes_s: when the window to plan ends.
    """
    free_s = max(prospect.free_s, presence.departure_s)
    until_free_s = free_s - presence.departure_s
    stops = itinerary.next_stops(prospect.pose, closes_s - free_s, prospect.done)
    later = (replace(s, finish_offset_s=until_free_s + s.finish_offset_s) for s in stops)
    return _offer(settings, presence, tuple(later))


def _offer(settings: Settings, presence: Presence, stops: tuple[PlannedStop, ...]) -> MemberOffer:
    pose, motion = presence.pose, settings.travel.motion
    return MemberOffer(
        agent=settings.name,
        arrival_s=presence.arrival_s,
        x_m=pose.x_m,
        y_m=pose.y_m,
        yaw_rad=pose.yaw_rad,
        linear_mps=motion.linear_mps,
        angular_radps=motion.angular_radps,
        stops=stops,
        avoided=tuple(sorted(settings.travel.grid.avoided)),
        map_ns=presence.map_ns,
    )
