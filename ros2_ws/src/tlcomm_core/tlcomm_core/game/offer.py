"""What an agent lays open of its plan, and whether a peer's can be used.

``PlannedStop``  one step of a plan as others need it
``MemberOffer``  an agent's presence and plan
``next_stops``   an agent's own next stops
``busy_until``   who has no time for a meeting, and why
``offer_flaw``   what is wrong with an offer
"""

import math
from collections.abc import Iterable
from dataclasses import dataclass
from itertools import pairwise
from typing import Final

from tlcomm_core.geometry import Pose
from tlcomm_core.planning.plan import LocalPlan
from tlcomm_core.workspace.grid import Grid
from tlcomm_core.workspace.travel import TravelTimes

__all__ = ["MAX_STOPS", "MemberOffer", "PlannedStop", "busy_until", "next_stops", "offer_flaw"]

MAX_STOPS: Final = 256
"""The most stops in an offer: a plan of very short steps is cut off, not sent at any length."""

_MIN_STOPS: Final = 2


@dataclass(frozen=True, slots=True)
class PlannedStop:
    """One step of a plan as others need it.

    Attributes:
        task_index: the step's index in its agent's local plan.
        x_m: where the step is done.
        y_m: the same.
        yaw_rad: heading on finishing the step.
        finish_offset_s: when it is finished, counted from the departure from the meeting.
    """

    task_index: int
    x_m: float
    y_m: float
    yaw_rad: float
    finish_offset_s: float


@dataclass(frozen=True, slots=True)
class MemberOffer:
    """An agent's presence and plan for the time after this meeting.

    Attributes:
        agent: whose.
        arrival_s: when it reached its place (simulated time).
        x_m: where it stands.
        y_m: the same.
        yaw_rad: the same.
        linear_mps: its speed, v.
        angular_radps: its turn rate, ω.
        stops: its next steps, ascending; the last is there only as what follows its forerunner.
        avoided: regions that it never drives through, sorted.
        map_ns: the time from which the map holds that all this was computed with.
    """

    agent: str
    arrival_s: float
    x_m: float
    y_m: float
    yaw_rad: float
    linear_mps: float
    angular_radps: float
    stops: tuple[PlannedStop, ...]
    avoided: tuple[str, ...] = ()
    map_ns: int = 0


def next_stops(
    plan: LocalPlan, index: int, pose: Pose, travel: TravelTimes, horizon_s: float
) -> tuple[PlannedStop, ...]:
    """Return the next steps of a plan with the times and poses at which they are finished.

    Args:
        plan: the agent's plan.
        index: its next step, l; a meeting comes at the earliest after it.
        pose: where the agent stands at the present meeting.
        travel: travel times with the agent's motion.
        horizon_s: time from the departure to the end of the window to plan.

    Returns:
        Steps ``index``, ``index`` + 1, …, up to the first that isn't finished within the horizon;
        at least two and at most ``MAX_STOPS``. From the first that can't be reached on, the agent
        waits where it is: no further such step is listed than two steps in all need.

    Source: Section IV-B1 of the paper, t_{i,h} for h ≥ l.
    """
    stops: list[PlannedStop] = []
    offset_s = 0.0
    goes_on = True
    while len(stops) < _MIN_STOPS or (goes_on and offset_s <= horizon_s and len(stops) < MAX_STOPS):
        task_index = index + len(stops)
        step = plan.step(task_index)
        goes_on = goes_on and travel.grid.leads(pose.x_m, pose.y_m, step.location)
        if goes_on:
            leg = travel.leg_to(pose, step.location)
            pose = leg.arrival
            offset_s += leg.duration_s + step.duration_s
        stops.append(PlannedStop(task_index, pose.x_m, pose.y_m, pose.yaw_rad, offset_s))
    return tuple(stops)


def busy_until(offers: Iterable[MemberOffer], departure_s: float, closes_s: float) -> str:
    """Return who is busy with its next step until a window closes, and until when; "" if nobody.

    Args:
        offers: of the members.
        departure_s: when they leave the present meeting.
        closes_s: when the window closes.
    """
    ends_s = {offer.agent: departure_s + offer.stops[0].finish_offset_s for offer in offers}
    return ", ".join(
        f"{agent}'s next step takes until {end_s:.1f} s"
        for agent, end_s in ends_s.items()
        if end_s >= closes_s
    )


def offer_flaw(offer: MemberOffer, grid: Grid) -> str | None:
    """Return why no candidates can be computed from an offer, in one line; None if they can.

    Args:
        offer: as received; any values.
        grid: the workspace as the agent drives in it, avoiding what it avoids.
    """
    if not all(0.0 < speed < math.inf for speed in (offer.linear_mps, offer.angular_radps)):
        return f"speeds {offer.linear_mps!r} m/s, {offer.angular_radps!r} rad/s aren't positive"
    if not math.isfinite(offer.arrival_s):
        return f"arrival at {offer.arrival_s!r} s"
    if not _MIN_STOPS <= len(offer.stops) <= MAX_STOPS:
        return f"{len(offer.stops)} stops; expected {_MIN_STOPS} to {MAX_STOPS}"
    return _order_flaw(offer.stops) or _place_flaw(offer, grid)


def _order_flaw(stops: tuple[PlannedStop, ...]) -> str | None:
    if not stops[0].finish_offset_s >= 0.0:
        return f"stop {stops[0]!r} is finished before the departure"
    for stop, following in pairwise(stops):
        if following.task_index != stop.task_index + 1:
            return f"task {following.task_index!r} follows task {stop.task_index!r}"
        if not stop.finish_offset_s <= following.finish_offset_s < math.inf:
            return f"stop {following!r} is finished before the one that it follows"
    return None


def _place_flaw(offer: MemberOffer, grid: Grid) -> str | None:
    """Return which place isn't free, or can't be reached from the agent's own."""
    poses = [Pose(stop.x_m, stop.y_m, stop.yaw_rad) for stop in offer.stops]
    component = None
    for pose in (Pose(offer.x_m, offer.y_m, offer.yaw_rad), *poses):
        location = grid.location_at(pose.x_m, pose.y_m)
        if location is None or not math.isfinite(pose.yaw_rad):
            return f"{pose!r} isn't in a free cell"
        reached = int(grid.components[location])
        if component not in (None, reached):
            return f"{pose!r} can't be reached from the agent's place"
        component = reached
    return None
