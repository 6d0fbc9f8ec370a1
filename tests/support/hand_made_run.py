"""A run made by hand: two agents on a line, two windows kept, both tasks satisfied twice."""

import math
from collections.abc import Callable, Iterable, Mapping
from pathlib import Path
from typing import Any

import numpy as np
from rosbags.typesys.store import Typestore

from tlcomm_core.agent.actions import TaskEvent, TaskEventKind
from tlcomm_core.agent.timing import RoundTiming
from tlcomm_core.game.strategy import Strategy, TeamStrategy
from tlcomm_core.geometry import Pose, quaternion_from_yaw
from tlcomm_core.protocol.messages import Confirmation
from tlcomm_core.protocol.size import size_bytes
from tlcomm_core.protocol.topics import TEAM_TOPICS
from tlcomm_core.records import (
    EstimateRecord,
    HeardRecord,
    RunRecords,
    SaidRecord,
    StrategyRecord,
    TaskRecord,
)
from tlcomm_core.scenario.loader import dumps, loads
from tlcomm_core.scenario.model import Scenario
from tlcomm_core.units import NANOSECONDS_PER_SECOND, nanoseconds
from tlcomm_core.world.observation import Connectivity, Odometry
from tlcomm_tools.bag.definitions import load_typestore, read_definition
from tlcomm_tools.bag.topics import recorded_topics
from tlcomm_tools.bag.writer import BagWriter

__all__ = [
    "AGENTS",
    "BYTES",
    "END_S",
    "MESSAGES",
    "SHARE",
    "UNDELIVERED",
    "Change",
    "hand_made_records",
    "hand_made_scenario",
    "serialize_run",
    "task",
    "write_bag",
]

Change = Callable[[str, Any], None]
"""Changes a message, given its topic."""

SHARE = Path(__file__).parents[2] / "ros2_ws" / "src" / "tlcomm_msgs"
AGENTS = ("east", "west")
END_S = 25.0
# Each says a confirmation a second after these meetings begin, and the other hears it.
_SAID_S = {"east": (1.0, 11.0, 21.0), "west": (1.0, 11.0)}
MESSAGES = {agent: len(times_s) for agent, times_s in _SAID_S.items()}
BYTES = {
    agent: count * size_bytes(Confirmation(agent, 1, 1, 7, (agent,)))
    for agent, count in MESSAGES.items()
}
UNDELIVERED: Mapping[str, Mapping[str, int]] = {"east": {"out of range": 5, "lost": 2}, "west": {}}

_SCENARIO = """
name: line
workspace:
  size_m: [8.0, 1.0]
  cell_m: 0.5
  regions:
    left: {at_m: [1.25, 0.25], radius_m: 0.3}
    right: {at_m: [6.25, 0.25], radius_m: 0.3}
communication: {range_m: 1.0, period_s: 10.0, duration_s: 2.0}
motion: {linear_mps: 1.0, angular_radps: 1.5}
actions: {pick: 1.0}
agents:
  east: {start: [3.75, 0.25, 0.0], task: "G F (right & pick)"}
  west: {start: [3.25, 0.25, 0.0], task: "G F (left & pick)"}
"""

# Both wait in the middle until 2 s, are at their regions from 4.5 s (east) or 4 s (west), pick for
# a second, are back after 8.5 s and 8 s, and meet from 10 s to 12 s; then the same once more.
_MIDDLE = {"east": 3.75, "west": 3.25}
_AWAY = {"east": 6.25, "west": 1.25}
_REGION = {"east": "right", "west": "left"}
_PERIOD_S = 10.0
_LATENCY_S = 0.005


def hand_made_scenario() -> Scenario:
    """Return the scenario."""
    return loads(_SCENARIO)


def hand_made_records() -> RunRecords:
    """Return fresh records of 25 s, of which a test may change anything."""
    records = RunRecords(
        messages_sent=dict(MESSAGES),
        bytes_sent=dict(BYTES),
        messages_undelivered={agent: dict(counts) for agent, counts in UNDELIVERED.items()},
        heard_until_ns=dict.fromkeys(AGENTS, nanoseconds(END_S)),
    )
    for agent, hearer in zip(AGENTS, reversed(AGENTS), strict=True):
        for time_s in _SAID_S[agent]:
            said_ns, heard_ns = nanoseconds(time_s), nanoseconds(time_s + _LATENCY_S)
            records.said.append(SaidRecord(said_ns, agent, "confirmation"))
            records.heard.append(HeardRecord(heard_ns, hearer, agent, "confirmation", said_ns))
    for number in (0, 1):
        _add_round(records, number)
    for agent in AGENTS:
        records.odometry += [_standing(agent, _MIDDLE[agent], t) for t in (20.0, 21.0, 22.0)]
        records.tasks.append(task(22.0, agent, TaskEventKind.MEETING_ENDED, round_=2))
        _add_agreement(records, agent, 3)
        records.odometry += [_standing(agent, _MIDDLE[agent], t) for t in (23.0, 24.0, 25.0)]
    records.connectivity.append(Connectivity(nanoseconds(20.0), ((0, 1),), connected=True))
    for entries in (
        records.odometry,
        records.tasks,
        records.strategies,
        records.connectivity,
        records.said,
        records.heard,
    ):
        entries.sort(key=lambda entry: entry.stamp_ns)
    return records


def _add_round(records: RunRecords, number: int) -> None:
    """Add the meeting of a round, the work after it, and the way to the next meeting."""
    begin_s = number * _PERIOD_S
    records.connectivity += [
        Connectivity(nanoseconds(begin_s), ((0, 1),), connected=True),
        Connectivity(nanoseconds(begin_s + 2.0), (), connected=False),
        Connectivity(nanoseconds(begin_s + 8.0), ((0, 1),), connected=True),
    ]
    for agent in AGENTS:
        way_m = _AWAY[agent] - _MIDDLE[agent]
        there_s = begin_s + 2.0 + abs(way_m)
        back_s = there_s + 1.0 + abs(way_m)
        records.odometry += [
            *(_standing(agent, _MIDDLE[agent], begin_s + t) for t in (0.0, 1.0)),
            *_moving(agent, begin_s + 2.0, _MIDDLE[agent], _AWAY[agent]),
            *(_standing(agent, _AWAY[agent], there_s + t) for t in (0.0, 0.5)),
            *_moving(agent, there_s + 1.0, _AWAY[agent], _MIDDLE[agent]),
            _standing(agent, _MIDDLE[agent], back_s),
        ]
        records.odometry += [
            _standing(agent, _MIDDLE[agent], t) for t in (begin_s + 9.0,) if t > back_s
        ]
        pick = {"region": _REGION[agent], "plan_index": number}
        records.tasks += [
            task(begin_s + 2.0, agent, TaskEventKind.MEETING_ENDED, round_=number),
            task(there_s, agent, TaskEventKind.ACTION_STARTED, action="pick", **pick),
            task(there_s + 1.0, agent, TaskEventKind.ACTION_FINISHED, action="pick", **pick),
            task(there_s + 1.0, agent, TaskEventKind.TASK_SATISFIED, **pick),
            task(back_s, agent, TaskEventKind.MEETING_REACHED, round_=number + 1),
        ]
        _add_agreement(records, agent, number + 1)


def _add_agreement(records: RunRecords, agent: str, number: int) -> None:
    opens_s = number * _PERIOD_S
    strategies = tuple(
        Strategy(
            agent=name,
            x_m=_MIDDLE[name],
            y_m=0.25,
            task_index=number,
            arrival_s=opens_s - 10.0 + 3.0 + 2.0 * abs(_AWAY[name] - _MIDDLE[name]),
            extra_travel_s=0.5,
        )
        for name in AGENTS
    )
    total_s = sum(own.extra_travel_s + opens_s - own.arrival_s for own in strategies)
    held = TeamStrategy(number, 1, strategies, opens_s, total_s, total_s + 1.0)
    agreed_s = opens_s - 9.0
    records.strategies.append(StrategyRecord(nanoseconds(agreed_s), agent, held))
    offered_s = 1000.0 + (0.25 if agent == "west" else 0.0)
    records.timings.append(
        RoundTiming(agent, number, 0.01 if agent == "west" else 0.02, offered_s, 1000.5)
    )


def _standing(agent: str, x_m: float, time_s: float) -> Odometry:
    return Odometry(nanoseconds(time_s), agent, Pose(x_m, 0.25, 0.0), 0.0, 0.0)


def _moving(agent: str, time_s: float, from_m: float, to_m: float) -> Iterable[Odometry]:
    """Yield a sample every half second from the start on, before the arrival, at 1 m/s.

    All look east the whole time: to the west they drive backwards, as a turn would take time.
    """
    speed_mps = math.copysign(1.0, to_m - from_m)
    for step in range(round(2.0 * abs(to_m - from_m))):
        pose = Pose(from_m + 0.5 * step * speed_mps, 0.25, 0.0)
        yield Odometry(nanoseconds(time_s + 0.5 * step), agent, pose, speed_mps, 0.0)


def task(  # noqa: D103 - says itself
    time_s: float,
    agent: str,
    kind: TaskEventKind,
    *,
    region: str = "",
    action: str = "",
    round_: int = 0,
    plan_index: int = 0,
    detail: str = "",
) -> TaskRecord:
    event = TaskEvent(kind, region, action, round_, plan_index, detail)
    return TaskRecord(nanoseconds(time_s), agent, event)


def write_bag(
    folder: Path,
    records: RunRecords,
    *,
    with_scenario: bool = True,
    method: str | None = None,
    change: Change | None = None,
    **more_notes: str,
) -> BagWriter:
    """Write records into a bag as the recorder does; return the closed writer.

    Args:
        folder: to be made.
        records: what to write.
        with_scenario: whether the bag says which it is, and that it was in lock step.
        method: which the bag says; ``None`` for a bag from before there was more than one.
        change: of the messages, each by its topic and decoded, before it is written.
        more_notes: what else the bag says.
    """
    store = load_typestore(SHARE)
    topics = recorded_topics(AGENTS)
    definitions = {topic.type: read_definition(store, topic.type) for topic in topics}
    notes = {"scenario": dumps(hand_made_scenario()), "pace": "lockstep"} if with_scenario else {}
    notes |= ({} if method is None else {"method": method}) | more_notes
    numbers = {topic.name: number for number, topic in enumerate(topics)}
    with BagWriter(folder, topics, definitions, notes) as writer:
        for name, stamp_ns, data in serialize_run(store, records):
            if change is None:
                writer.write(numbers[name], stamp_ns, data)
                continue
            kind = topics[numbers[name]].type
            message = store.deserialize_cdr(data, kind)
            change(name, message)
            writer.write(numbers[name], stamp_ns, bytes(store.serialize_cdr(message, kind)))
    return writer


def serialize_run(store: Typestore, records: RunRecords) -> Iterable[tuple[str, int, bytes]]:
    """Yield topic, stamp (ns) and bytes of every message, in order of time."""
    make = _Messages(store)
    rows = [(f"/{own.agent}/odom", own.stamp_ns, make.odometry(own)) for own in records.odometry]
    rows += [
        ("/connectivity", own.stamp_ns, make.connectivity(own)) for own in records.connectivity
    ]
    rows += [(f"/{own.agent}/task_event", own.stamp_ns, make.task(own)) for own in records.tasks]
    rows += [
        (f"/{own.agent}/team_strategy", own.stamp_ns, make.strategy(own))
        for own in records.strategies
    ]
    rows += [
        (f"/{own.agent}/estimate", own.stamp_ns, make.estimate(own)) for own in records.estimates
    ]
    rows += [(f"/{own.agent}/round_timing", 0, make.timing(own)) for own in records.timings]
    rows += [
        (f"/{agent}/undelivered", nanoseconds(22.0), make.undelivered(agent, counts))
        for agent, counts in records.messages_undelivered.items()
    ]
    rows += [
        (f"/{own.agent}/confirmation", own.stamp_ns, make.confirmation(own)) for own in records.said
    ]
    rows += [
        (f"/{agent}/hearing", until_ns, make.hearing(agent, until_ns, records.heard))
        for agent, until_ns in records.heard_until_ns.items()
    ]
    return sorted(rows, key=lambda row: row[1])


class _Messages:
    """Serialized messages of the core's values."""

    def __init__(self, store: Typestore) -> None:
        self._store = store

    def _make(self, name: str, **fields: object) -> Any:  # noqa: ANN401 - made by the store
        return self._store.types[name](**fields)

    def _bytes(self, name: str, **fields: object) -> bytes:
        return bytes(self._store.serialize_cdr(self._make(name, **fields), name))

    def _stamp(self, time_ns: int) -> Any:  # noqa: ANN401
        seconds, nanosec = divmod(time_ns, NANOSECONDS_PER_SECOND)
        return self._make("builtin_interfaces/msg/Time", sec=seconds, nanosec=nanosec)

    def _header(self, time_ns: int) -> Any:  # noqa: ANN401
        return self._make("std_msgs/msg/Header", stamp=self._stamp(time_ns), frame_id="map")

    def _xyz(self, name: str, x: float, y: float = 0.0, z: float = 0.0) -> Any:  # noqa: ANN401
        return self._make(f"geometry_msgs/msg/{name}", x=x, y=y, z=z)

    def odometry(self, own: Odometry) -> bytes:
        z, w = quaternion_from_yaw(own.pose.yaw_rad)
        turn = self._make("geometry_msgs/msg/Quaternion", x=0.0, y=0.0, z=z, w=w)
        place = self._xyz("Point", own.pose.x_m, own.pose.y_m)
        pose = self._make("geometry_msgs/msg/Pose", position=place, orientation=turn)
        twist = self._make(
            "geometry_msgs/msg/Twist",
            linear=self._xyz("Vector3", own.linear_mps),
            angular=self._xyz("Vector3", 0.0, 0.0, own.angular_radps),
        )
        no_covariance = np.zeros(36)
        return self._bytes(
            "nav_msgs/msg/Odometry",
            header=self._header(own.stamp_ns),
            child_frame_id=own.agent,
            pose=self._make(
                "geometry_msgs/msg/PoseWithCovariance", pose=pose, covariance=no_covariance
            ),
            twist=self._make(
                "geometry_msgs/msg/TwistWithCovariance", twist=twist, covariance=no_covariance
            ),
        )

    def connectivity(self, own: Connectivity) -> bytes:
        return self._bytes(
            "tlcomm_msgs/msg/Connectivity",
            header=self._header(own.stamp_ns),
            range=1.0,
            agents=list(AGENTS),
            edges=np.array([end for edge in own.edges for end in edge], dtype=np.uint16),
            distances=np.array(own.distances_m, dtype=np.float64),
            connected=own.connected,
        )

    def task(self, own: TaskRecord) -> bytes:
        event = own.event
        return self._bytes(
            "tlcomm_msgs/msg/TaskEvent",
            header=self._header(own.stamp_ns),
            agent=own.agent,
            kind=int(event.kind),
            region=event.region,
            action=event.action,
            round=event.round,
            plan_index=event.plan_index,
            detail=event.detail,
        )

    def strategy(self, own: StrategyRecord) -> bytes:
        held = own.strategy
        return self._bytes(
            "tlcomm_msgs/msg/TeamStrategy",
            header=self._header(own.stamp_ns),
            round=held.round,
            iteration=held.iteration,
            strategies=[
                self._make(
                    "tlcomm_msgs/msg/Strategy",
                    agent=one.agent,
                    location=self._xyz("Point", one.x_m, one.y_m),
                    task_index=one.task_index,
                    arrival_time=one.arrival_s,
                    extra_travel=one.extra_travel_s,
                )
                for one in held.strategies
            ],
            communication_time=held.communication_s,
            potential=held.potential_s,
            initial_potential=held.initial_potential_s,
            bound=-math.inf if held.bound_s is None else held.bound_s,
        )

    def timing(self, own: RoundTiming) -> bytes:
        return self._bytes(
            "tlcomm_msgs/msg/RoundTiming",
            header=self._header(0),
            agent=own.agent,
            round=own.round,
            solve_wall=own.solve_wall_s,
            offered_at=self._stamp(nanoseconds(own.offered_wall_s)),
            agreed_at=self._stamp(nanoseconds(own.agreed_wall_s)),
        )

    def estimate(self, own: EstimateRecord) -> bytes:
        return self._bytes(
            "tlcomm_msgs/msg/Estimate",
            header=self._header(own.stamp_ns),
            agent=own.agent,
            value=own.value,
            last_measurement=own.last_measurement,
            has_measurement=own.has_measurement,
        )

    def undelivered(self, agent: str, counts: Mapping[str, int]) -> bytes:
        return self._bytes(
            "tlcomm_msgs/msg/Undelivered",
            header=self._header(nanoseconds(22.0)),
            agent=agent,
            reasons=list(counts),
            counts=np.array(list(counts.values()), dtype=np.uint64),
        )

    def confirmation(self, own: SaidRecord) -> bytes:
        return self._bytes(
            "tlcomm_msgs/msg/Confirmation",
            header=self._header(own.stamp_ns),
            sender=own.agent,
            round=1,
            iteration=1,
            digest=7,
            confirmed=[own.agent],
        )

    def hearing(self, agent: str, until_ns: int, heard: Iterable[HeardRecord]) -> bytes:
        own = [record for record in heard if record.agent == agent]
        senders = sorted({record.sender for record in own})
        indices = [senders.index(record.sender) for record in own]
        topics = [TEAM_TOPICS.index(record.topic) for record in own]
        return self._bytes(
            "tlcomm_msgs/msg/Hearing",
            header=self._header(until_ns),
            agent=agent,
            agents=senders,
            sender=np.array(indices, dtype=np.uint16),
            topic=np.array(topics, dtype=np.uint8),
            said=np.array([record.said_ns for record in own], dtype=np.int64),
            heard=np.array([record.stamp_ns for record in own], dtype=np.int64),
        )
