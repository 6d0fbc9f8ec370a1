"""What agents say to each other, as messages; ``tlcomm_core.wire`` reads them, without loss.

``team_types``       the type of each topic that agents talk on
``encode_message``   what the agent says
``encode_strategy``  one agent's part in a team strategy
"""

from collections.abc import Mapping
from types import MappingProxyType
from typing import Any, Final

from geometry_msgs.msg import Point

from tlcomm_agent.wire_fields import header
from tlcomm_core.game.offer import MemberOffer
from tlcomm_core.game.strategy import Strategy
from tlcomm_core.protocol.messages import (
    BestResponse,
    Confirmation,
    EstimateExchange,
    PlanOffer,
    Proposal,
    TeamMessage,
)
from tlcomm_msgs import msg

__all__ = ["encode_message", "encode_strategy", "team_types"]

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

# Generated messages are opaque.
_RosMessage = Any


def team_types(*, measures: bool) -> Mapping[str, Any]:
    """Return the type of each topic that agents talk on; ``measures``: if there is a field."""
    return {**_ROUND_TYPES, **_FIELD_TYPES} if measures else _ROUND_TYPES


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


def encode_strategy(strategy: Strategy) -> _RosMessage:
    """Return one agent's part in a team strategy."""
    return msg.Strategy(
        agent=strategy.agent,
        location=Point(x=strategy.x_m, y=strategy.y_m),
        task_index=strategy.task_index,
        arrival_time=strategy.arrival_s,
        extra_travel=strategy.extra_travel_s,
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
