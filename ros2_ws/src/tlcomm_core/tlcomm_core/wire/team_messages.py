"""What agents say to each other, as values.

``decode_message``  what an agent says, validated
``decode_offer``    one agent's part in a plan offer
"""

import math
from collections.abc import Callable, Mapping
from types import MappingProxyType
from typing import Any, Final

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
from tlcomm_core.wire.fields import (
    MAX_AGENTS,
    WireError,
    bound,
    bounded,
    decode_stamp,
    finite,
    name,
    names,
)

__all__ = ["decode_message", "decode_offer"]

# Whoever made the message made its classes: what matters is checked here, field by field.
_Message = Any


def decode_message(message: _Message, topic: str) -> tuple[TeamMessage, int]:
    """Return what an agent says, and when it said it (ns).

    Args:
        message: of the topic's type.
        topic: one of ``TEAM_TOPICS``.

    Raises:
        WireError: a field is out of its range.
    """
    sent_ns = decode_stamp(message.header.stamp)
    return _DECODERS[topic](message, name(message.sender, "sender")), sent_ns


def decode_offer(offer: _Message) -> MemberOffer:
    """Return one agent's part in a plan offer.

    Raises:
        WireError: a field is out of its range.
    """
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


def _decode_plan_offer(message: _Message, sender: str) -> PlanOffer:
    return PlanOffer(
        sender=sender,
        round=message.round,
        known=names(message.known, "known"),
        offers=tuple(map(decode_offer, bounded(message.offers, MAX_AGENTS, "offers"))),
    )


def _decode_proposal(message: _Message, sender: str) -> Proposal:
    strategies = bounded(message.strategies, MAX_AGENTS, "strategies")
    return Proposal(
        sender=sender,
        round=message.round,
        iteration=message.iteration,
        hop=message.hop,
        candidate=name(message.candidate, "candidate"),
        potential_s=finite(message.potential, "potential"),
        bound_s=bound(message.bound),
        strategies=tuple(map(_decode_strategy, strategies)),
    )


def _decode_best_response(message: _Message, sender: str) -> BestResponse:
    return BestResponse(
        sender=sender,
        round=message.round,
        iteration=message.iteration,
        hop=message.hop,
        candidate=name(message.candidate, "candidate"),
        change_s=finite(message.change, "change"),
        strategy=_decode_strategy(message.strategy),
    )


def _decode_confirmation(message: _Message, sender: str) -> Confirmation:
    return Confirmation(
        sender=sender,
        round=message.round,
        iteration=message.iteration,
        digest=message.digest,
        confirmed=names(message.confirmed, "confirmed"),
    )


def _decode_estimate_exchange(message: _Message, sender: str) -> EstimateExchange:
    return EstimateExchange(
        sender=sender,
        step=message.step,
        neighbours=message.neighbours,
        asks=message.asks,
        value=finite(message.value, "value"),
        known=tuple(map(_decode_measurement, bounded(message.known, MAX_AGENTS, "known"))),
    )


_DECODERS: Final[Mapping[str, Callable[[_Message, str], TeamMessage]]] = MappingProxyType(
    {
        "plan_offer": _decode_plan_offer,
        "proposal": _decode_proposal,
        "best_response": _decode_best_response,
        "confirmation": _decode_confirmation,
        "estimate_exchange": _decode_estimate_exchange,
    }
)


def _decode_measurement(measurement: _Message) -> Measurement:
    return Measurement(
        agent=name(measurement.agent, "known.agent"),
        value=finite(measurement.value, "known.value"),
        time_ns=measurement.stamp,
    )


def _decode_stops(offer: _Message) -> tuple[PlannedStop, ...]:
    columns = (
        bounded(offer.task_index, MAX_STOPS, "offers.task_index").tolist(),
        offer.stop_x.tolist(),
        offer.stop_y.tolist(),
        offer.stop_heading.tolist(),
        offer.finish_offset.tolist(),
    )
    if len({len(column) for column in columns}) > 1:
        raise WireError(f"offers: columns of {[len(column) for column in columns]} stops")
    if not all(math.isfinite(value) for column in columns[1:] for value in column):
        raise WireError("offers: a stop has a number that isn't finite")
    return tuple(PlannedStop(*row) for row in zip(*columns, strict=True))


def _decode_strategy(strategy: _Message) -> Strategy:
    return Strategy(
        agent=name(strategy.agent, "strategy.agent"),
        x_m=finite(strategy.location.x, "strategy.location.x"),
        y_m=finite(strategy.location.y, "strategy.location.y"),
        task_index=strategy.task_index,
        arrival_s=finite(strategy.arrival_time, "strategy.arrival_time"),
        extra_travel_s=finite(strategy.extra_travel, "strategy.extra_travel"),
    )
