"""What agents say, are told and command, from messages as a bag's decoder returns them.

``read_team_message``  what an agent says, from any of the topics that agents talk on
``read_command``       a velocity command
``read_map``           which cells are free
``read_reading``       what an agent measures

They need no ROS. All numbers are finite, but for bounds where nothing is proven.
"""

import math
from typing import Final

import numpy as np
from numpy.typing import NDArray

from tlcomm_core.agent.actions import Drive
from tlcomm_core.errors import InputError
from tlcomm_core.game.offer import MemberOffer, PlannedStop
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
from tlcomm_core.world.observation import Reading
from tlcomm_tools.wire import DecodedMessage, read_strategy, stamp_ns

__all__ = ["read_command", "read_map", "read_reading", "read_team_message"]

# As agents read it: as likely occupied as not counts as occupied, and so does what isn't known.
_OCCUPIED: Final = 50


def read_team_message(message: DecodedMessage, topic: str) -> TeamMessage:
    """Read what an agent says.

    Args:
        message: of the topic's type.
        topic: one of ``TEAM_TOPICS``.

    Raises:
        InputError: a number isn't finite.
    """
    match topic:
        case "plan_offer":
            return _read_plan_offer(message)
        case "proposal":
            return _read_proposal(message)
        case "best_response":
            return _read_best_response(message)
        case "confirmation":
            return _read_confirmation(message)
        case _:
            return _read_estimate_exchange(message)


def read_command(message: DecodedMessage) -> Drive:
    """Read a ``geometry_msgs/TwistStamped``."""
    return Drive(message.twist.linear.x, message.twist.angular.z)


def read_map(message: DecodedMessage) -> NDArray[np.bool_]:
    """Read a ``nav_msgs/OccupancyGrid``: which cells are free, bool[rows, columns].

    Raises:
        InputError: it hasn't as many cells as it says.
    """
    rows, columns = message.info.height, message.info.width
    cells = np.asarray(message.data, dtype=np.int8)
    if cells.size != rows * columns:
        raise InputError(f"a map of {columns} x {rows} cells has {cells.size} of them")
    cells = cells.reshape(rows, columns)
    return (cells >= 0) & (cells < _OCCUPIED)


def read_reading(message: DecodedMessage) -> Reading:
    """Read a ``tlcomm_msgs/Reading``.

    Raises:
        InputError: the value isn't finite.
    """
    time_ns, value = stamp_ns(message.header.stamp), _finite(message.value, "value")
    return Reading(time_ns, message.agent, message.region, value)


def _read_plan_offer(message: DecodedMessage) -> PlanOffer:
    return PlanOffer(
        sender=message.sender,
        round=message.round,
        known=tuple(message.known),
        offers=tuple(map(_read_offer, message.offers)),
    )


def _read_proposal(message: DecodedMessage) -> Proposal:
    bound_s = message.bound
    return Proposal(
        sender=message.sender,
        round=message.round,
        iteration=message.iteration,
        hop=message.hop,
        candidate=message.candidate,
        potential_s=_finite(message.potential, "potential"),
        bound_s=bound_s if bound_s == -math.inf else _finite(bound_s, "bound"),
        strategies=tuple(map(_read_finite_strategy, message.strategies)),
    )


def _read_best_response(message: DecodedMessage) -> BestResponse:
    return BestResponse(
        sender=message.sender,
        round=message.round,
        iteration=message.iteration,
        hop=message.hop,
        candidate=message.candidate,
        change_s=_finite(message.change, "change"),
        strategy=_read_finite_strategy(message.strategy),
    )


def _read_confirmation(message: DecodedMessage) -> Confirmation:
    return Confirmation(
        sender=message.sender,
        round=message.round,
        iteration=message.iteration,
        digest=message.digest,
        confirmed=tuple(message.confirmed),
    )


def _read_estimate_exchange(message: DecodedMessage) -> EstimateExchange:
    return EstimateExchange(
        sender=message.sender,
        step=message.step,
        neighbours=message.neighbours,
        asks=message.asks,
        value=_finite(message.value, "value"),
        known=tuple(
            Measurement(each.agent, _finite(each.value, "known.value"), each.stamp)
            for each in message.known
        ),
    )


def _read_offer(offer: DecodedMessage) -> MemberOffer:
    columns = (offer.task_index, offer.stop_x, offer.stop_y, offer.stop_heading)
    rows = zip(*(list(column) for column in (*columns, offer.finish_offset)), strict=True)
    return MemberOffer(
        agent=offer.agent,
        arrival_s=_finite(offer.arrival_time, "offers.arrival_time"),
        x_m=_finite(offer.position.x, "offers.position.x"),
        y_m=_finite(offer.position.y, "offers.position.y"),
        yaw_rad=_finite(offer.heading, "offers.heading"),
        linear_mps=_finite(offer.linear_speed, "offers.linear_speed"),
        angular_radps=_finite(offer.angular_speed, "offers.angular_speed"),
        stops=tuple(_read_stop(index, *values) for index, *values in rows),
        avoided=tuple(offer.forbidden),
        map_ns=offer.map_stamp,
    )


def _read_stop(index: int, x_m: float, y_m: float, yaw_rad: float, offset_s: float) -> PlannedStop:
    values = (_finite(float(value), "offers.stops") for value in (x_m, y_m, yaw_rad, offset_s))
    return PlannedStop(int(index), *values)


def _read_finite_strategy(message: DecodedMessage) -> Strategy:
    strategy = read_strategy(message)
    for value in (strategy.x_m, strategy.y_m, strategy.arrival_s, strategy.extra_travel_s):
        _finite(value, "strategy")
    return strategy


def _finite(value: float, field: str) -> float:
    if not math.isfinite(value):
        raise InputError(f"{field}: {value!r} isn't finite")
    return value
