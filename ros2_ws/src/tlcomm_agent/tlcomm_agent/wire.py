"""What an agent does and sees, as messages and as values, one to one and lossless.

``TYPES``              the type of each topic that an agent publishes, but those that it talks on
``encode_action``      what the agent does, of ``PublishedAction``
``encode_drive``, ``encode_task_event``, ``encode_team_strategy``, ``encode_round_timing``,
``encode_estimate``, ``encode_undelivered``, ``encode_hearing``  each of what it publishes
``encode_answer``      what it answers to a tick
``decode_odometry``    where the agent is
``decode_neighbours``  who is in range of one agent, and how far away, of ``Connectivity``
``decode_reading``     what the agent measures
"""

import math
from collections.abc import Collection, Mapping
from types import MappingProxyType
from typing import Any, Final

from geometry_msgs.msg import TwistStamped

from tlcomm_agent.hearing import Hearing
from tlcomm_agent.wire_fields import header, time
from tlcomm_agent.wire_messages import encode_message, encode_strategy
from tlcomm_core.agent.actions import (
    Drive,
    ReportEstimate,
    ReportTask,
    SayEstimate,
    TaskEvent,
)
from tlcomm_core.agent.member import Member
from tlcomm_core.agent.timing import RoundTiming
from tlcomm_core.game.strategy import TeamStrategy
from tlcomm_core.geometry import Pose, yaw_from_quaternion
from tlcomm_core.protocol.actions import HoldStrategy, SendMessage
from tlcomm_core.protocol.topics import TEAM_TOPICS, topic_of
from tlcomm_core.units import NANOSECONDS_PER_SECOND
from tlcomm_core.wire import world_messages
from tlcomm_core.wire.fields import WireError, decode_stamp, finite, names
from tlcomm_core.world.observation import Odometry
from tlcomm_msgs import msg

__all__ = [
    "TYPES",
    "PublishedAction",
    "decode_neighbours",
    "decode_odometry",
    "decode_reading",
    "encode_action",
    "encode_answer",
    "encode_drive",
    "encode_estimate",
    "encode_hearing",
    "encode_round_timing",
    "encode_task_event",
    "encode_team_strategy",
    "encode_undelivered",
]

TYPES: Final[Mapping[str, Any]] = MappingProxyType(
    {
        "cmd_vel": TwistStamped,
        "task_event": msg.TaskEvent,
        "team_strategy": msg.TeamStrategy,
        "round_timing": msg.RoundTiming,
        "undelivered": msg.Undelivered,
        "hearing": msg.Hearing,
        # Where there is nothing to estimate, the topic is there for those who look for it.
        "estimate": msg.Estimate,
    }
)
PublishedAction = Drive | SendMessage | ReportTask | HoldStrategy | ReportEstimate | SayEstimate

# Generated messages are opaque: what matters is checked here, field by field.
_RosMessage = Any


def encode_action(action: PublishedAction, agent: str, stamp_ns: int) -> tuple[str, _RosMessage]:
    """Return the topic and the message that an action is, when ``agent`` takes it."""
    match action:
        case Drive():
            return "cmd_vel", encode_drive(action, agent, stamp_ns)
        case SendMessage(message) | SayEstimate(message):
            return topic_of(message), encode_message(message, stamp_ns)
        case ReportTask(event):
            return "task_event", encode_task_event(event, agent, stamp_ns)
        case HoldStrategy(strategy):
            return "team_strategy", encode_team_strategy(strategy, stamp_ns)
        case ReportEstimate():
            return "estimate", encode_estimate(action, agent, stamp_ns)


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
        strategies=[encode_strategy(own) for own in strategy.strategies],
        communication_time=strategy.communication_s,
        potential=strategy.potential_s,
        initial_potential=strategy.initial_potential_s,
        bound=-math.inf if strategy.bound_s is None else strategy.bound_s,
    )


def encode_estimate(report: ReportEstimate, agent: str, stamp_ns: int) -> _RosMessage:
    """Return what an agent takes the field to be."""
    measured = report.last_measurement
    return msg.Estimate(
        header=header(stamp_ns),
        agent=agent,
        value=report.value,
        last_measurement=0.0 if measured is None else measured,
        has_measurement=measured is not None,
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


def encode_hearing(hearing: Hearing, stamp_ns: int) -> _RosMessage:
    """Return what an agent has heard up to now."""
    times_ns = [time_ns for time_ns, _ in hearing.heard]
    heard = [own for _, own in hearing.heard]
    senders = sorted({own.message.sender for own in heard})
    return msg.Hearing(
        header=header(stamp_ns),
        agent=hearing.agent,
        agents=senders,
        sender=[senders.index(own.message.sender) for own in heard],
        topic=[TEAM_TOPICS.index(topic_of(own.message)) for own in heard],
        said=[own.said_ns for own in heard],
        heard=times_ns,
    )


def encode_answer(
    member: Member, sequence: int, published: Mapping[str, int], team_topics: Collection[str]
) -> _RosMessage:
    """Return what an agent answers to a tick.

    Args:
        member: the agent.
        sequence: the tick's number.
        published: on each topic, how many messages so far.
        team_topics: those that agents talk on.
    """
    need_ns = member.next_need_ns
    return msg.TickReply(
        agent=member.name,
        sequence=sequence,
        has_next_need=need_ns is not None,
        next_need_ns=need_ns or 0,
        team_messages=sum(published.get(topic, 0) for topic in team_topics),
        commands=published.get("cmd_vel", 0),
        published=sum(published.values()),
        measured_at=member.measured_at,
        meetings_ended=member.meetings_ended,
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


def decode_reading(message: _RosMessage, agent: str) -> tuple[int, float]:
    """Return when an agent has measured (ns), and what.

    Raises:
        WireError: a value that isn't finite, a malformed stamp, or another agent's reading.
    """
    if message.agent != agent:
        raise WireError(f"agent: a reading of {message.agent!r}")
    reading = world_messages.decode_reading(message)
    return reading.stamp_ns, reading.value


def _wall_ns(time_s: float) -> int:
    whole_s = int(time_s)
    return whole_s * NANOSECONDS_PER_SECOND + round((time_s - whole_s) * NANOSECONDS_PER_SECOND)
