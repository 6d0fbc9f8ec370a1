"""What agents say to each other, as messages and as values, one to one and lossless.

``team_types``       the type of each topic that agents talk on
``topic_of``         the topic on which something is said
``encode_message``   what the agent says
``decode_message``   what another agent says, validated
``encode_strategy``  one agent's part in a team strategy
"""

import math
from collections.abc import Mapping
from types import MappingProxyType
from typing import Any, Final

from geometry_msgs.msg import Point

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
)
from tlcomm_core.game.offer import MAX_STOPS, MemberOffer, PlannedStop
from tlcomm_core.game.strategy import Strategy
from tlcomm_core.protocol.messages import (
    BestResponse,
    Confirmation,
    EstimateExchange,
    Measurement,
    PlanOffer,
    Proposal,
    TeamMessage,
)
from tlcomm_msgs import msg

__all__ = ["decode_message", "encode_message", "encode_strategy", "team_types", "topic_of"]

_ROUND_TYPES: Final[Mapping[str, Any]] = MappingProxyType(
    {
        "plan_offer": msg.PlanOffer,
        "proposal": msg.Proposal,
        "best_response": msg.BestResponse,
        "confirmation": msg.Confirmation,
    }
)
_FIELD_TYPES: Final[Mapping[str, Any]] = MappingProxyType(
    {"estimate_exchange": msg.EstimateExchange}
)
_TOPICS: Final[Mapping[type[TeamMessage], str]] = MappingProxyType(
    {
        PlanOffer: "plan_offer",
        Proposal: "proposal",
        BestResponse: "best_response",
        Confirmation: "confirmation",
        EstimateExchange: "estimate_exchange",
    }
)

# Generated messages are opaque: what matters is checked here, field by field.
_RosMessage = Any


def team_types(*, measures: bool) -> Mapping[str, Any]:
    """Return the type of each topic that agents talk on; ``measures``: if there is a field."""
    return {**_ROUND_TYPES, **_FIELD_TYPES} if measures else _ROUND_TYPES


def topic_of(message: TeamMessage) -> str:
    """Return the topic on which something is said."""
    return _TOPICS[type(message)]


def encode_message(message: TeamMessage, stamp_ns: int) -> _RosMessage:
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
                strategies=[encode_strategy(own) for own in message.strategies],
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
                strategy=encode_strategy(message.strategy),
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
        case EstimateExchange():
            return msg.EstimateExchange(
                header=header(stamp_ns),
                sender=message.sender,
                step=message.step,
                neighbours=message.neighbours,
                asks=message.asks,
                value=message.value,
                known=[
                    msg.Measurement(agent=each.agent, value=each.value, stamp=each.time_ns)
                    for each in message.known
                ],
            )


def decode_message(message: _RosMessage) -> tuple[TeamMessage, int]:
    """Return what another agent says, and when it said it (ns).

    Args:
        message: of one of ``team_types``.

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
        case msg.EstimateExchange():
            return EstimateExchange(
                sender=sender,
                step=message.step,
                neighbours=message.neighbours,
                asks=message.asks,
                value=finite(message.value, "value"),
                known=tuple(
                    _decode_measurement(each)
                    for each in bounded(message.known, MAX_AGENTS, "known")
                ),
            ), sent_ns
        case _:
            raise WireError(f"type {type(message).__name__!r} isn't one that agents talk in")


def encode_strategy(strategy: Strategy) -> _RosMessage:
    """Return one agent's part in a team strategy."""
    return msg.Strategy(
        agent=strategy.agent,
        location=Point(x=strategy.x_m, y=strategy.y_m),
        task_index=strategy.task_index,
        arrival_time=strategy.arrival_s,
        extra_travel=strategy.extra_travel_s,
    )


def _decode_measurement(measurement: _RosMessage) -> Measurement:
    return Measurement(
        agent=name(measurement.agent, "known.agent"),
        value=finite(measurement.value, "known.value"),
        time_ns=measurement.stamp,
    )


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


def _decode_strategy(strategy: _RosMessage) -> Strategy:
    return Strategy(
        agent=name(strategy.agent, "strategy.agent"),
        x_m=finite(strategy.location.x, "strategy.location.x"),
        y_m=finite(strategy.location.y, "strategy.location.y"),
        task_index=strategy.task_index,
        arrival_s=finite(strategy.arrival_time, "strategy.arrival_time"),
        extra_travel_s=finite(strategy.extra_travel, "strategy.extra_travel"),
    )
