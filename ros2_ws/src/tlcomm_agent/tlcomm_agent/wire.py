"""An agent's messages and the core's values, one to one and lossless.

``TEAM_TYPES``         the type of each topic that agents talk on
``TYPES``              the type of each topic that an agent publishes
``encode_action``      what the agent does, of ``PublishedAction``
``encode_message``     what the agent says
``decode_message``     what another agent says, validated
``encode_drive``, ``encode_task_event``, ``encode_team_strategy``, ``encode_round_timing``,
``encode_undelivered`` the rest of what it publishes
``decode_odometry``    where the agent is
``decode_neighbours``  who is in range of one agent, and how far away, of ``Connectivity``
"""

import math
from collections.abc import Mapping
from types import MappingProxyType
from typing import Any, Final

from geometry_msgs.msg import Point, TwistStamped

from tlcomm_agent.wire_fields import (
    MAX_AGENTS,
    WireError,
    bound,
    bounded,
    decode_stamp,
    finite,
    header,
    name,
    names,
    time,
)
from tlcomm_core.agent.actions import Drive, ReportTask, TaskEvent
from tlcomm_core.agent.timing import RoundTiming
from tlcomm_core.game.offer import MAX_STOPS, MemberOffer, PlannedStop
from tlcomm_core.game.strategy import Strategy, TeamStrategy
from tlcomm_core.geometry import Pose, yaw_from_quaternion
from tlcomm_core.protocol.actions import HoldStrategy, SendMessage
from tlcomm_core.protocol.messages import (
    BestResponse,
    Confirmation,
    Message,
    PlanOffer,
    Proposal,
)
from tlcomm_core.units import NANOSECONDS_PER_SECOND
from tlcomm_core.world.observation import Odometry
from tlcomm_msgs import msg

__all__ = [
    "TEAM_TYPES",
    "TYPES",
    "PublishedAction",
    "decode_message",
    "decode_neighbours",
    "decode_odometry",
    "encode_action",
    "encode_drive",
    "encode_message",
    "encode_round_timing",
    "encode_task_event",
    "encode_team_strategy",
    "encode_undelivered",
]

TEAM_TYPES: Final[Mapping[str, Any]] = MappingProxyType(
    {
        "plan_offer": msg.PlanOffer,
        "proposal": msg.Proposal,
        "best_response": msg.BestResponse,
        "confirmation": msg.Confirmation,
    }
)
TYPES: Final[Mapping[str, Any]] = MappingProxyType(
    {
        "cmd_vel": TwistStamped,
        **TEAM_TYPES,
        "task_event": msg.TaskEvent,
        "team_strategy": msg.TeamStrategy,
        "round_timing": msg.RoundTiming,
        "undelivered": msg.Undelivered,
        # Nothing is estimated yet, but the topic is there for those who look for it.
        "estimate": msg.Estimate,
    }
)
PublishedAction = Drive | SendMessage | ReportTask | HoldStrategy

_TEAM_TOPICS: Final[Mapping[type[Message], str]] = MappingProxyType(
    {
        PlanOffer: "plan_offer",
        Proposal: "proposal",
        BestResponse: "best_response",
        Confirmation: "confirmation",
    }
)

# Generated messages are opaque: what matters is checked here, field by field.
_RosMessage = Any


def encode_action(action: PublishedAction, agent: str, stamp_ns: int) -> tuple[str, _RosMessage]:
    """Return the topic and the message that an action is, when ``agent`` takes it."""
    match action:
        case Drive():
            return "cmd_vel", encode_drive(action, agent, stamp_ns)
        case SendMessage(message):
            return _TEAM_TOPICS[type(message)], encode_message(message, stamp_ns)
        case ReportTask(event):
            return "task_event", encode_task_event(event, agent, stamp_ns)
        case HoldStrategy(strategy):
            return "team_strategy", encode_team_strategy(strategy, stamp_ns)


def encode_message(message: Message, stamp_ns: int) -> _RosMessage:
    """Return what an agent says as the message for its topic.

    Args:
        message: what it says.
        stamp_ns: when.
    """
    match message:
        case PlanOffer():
            return msg.PlanOffer(
                header=header(stamp_ns),
                sender=message.sender,
                round=message.round,
                known=list(message.known),
                offers=[_encode_offer(offer) for offer in message.offers],
            )
        case Proposal():
            return msg.Proposal(
                header=header(stamp_ns),
                sender=message.sender,
                round=message.round,
                iteration=message.iteration,
                hop=message.hop,
                candidate=message.candidate,
                potential=message.potential_s,
                bound=message.bound_s,
                strategies=[_encode_strategy(own) for own in message.strategies],
            )
        case BestResponse():
            return msg.BestResponse(
                header=header(stamp_ns),
                sender=message.sender,
                round=message.round,
                iteration=message.iteration,
                hop=message.hop,
                candidate=message.candidate,
                change=message.change_s,
                strategy=_encode_strategy(message.strategy),
            )
        case Confirmation():
            return msg.Confirmation(
                header=header(stamp_ns),
                sender=message.sender,
                round=message.round,
                iteration=message.iteration,
                digest=message.digest,
                confirmed=list(message.confirmed),
            )


def decode_message(message: _RosMessage) -> tuple[Message, int]:
    """Return what another agent says, and when it said it (ns).

    Args:
        message: of one of ``TEAM_TYPES``.

    Raises:
        WireError: a field is out of its range.
    """
    sent_ns = decode_stamp(message.header.stamp)
    sender = name(message.sender, "sender")
    match message:
        case msg.PlanOffer():
            return PlanOffer(
                sender=sender,
                round=message.round,
                known=names(message.known, "known"),
                offers=tuple(
                    _decode_offer(offer) for offer in bounded(message.offers, MAX_AGENTS, "offers")
                ),
            ), sent_ns
        case msg.Proposal():
            return Proposal(
                sender=sender,
                round=message.round,
                iteration=message.iteration,
                hop=message.hop,
                candidate=name(message.candidate, "candidate"),
                potential_s=finite(message.potential, "potential"),
                bound_s=bound(message.bound),
                strategies=tuple(
                    _decode_strategy(own)
                    for own in bounded(message.strategies, MAX_AGENTS, "strategies")
                ),
            ), sent_ns
        case msg.BestResponse():
            return BestResponse(
                sender=sender,
                round=message.round,
                iteration=message.iteration,
                hop=message.hop,
                candidate=name(message.candidate, "candidate"),
                change_s=finite(message.change, "change"),
                strategy=_decode_strategy(message.strategy),
            ), sent_ns
        case msg.Confirmation():
            return Confirmation(
                sender=sender,
                round=message.round,
                iteration=message.iteration,
                digest=message.digest,
                confirmed=names(message.confirmed, "confirmed"),
            ), sent_ns
        case _:
            raise WireError(f"type {type(message).__name__!r} isn't one that agents talk in")


def encode_drive(drive: Drive, agent: str, stamp_ns: int) -> TwistStamped:
    """Return a velocity command, in the frame that moves in the agent's odometry."""
    message = TwistStamped(header=header(stamp_ns, f"{agent}/base_link"))
    message.twist.linear.x = drive.linear_mps
    message.twist.angular.z = drive.angular_radps
    return message


def encode_task_event(event: TaskEvent, agent: str, stamp_ns: int) -> _RosMessage:
    """Return what an agent did."""
    return msg.TaskEvent(
        header=header(stamp_ns),
        agent=agent,
        kind=int(event.kind),
        region=event.region,
        action=event.action,
        round=event.round,
        plan_index=event.plan_index,
        detail=event.detail,
    )


def encode_team_strategy(strategy: TeamStrategy, stamp_ns: int) -> _RosMessage:
    """Return the strategy that an agent holds as agreed."""
    return msg.TeamStrategy(
        header=header(stamp_ns),
        round=strategy.round,
        iteration=strategy.iteration,
        strategies=[_encode_strategy(own) for own in strategy.strategies],
        communication_time=strategy.communication_s,
        potential=strategy.potential_s,
        initial_potential=strategy.initial_potential_s,
        bound=-math.inf if strategy.bound_s is None else strategy.bound_s,
    )


def encode_round_timing(timing: RoundTiming, stamp_ns: int) -> _RosMessage:
    """Return what agreeing took; wall times to the nanosecond, finer than today's floats are."""
    return msg.RoundTiming(
        header=header(stamp_ns),
        agent=timing.agent,
        round=timing.round,
        solve_wall=timing.solve_wall_s,
        offered_at=time(_wall_ns(timing.offered_wall_s)),
        agreed_at=time(_wall_ns(timing.agreed_wall_s)),
    )


def encode_undelivered(counts: Mapping[str, int], agent: str, stamp_ns: int) -> _RosMessage:
    """Return how many messages an agent's radio hasn't let through, by reason."""
    return msg.Undelivered(
        header=header(stamp_ns), agent=agent, reasons=list(counts), counts=list(counts.values())
    )


def decode_odometry(message: _RosMessage, agent: str) -> Odometry:
    """Return where an agent is and how it moves.

    Raises:
        WireError: a number that isn't finite, or a malformed stamp.
    """
    place, turn = message.pose.pose.position, message.pose.pose.orientation
    twist = message.twist.twist
    return Odometry(
        stamp_ns=decode_stamp(message.header.stamp),
        agent=agent,
        pose=Pose(
            finite(place.x, "position.x"),
            finite(place.y, "position.y"),
            yaw_from_quaternion(finite(turn.z, "orientation.z"), finite(turn.w, "orientation.w")),
        ),
        linear_mps=finite(twist.linear.x, "linear.x"),
        angular_radps=finite(twist.angular.z, "angular.z"),
    )


def decode_neighbours(message: _RosMessage, agent: str) -> tuple[dict[str, float], int]:
    """Return how far away those are that are in range of an agent, and since when (ns).

    Where distances aren't given, they are taken to be the range.

    Raises:
        WireError: the agent isn't listed, an edge leads nowhere, or has no proper distance.
    """
    agents, ends = names(message.agents, "agents"), message.edges
    if agent not in agents:
        raise WireError(f"agents: {agent!r} isn't among {len(agents)} names")
    if len(ends) % 2 or any(end >= len(agents) for end in ends):
        raise WireError(f"edges: not pairs of indices below {len(agents)}")
    pairs = list(zip(ends[::2], ends[1::2], strict=True))
    lengths_m = message.distances or [message.range] * len(pairs)
    if len(lengths_m) != len(pairs):
        raise WireError(f"distances: {len(lengths_m)} of {len(pairs)} pairs")
    own = agents.index(agent)
    return {
        agents[i + j - own]: finite(length_m, "distances")
        for (i, j), length_m in zip(pairs, lengths_m, strict=True)
        if own in {i, j}
    }, decode_stamp(message.header.stamp)


def _encode_offer(offer: MemberOffer) -> _RosMessage:
    stops = offer.stops
    return msg.MemberOffer(
        agent=offer.agent,
        arrival_time=offer.arrival_s,
        position=Point(x=offer.x_m, y=offer.y_m),
        heading=offer.yaw_rad,
        linear_speed=offer.linear_mps,
        angular_speed=offer.angular_radps,
        forbidden=list(offer.avoided),
        map_stamp=offer.map_ns,
        task_index=[stop.task_index for stop in stops],
        stop_x=[stop.x_m for stop in stops],
        stop_y=[stop.y_m for stop in stops],
        stop_heading=[stop.yaw_rad for stop in stops],
        finish_offset=[stop.finish_offset_s for stop in stops],
    )


def _decode_offer(offer: _RosMessage) -> MemberOffer:
    return MemberOffer(
        agent=name(offer.agent, "offers.agent"),
        arrival_s=finite(offer.arrival_time, "offers.arrival_time"),
        x_m=finite(offer.position.x, "offers.position.x"),
        y_m=finite(offer.position.y, "offers.position.y"),
        yaw_rad=finite(offer.heading, "offers.heading"),
        linear_mps=finite(offer.linear_speed, "offers.linear_speed"),
        angular_radps=finite(offer.angular_speed, "offers.angular_speed"),
        stops=_decode_stops(offer),
        avoided=names(offer.forbidden, "offers.forbidden"),
        map_ns=offer.map_stamp,
    )


def _decode_stops(offer: _RosMessage) -> tuple[PlannedStop, ...]:
    columns = (
        bounded(offer.task_index, MAX_STOPS, "offers.task_index"),
        offer.stop_x,
        offer.stop_y,
        offer.stop_heading,
        offer.finish_offset,
    )
    if len({len(column) for column in columns}) > 1:
        raise WireError(f"offers: columns of {[len(column) for column in columns]} stops")
    if not all(math.isfinite(value) for column in columns[1:] for value in column):
        raise WireError("offers: a stop has a number that isn't finite")
    return tuple(PlannedStop(*row) for row in zip(*columns, strict=True))


def _encode_strategy(strategy: Strategy) -> _RosMessage:
    return msg.Strategy(
        agent=strategy.agent,
        location=Point(x=strategy.x_m, y=strategy.y_m),
        task_index=strategy.task_index,
        arrival_time=strategy.arrival_s,
        extra_travel=strategy.extra_travel_s,
    )


def _decode_strategy(strategy: _RosMessage) -> Strategy:
    return Strategy(
        agent=name(strategy.agent, "strategy.agent"),
        x_m=finite(strategy.location.x, "strategy.location.x"),
        y_m=finite(strategy.location.y, "strategy.location.y"),
        task_index=strategy.task_index,
        arrival_s=finite(strategy.arrival_time, "strategy.arrival_time"),
        extra_travel_s=finite(strategy.extra_travel, "strategy.extra_travel"),
    )


def _wall_ns(time_s: float) -> int:
    whole_s = int(time_s)
    return whole_s * NANOSECONDS_PER_SECOND + round((time_s - whole_s) * NANOSECONDS_PER_SECOND)
