"""Messages as a bag's decoder returns them, turned into the core's values.

``DecodedMessage``      any object with a message's fields
``read_odometry``, ``read_connectivity``, ``read_task_event``, ``read_team_strategy``,
``read_round_timing``, ``read_estimate``, ``read_undelivered``, ``read_hearing``  one per recorded
type that results are computed from
``read_strategy``       one agent's part in a team strategy
``stamp_ns``            a time

They need no ROS.
"""

import math
from typing import Any

import numpy as np

from tlcomm_core.agent.actions import TaskEvent, TaskEventKind
from tlcomm_core.agent.timing import RoundTiming
from tlcomm_core.game.strategy import Strategy, TeamStrategy
from tlcomm_core.geometry import Pose, yaw_from_quaternion
from tlcomm_core.protocol.topics import TEAM_TOPICS
from tlcomm_core.records import EstimateRecord, HeardRecord, StrategyRecord, TaskRecord
from tlcomm_core.units import NANOSECONDS_PER_SECOND, seconds
from tlcomm_core.world.observation import Connectivity, Odometry

__all__ = [
    "DecodedMessage",
    "read_connectivity",
    "read_estimate",
    "read_hearing",
    "read_odometry",
    "read_round_timing",
    "read_strategy",
    "read_task_event",
    "read_team_strategy",
    "read_undelivered",
    "stamp_ns",
]

# Decoders make the classes as they read a file's definitions.
DecodedMessage = Any


def read_odometry(message: DecodedMessage, agent: str) -> Odometry:
    """Read a ``nav_msgs/Odometry`` of this agent."""
    place, turn = message.pose.pose.position, message.pose.pose.orientation
    twist = message.twist.twist
    return Odometry(
        stamp_ns=stamp_ns(message.header.stamp),
        agent=agent,
        pose=Pose(place.x, place.y, yaw_from_quaternion(turn.z, turn.w)),
        linear_mps=twist.linear.x,
        angular_radps=twist.angular.z,
    )


def read_connectivity(message: DecodedMessage) -> Connectivity:
    """Read a ``tlcomm_msgs/Connectivity``; older ones have no distances."""
    ends = [int(end) for end in message.edges]
    if len(ends) % 2:
        raise ValueError(f"the {len(ends)} ends of edges aren't pairs")
    return Connectivity(
        stamp_ns=stamp_ns(message.header.stamp),
        edges=tuple(zip(ends[::2], ends[1::2], strict=True)),
        connected=message.connected,
        distances_m=tuple(float(distance) for distance in getattr(message, "distances", ())),
    )


def read_task_event(message: DecodedMessage) -> TaskRecord:
    """Read a ``tlcomm_msgs/TaskEvent``."""
    event = TaskEvent(
        kind=TaskEventKind(message.kind),
        region=message.region,
        action=message.action,
        round=message.round,
        plan_index=message.plan_index,
        detail=message.detail,
    )
    return TaskRecord(stamp_ns(message.header.stamp), message.agent, event)


def read_team_strategy(message: DecodedMessage, agent: str) -> StrategyRecord:
    """Read a ``tlcomm_msgs/TeamStrategy`` that this agent holds."""
    strategy = TeamStrategy(
        round=message.round,
        iteration=message.iteration,
        strategies=tuple(read_strategy(own) for own in message.strategies),
        communication_s=message.communication_time,
        potential_s=message.potential,
        initial_potential_s=message.initial_potential,
        bound_s=message.bound if math.isfinite(message.bound) else None,
    )
    return StrategyRecord(stamp_ns(message.header.stamp), agent, strategy)


def read_round_timing(message: DecodedMessage) -> RoundTiming:
    """Read a ``tlcomm_msgs/RoundTiming``."""
    return RoundTiming(
        agent=message.agent,
        round=message.round,
        solve_wall_s=message.solve_wall,
        offered_wall_s=seconds(stamp_ns(message.offered_at)),
        agreed_wall_s=seconds(stamp_ns(message.agreed_at)),
    )


def read_estimate(message: DecodedMessage) -> EstimateRecord:
    """Read a ``tlcomm_msgs/Estimate``."""
    return EstimateRecord(
        stamp_ns=stamp_ns(message.header.stamp),
        agent=message.agent,
        value=message.value,
        last_measurement=message.last_measurement,
        has_measurement=message.has_measurement,
    )


def read_undelivered(message: DecodedMessage) -> dict[str, int]:
    """Read a ``tlcomm_msgs/Undelivered``: how many messages, by reason."""
    return dict(zip(message.reasons, map(int, message.counts), strict=True))


def read_hearing(message: DecodedMessage, agent: str) -> list[HeardRecord]:
    """Read a ``tlcomm_msgs/Hearing`` of this agent."""
    columns = (message.heard, message.sender, message.topic, message.said)
    rows = zip(*(np.asarray(column).tolist() for column in columns), strict=True)
    return [
        HeardRecord(heard_ns, agent, message.agents[who], TEAM_TOPICS[what], said_ns)
        for heard_ns, who, what, said_ns in rows
    ]


def read_strategy(message: DecodedMessage) -> Strategy:
    """Read a ``tlcomm_msgs/Strategy``."""
    return Strategy(
        agent=message.agent,
        x_m=message.location.x,
        y_m=message.location.y,
        task_index=message.task_index,
        arrival_s=message.arrival_time,
        extra_travel_s=message.extra_travel,
    )


def stamp_ns(stamp: DecodedMessage) -> int:
    """Read a ``builtin_interfaces/Time`` in nanoseconds."""
    return int(stamp.sec) * NANOSECONDS_PER_SECOND + int(stamp.nanosec)
