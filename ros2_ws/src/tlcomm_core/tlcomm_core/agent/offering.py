"""What an agent lays open when it reaches a meeting.

``offer_of``  its presence and its plan from then on
"""

from tlcomm_core.agent.itinerary import Itinerary
from tlcomm_core.agent.settings import Settings
from tlcomm_core.game.offer import MemberOffer
from tlcomm_core.geometry import Pose

__all__ = ["offer_of"]


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
    horizon_s = team.opens_s(window + 1 + team.most_windows) - earliest_s
    return MemberOffer(
        agent=settings.name,
        arrival_s=now_s,
        x_m=pose.x_m,
        y_m=pose.y_m,
        yaw_rad=pose.yaw_rad,
        linear_mps=settings.travel.motion.linear_mps,
        angular_radps=settings.travel.motion.angular_radps,
        stops=itinerary.next_stops(pose, horizon_s),
        avoided=tuple(sorted(settings.travel.grid.avoided)),
        map_ns=map_ns,
    )
