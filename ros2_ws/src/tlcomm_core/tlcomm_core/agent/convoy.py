"""How a team goes together, so that it is connected at every instant.

``AgreedLeg``    a leg that others reckon with: which way, and from when on
``Part``         one agent's part in what the team does next
``turn``         all go to where the leader next has something to do
``contraction``  the outermost go to those next to them
``is_together``  whether all are at one place

A turn. All stand at one place, and drive one polyline, the leader's way, at one pair of speeds (v,
ω) that all can do. Headings may differ at first: agent i needs T_i to turn to the first straight
and to drive it, and sets out max_j T_j − T_i after the departure. So all come to its end, the first
corner, at the same time, and began it at the same time as well, as it is as long for all. From then
on they are at the same point, with the same heading, at every instant, and before that none of them
moves. So the distance of any two is 0 ≤ R. The way leads through the regions that the leader's plan
visits in passing, and ends at its next action; the leader performs that while the others stand by.

A contraction. Not all stand at one place. Let two be linked if each could approach the other
(``approach``) while the other stands still, without losing it; let a tree of shortest ways over
links lead to a root; and let those at its largest depth, which is D, go to where their parents are.
The parents, at depth D − 1, stand still, and so does everyone else but the children. So all links
of the tree stay, and at every instant it connects the team, at whatever times and speeds its
members set out. Afterwards the root's ways have D − 1 links at most; so after at most D
contractions all are at the root's place, and after as many as the least depth of all trees if each
time the root with the least is taken.

What this promises for the places that controllers aim at holds for where agents are as well as they
keep to their speeds: it needs no more than that what they are off by, with the range, stays below
R.

Source: M. Guo, J. Tumova and D. V. Dimarogonas, "Communication-free multi-agent control under local
    temporal tasks and relative-distance constraints", IEEE Trans. Automatic Control, 2016: one
    agent after the other is the leader and goes to its next goal; the others follow, so that the
    graph stays connected, and all end up near that goal.
Deviates: there followers are driven by a potential over continuous motion, without any
    communication; here turn-and-forward vehicles agree on the leader's way and drive it themselves.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import chain, combinations, dropwhile
from typing import Final

import numpy as np
from numpy.typing import NDArray
from scipy.sparse.csgraph import shortest_path

from tlcomm_core.agent.approach import Approaches, Corners
from tlcomm_core.game.offer import MemberOffer
from tlcomm_core.game.strategy import Strategy
from tlcomm_core.geometry import Pose, wrap_angle
from tlcomm_core.workspace.travel import Leg, Motion, TravelTimes

__all__ = ["AgreedLeg", "Part", "contraction", "is_together", "turn"]

# A turn and a straight are two segments of a controller; as many are spare.
_SEGMENTS: Final = 4
# Simulated time is rounded to nanoseconds, each time anew: so late may somebody be.
_ROUNDING_S: Final = 1e-3
# What takes no longer than this takes no time: a region that is only driven through.
_INSTANT_S: Final = 1e-6


@dataclass(frozen=True, slots=True)
class AgreedLeg:
    """A leg that others reckon with.

    Attributes:
        start: where it begins; from elsewhere it means nothing.
        leg: the way.
        begins_s: when to set out, not earlier.
        ends_s: when all are there: who is earlier waits.
    """

    start: Pose
    leg: Leg
    begins_s: float
    ends_s: float


@dataclass(frozen=True, slots=True)
class Part:
    """One agent's part in what the team does next.

    Attributes:
        way: how it goes.
        strategy: the same as the team knows it. Its h of an agent that does no step, and has done
            none yet, is 0: there is no number for none.
        steps: how many steps of its plan it does on the way and there.
    """

    way: AgreedLeg
    strategy: Strategy
    steps: int


def is_together(offers: Sequence[MemberOffer], within_m: float) -> bool:
    """Tell whether no two members' places are further apart than ``within_m``."""
    poses = [_pose_of(offer) for offer in offers]
    return all(
        one.distance_m(other.x_m, other.y_m) <= within_m for one, other in combinations(poses, 2)
    )


def turn(
    offers: Sequence[MemberOffer],
    leader: int,
    departure_s: float,
    travel: TravelTimes,
    near_m: float = 0.0,
) -> tuple[Part, ...]:
    """Return everybody's part when all go to where the leader next has something to do.

    That is its next step that takes time, if its offer has one, or else its next step.

    Args:
        offers: all members', who are together.
        leader: who leads, by its index. If no way leads to its next step, all stay.
        departure_s: when the present meeting ends.
        travel: travel times with speeds that all can do, round what anybody avoids.
        near_m: corners of the way so near to its start aren't driven to: who is a little off may
            be past them.
    """
    lead = _lead(offers[leader], travel)
    place = lead.legs[-1].arrival
    first_m = _without_near(_pose_of(offers[leader]), lead.legs[0].waypoints_m, near_m)
    later_m = tuple(chain.from_iterable(leg.waypoints_m for leg in lead.legs[1:]))
    ways = [_way(_pose_of(offer), (*first_m, *later_m), place, travel.motion) for offer in offers]
    corner_s = departure_s + max(way.first_s for way in ways)
    ends_s = corner_s + ways[leader].leg.duration_s - ways[leader].first_s + _ROUNDING_S
    parts = []
    for index, (offer, way) in enumerate(zip(offers, ways, strict=True)):
        pose, begins_s = _pose_of(offer), corner_s - way.first_s
        if index != leader:
            agreed = AgreedLeg(pose, way.leg, begins_s, ends_s)
            parts.append(_part(offer, agreed, place, ends_s, _extra_s(offer, place, travel)))
        else:
            own = _way(pose, first_m, lead.legs[0].arrival, travel.motion).leg
            agreed = AgreedLeg(pose, own, begins_s, -math.inf if later_m else ends_s)
            parts.append(_part(offer, agreed, place, ends_s + lead.busy_s, 0.0, lead.steps))
    return tuple(parts)


def contraction(
    offers: Sequence[MemberOffer],
    approaches: Approaches,
    departure_s: float,
    travel: TravelTimes,
) -> tuple[Part, ...]:
    """Return everybody's part when the outermost go to those next to them, and all others stay.

    If approaches don't link all members, all go to the first's place, as directly as they can.

    Args:
        offers: all members'.
        approaches: who may go to whom.
        departure_s: when the present meeting ends.
        travel: as for ``turn``.
    """
    poses = [_pose_of(offer) for offer in offers]
    ends = [poses[parent] for parent in _parents(approaches.linked(poses))]
    legs = []
    for pose, end in zip(poses, ends, strict=True):
        corners_m = approaches.corners_m(pose, end)
        as_directly_m = ((end.x_m, end.y_m),) if corners_m is None else corners_m
        legs.append(_way(pose, as_directly_m, _arrival(pose, as_directly_m), travel.motion).leg)
    ends_s = departure_s + max(leg.duration_s for leg in legs) + _ROUNDING_S
    return tuple(
        _part(
            offer,
            AgreedLeg(pose, leg, departure_s, ends_s),
            leg.arrival,
            ends_s,
            _extra_s(offer, leg.arrival, travel),
        )
        for offer, pose, leg in zip(offers, poses, legs, strict=True)
    )


def _parents(linked: NDArray[np.bool_]) -> list[int]:
    """Return where each goes: the outermost to their parents, the others to themselves."""
    hops = shortest_path(linked.astype(np.float64), directed=False, unweighted=True)
    if not np.isfinite(hops).all():
        return [0] * len(linked)
    depth = hops[int(np.argmin(hops.max(axis=0)))]
    outermost = depth == depth.max()
    nearer = linked & (depth[np.newaxis] == depth[:, np.newaxis] - 1.0)
    return [
        int(np.argmax(nearer[agent])) if outermost[agent] else agent for agent in range(len(linked))
    ]


@dataclass(frozen=True, slots=True)
class _Lead:
    """What a leader does: the ways to its next stops, and how long it is busy at the last."""

    legs: tuple[Leg, ...]
    steps: int
    busy_s: float


@dataclass(frozen=True, slots=True)
class _Way:
    """A leg, and how long the turn and the straight to its first corner take."""

    leg: Leg
    first_s: float


def _lead(offer: MemberOffer, travel: TravelTimes) -> _Lead:
    """Return the way to the first stop that takes time, if there is one, or else to the next."""
    pose, travel_s, legs = _pose_of(offer), 0.0, list[Leg]()
    for stop in offer.stops:
        target = travel.grid.location_at(stop.x_m, stop.y_m)
        if target is None or not travel.grid.leads(pose.x_m, pose.y_m, target):
            break
        legs.append(travel.leg_to(pose, target))
        pose, travel_s = legs[-1].arrival, travel_s + legs[-1].duration_s
        busy_s = stop.finish_offset_s - travel_s
        if busy_s > _INSTANT_S:
            return _Lead(tuple(legs), len(legs), busy_s)
    if not legs:
        return _Lead((Leg((), 0.0, 0.0, pose),), 0, 0.0)
    return _Lead((legs[0],), 1, 0.0)


def _arrival(start: Pose, corners_m: Corners) -> Pose:
    """Return the pose in which a way over corners ends."""
    if not corners_m:
        return start
    from_m, to_m = ((start.x_m, start.y_m), *corners_m)[-2:]
    return Pose(*to_m, math.atan2(to_m[1] - from_m[1], to_m[0] - from_m[0]))


def _without_near(start: Pose, corners_m: Corners, near_m: float) -> Corners:
    """Return the corners of a way from the first on that isn't near its start, or the last."""
    ahead = dropwhile(lambda corner_m: start.distance_m(*corner_m) <= near_m, corners_m)
    return tuple(ahead) or corners_m[-1:]


def _way(start: Pose, corners_m: Corners, arrival: Pose, motion: Motion) -> _Way:
    """Return the way over corners: a turn and a straight to each."""
    x_m, y_m, yaw_rad = start.x_m, start.y_m, start.yaw_rad
    drives_s: list[float] = []
    length_m = 0.0
    for to_x_m, to_y_m in corners_m:
        ahead_rad = math.atan2(to_y_m - y_m, to_x_m - x_m)
        straight_m = math.dist((x_m, y_m), (to_x_m, to_y_m))
        turned_s = abs(wrap_angle(ahead_rad - yaw_rad)) / motion.angular_radps
        allowed_s = _SEGMENTS * motion.segment_allowance_s
        drives_s.append(turned_s + straight_m / motion.linear_mps + allowed_s)
        length_m += straight_m
        x_m, y_m, yaw_rad = to_x_m, to_y_m, ahead_rad
    return _Way(Leg(corners_m, sum(drives_s), length_m, arrival), sum(drives_s[:1]))


def _extra_s(offer: MemberOffer, place: Pose, travel: TravelTimes) -> float:
    """Return δ: what going by a place adds to the way to the own next stop; 0 if there is none."""
    pose, stop, grid = _pose_of(offer), offer.stops[0], travel.grid
    here, following = (grid.location_at(own.x_m, own.y_m) for own in (place, stop))
    if here is None or following is None:
        return 0.0
    if not all(grid.leads(pose.x_m, pose.y_m, location) for location in (here, following)):
        return 0.0
    return float(travel.detour(pose, following).extra_s[here])


def _part(
    offer: MemberOffer,
    way: AgreedLeg,
    place: Pose,
    ready_s: float,
    extra_s: float,
    steps: int = 0,
) -> Part:
    strategy = Strategy(
        agent=offer.agent,
        x_m=place.x_m,
        y_m=place.y_m,
        task_index=max(0, offer.stops[0].task_index - 1 + steps),
        arrival_s=ready_s,
        extra_travel_s=extra_s,
    )
    return Part(way, strategy, steps)


def _pose_of(offer: MemberOffer) -> Pose:
    return Pose(offer.x_m, offer.y_m, offer.yaw_rad)
