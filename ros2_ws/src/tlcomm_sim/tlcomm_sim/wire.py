"""The sim's messages and the core's values, one to one and lossless.

``encode_clock``, ``encode_odometry``, ``encode_connectivity``, ``encode_occupancy``,
``encode_reading``, ``encode_tick``
``decode_answer``  an agent's or the recorder's answer to a tick
"""

import math
from array import array
from collections.abc import Sequence
from typing import Any, Final

import numpy as np
from builtin_interfaces.msg import Time
from nav_msgs.msg import OccupancyGrid
from nav_msgs.msg import Odometry as OdometryMessage
from rosgraph_msgs.msg import Clock
from std_msgs.msg import Header

from tlcomm_core.geometry import quaternion_from_yaw, yaw_from_quaternion
from tlcomm_core.units import NANOSECONDS_PER_SECOND
from tlcomm_core.world.observation import Connectivity, Occupancy, Odometry, Reading
from tlcomm_msgs import msg
from tlcomm_sim.outputs import Answer, Tick

__all__ = [
    "decode_answer",
    "encode_clock",
    "encode_connectivity",
    "encode_occupancy",
    "encode_odometry",
    "encode_reading",
    "encode_tick",
]

_FRAME: Final = "map"
_OCCUPIED: Final = 100

# Generated messages are opaque.
_RosMessage = Any

# Steps in units of the last place for (z, w), the smallest first.
_NUDGES: Final = sorted(
    ((i, j) for i in range(-2, 3) for j in range(-2, 3)),
    key=lambda steps: (abs(steps[0]) + abs(steps[1]), steps),
)


def encode_clock(time_ns: int) -> Clock:
    """Return the simulation time as a message."""
    return Clock(clock=_time(time_ns))


def encode_odometry(odometry: Odometry) -> OdometryMessage:
    """Return an odometry that decodes to the same bits."""
    message = OdometryMessage(
        header=_header(odometry.stamp_ns), child_frame_id=f"{odometry.agent}/base_link"
    )
    pose, twist = message.pose.pose, message.twist.twist
    pose.position.x, pose.position.y = odometry.pose.x_m, odometry.pose.y_m
    pose.orientation.z, pose.orientation.w = _exact_quaternion(odometry.pose.yaw_rad)
    twist.linear.x, twist.angular.z = odometry.linear_mps, odometry.angular_radps
    return message


def encode_connectivity(
    connectivity: Connectivity, range_m: float, agents: Sequence[str]
) -> _RosMessage:
    """Return who is in range of whom."""
    return msg.Connectivity(
        header=_header(connectivity.stamp_ns),
        range=range_m,
        agents=list(agents),
        edges=[end for edge in connectivity.edges for end in edge],
        distances=list(connectivity.distances_m),
        connected=connectivity.connected,
    )


def encode_occupancy(occupancy: Occupancy) -> OccupancyGrid:
    """Return the map: 0 for free cells and 100 for others, by rows from the lower left."""
    grid = occupancy.grid
    cells = np.where(grid.free, 0, _OCCUPIED).astype(np.int8)
    message = OccupancyGrid(header=_header(occupancy.stamp_ns), data=array("b", cells.tobytes()))
    message.info.map_load_time = message.header.stamp
    message.info.resolution = grid.cell_m
    message.info.height, message.info.width = grid.shape
    message.info.origin.position.x, message.info.origin.position.y = grid.origin_m
    return message


def encode_reading(reading: Reading) -> _RosMessage:
    """Return what an agent measures."""
    return msg.Reading(
        header=_header(reading.stamp_ns),
        agent=reading.agent,
        region=reading.region,
        value=reading.value,
    )


def encode_tick(tick: Tick) -> _RosMessage:
    """Return a tick as a message."""
    return msg.Tick(
        sequence=tick.sequence,
        time_ns=tick.time_ns,
        odometry_count=tick.odometry_count,
        connectivity_count=tick.connectivity_count,
        clock_count=tick.clock_count,
        map_count=tick.map_count,
        reading_count=tick.reading_count,
        agent_counts=list(tick.agent_counts),
        stop=tick.stop,
    )


def decode_answer(message: _RosMessage) -> Answer:
    """Return a ``TickReply`` as a value."""
    return Answer(
        name=message.agent,
        sequence=message.sequence,
        ready=message.ready,
        next_need_ns=message.next_need_ns if message.has_next_need else None,
        team_messages=message.team_messages,
        commands=message.commands,
        published=message.published,
        meetings_ended=message.meetings_ended,
        measured_at=message.measured_at,
    )


def _exact_quaternion(yaw_rad: float) -> tuple[float, float]:
    """Return (z, w) from which exactly this yaw is read back.

    Sine, cosine and arc tangent are rounded, so one yaw in thirty comes back as its neighbour; a
    quaternion within two units in the last place does better. Agents over ROS then see the bits
    that agents in process see.
    """
    z, w = quaternion_from_yaw(yaw_rad)
    for steps_z, steps_w in _NUDGES:
        nudged = _nudged(z, steps_z), _nudged(w, steps_w)
        if yaw_from_quaternion(*nudged) == yaw_rad:
            return nudged
    raise AssertionError(f"no quaternion for the yaw {yaw_rad!r}")


def _nudged(value: float, steps: int) -> float:
    towards = math.copysign(math.inf, steps)
    for _ in range(abs(steps)):
        value = math.nextafter(value, towards)
    return value


def _header(stamp_ns: int) -> Header:
    return Header(stamp=_time(stamp_ns), frame_id=_FRAME)


def _time(stamp_ns: int) -> Time:
    sec, nanosec = divmod(stamp_ns, NANOSECONDS_PER_SECOND)
    return Time(sec=sec, nanosec=nanosec)
