"""A recording as a bag with all its topics, written without ROS.

``write_recording``  writes it
"""

import math
from collections.abc import Iterable, Iterator, Mapping
from itertools import product
from pathlib import Path
from typing import Any

import numpy as np
from rosbags.interfaces import Nodetype
from rosbags.typesys.store import Typestore

from support.hand_made_run import SHARE
from tlcomm_core.game.offer import MemberOffer
from tlcomm_core.game.strategy import Strategy
from tlcomm_core.geometry import quaternion_from_yaw, yaw_from_quaternion
from tlcomm_core.protocol.messages import (
    BestResponse,
    Confirmation,
    EstimateExchange,
    PlanOffer,
    Proposal,
    TeamMessage,
)
from tlcomm_core.protocol.topics import TEAM_TOPICS
from tlcomm_core.records import HeardRecord
from tlcomm_core.units import NANOSECONDS_PER_SECOND
from tlcomm_core.world.observation import Odometry
from tlcomm_tools.bag.definitions import load_typestore, read_definition
from tlcomm_tools.bag.topics import recorded_topics
from tlcomm_tools.bag.writer import BagWriter
from tlcomm_tools.verification.recording import Recording

__all__ = ["write_recording"]

# A message's fields by name; those that aren't given are zero or empty.
_Fields = dict[str, Any]


def write_recording(folder: Path, recording: Recording, *, measures: bool) -> None:
    """Write a bag as the recorder would have; ``measures``: if there is a field."""
    store = load_typestore(SHARE)
    topics = recorded_topics(recording.run.agents, measures=measures)
    definitions = {topic.type: read_definition(store, topic.type) for topic in topics}
    numbers = {topic.name: number for number, topic in enumerate(topics)}
    rows = sorted(_rows(recording), key=lambda row: row[0])
    with BagWriter(folder, topics, definitions, recording.run.notes) as writer:
        for stamp_ns, topic, fields in rows:
            number = numbers[topic]
            kind = topics[number].type
            message = _make(store, kind, {"header": {"stamp": _stamp(stamp_ns)}, **fields})
            writer.write(number, stamp_ns, bytes(store.serialize_cdr(message, kind)))


def _make(store: Typestore, kind: str, fields: Mapping[str, Any]) -> Any:  # noqa: ANN401
    """Return a message of the store's own class."""
    _, described = store.fielddefs[kind]
    assert fields.keys() <= {name for name, _ in described}, (kind, fields)
    values = {name: _value(store, node, fields.get(name)) for name, node in described}
    return store.types[kind](**values)


def _value(store: Typestore, node: Any, given: Any) -> Any:  # noqa: ANN401
    kind, about = node
    match kind:
        case Nodetype.NAME:
            return _make(store, about, given or {})
        case Nodetype.BASE:
            zero = {"string": "", "bool": False}.get(about[0], 0)
            return zero if given is None else given
        case _:
            inner, length = about
            items = [_value(store, inner, item) for item in ([] if given is None else given)]
            if inner[0] is Nodetype.NAME or inner[1][0] == "string":
                return items
            return np.array(items or [0] * length, dtype=inner[1][0])


def _rows(recording: Recording) -> Iterator[tuple[int, str, _Fields]]:
    """Yield when, on which topic and what."""
    records, names = recording.run.records, list(recording.run.agents)
    for pose in records.odometry:
        yield pose.stamp_ns, f"/{pose.agent}/odom", _odometry(pose)
    for seen in records.connectivity:
        ends = [end for edge in seen.edges for end in edge]
        fields = {"agents": names, "edges": ends, "distances": seen.distances_m}
        yield seen.stamp_ns, "/connectivity", {**fields, "connected": seen.connected}
    for shown in recording.maps:
        rows, columns = shown.free.shape
        info = {"height": rows, "width": columns}
        cells = np.where(shown.free, 0, 100).ravel().tolist()
        yield shown.stamp_ns, "/map", {"info": info, "data": cells}
    for own in recording.readings:
        fields = {"agent": own.agent, "region": own.region, "value": own.value}
        yield own.stamp_ns, f"/{own.agent}/reading", fields
    for command in recording.commanded:
        drive = command.drive
        twist = {"linear": {"x": drive.linear_mps}, "angular": {"z": drive.angular_radps}}
        yield command.stamp_ns, f"/{command.agent}/cmd_vel", {"twist": twist}
    for said in recording.said:
        topic, fields = _team_message(said.message)
        yield said.stamp_ns, f"/{said.agent}/{topic}", fields
    yield from _reports(recording)


def _reports(recording: Recording) -> Iterator[tuple[int, str, _Fields]]:
    records = recording.run.records
    for task in records.tasks:
        names = ("region", "action", "round", "plan_index", "detail")
        fields = {name: getattr(task.event, name) for name in names}
        fields |= {"agent": task.agent, "kind": int(task.event.kind)}
        yield task.stamp_ns, f"/{task.agent}/task_event", fields
    for own in records.strategies:
        held = own.strategy
        yield (
            own.stamp_ns,
            f"/{own.agent}/team_strategy",
            {
                "round": held.round,
                "iteration": held.iteration,
                "strategies": [_strategy(part) for part in held.strategies],
                "communication_time": held.communication_s,
                "potential": held.potential_s,
                "initial_potential": held.initial_potential_s,
                "bound": -math.inf if held.bound_s is None else held.bound_s,
            },
        )
    for taken in records.estimates:
        names = ("agent", "value", "last_measurement", "has_measurement")
        fields = {name: getattr(taken, name) for name in names}
        yield taken.stamp_ns, f"/{taken.agent}/estimate", fields
    for agent, until_ns in records.heard_until_ns.items():
        yield until_ns, f"/{agent}/hearing", _hearing(agent, records.heard)


def _hearing(agent: str, heard: Iterable[HeardRecord]) -> _Fields:
    own = [record for record in heard if record.agent == agent]
    senders = sorted({record.sender for record in own})
    return {
        "agent": agent,
        "agents": senders,
        "sender": [senders.index(record.sender) for record in own],
        "topic": [TEAM_TOPICS.index(record.topic) for record in own],
        "said": [record.said_ns for record in own],
        "heard": [record.stamp_ns for record in own],
    }


def _team_message(message: TeamMessage) -> tuple[str, _Fields]:
    same = {"sender": message.sender}
    match message:
        case PlanOffer():
            offers = [_offer(own) for own in message.offers]
            same |= {"round": message.round, "known": message.known, "offers": offers}
            return "plan_offer", same
        case Proposal():
            same |= {"potential": message.potential_s, "bound": message.bound_s}
            same |= {"strategies": [_strategy(own) for own in message.strategies]}
            return "proposal", same | _spread(message)
        case BestResponse():
            same |= {"change": message.change_s, "strategy": _strategy(message.strategy)}
            return "best_response", same | _spread(message)
        case Confirmation():
            same |= {"round": message.round, "iteration": message.iteration}
            return "confirmation", same | {
                "digest": message.digest,
                "confirmed": message.confirmed,
            }
        case EstimateExchange():
            names = ("step", "neighbours", "asks", "value")
            same |= {name: getattr(message, name) for name in names}
            known = [
                {"agent": own.agent, "value": own.value, "stamp": own.time_ns}
                for own in message.known
            ]
            return "estimate_exchange", same | {"known": known}


def _spread(word: Proposal | BestResponse) -> _Fields:
    return {name: getattr(word, name) for name in ("round", "iteration", "hop", "candidate")}


def _strategy(own: Strategy) -> _Fields:
    return {
        "agent": own.agent,
        "location": {"x": own.x_m, "y": own.y_m},
        "task_index": own.task_index,
        "arrival_time": own.arrival_s,
        "extra_travel": own.extra_travel_s,
    }


def _offer(own: MemberOffer) -> _Fields:
    return {
        "agent": own.agent,
        "arrival_time": own.arrival_s,
        "position": {"x": own.x_m, "y": own.y_m},
        "heading": own.yaw_rad,
        "linear_speed": own.linear_mps,
        "angular_speed": own.angular_radps,
        "forbidden": own.avoided,
        "map_stamp": own.map_ns,
        "task_index": [stop.task_index for stop in own.stops],
        "stop_x": [stop.x_m for stop in own.stops],
        "stop_y": [stop.y_m for stop in own.stops],
        "stop_heading": [stop.yaw_rad for stop in own.stops],
        "finish_offset": [stop.finish_offset_s for stop in own.stops],
    }


def _odometry(own: Odometry) -> _Fields:
    z, w = _exact_quaternion(own.pose.yaw_rad)
    place = {"x": own.pose.x_m, "y": own.pose.y_m}
    twist = {"linear": {"x": own.linear_mps}, "angular": {"z": own.angular_radps}}
    return {
        "pose": {"pose": {"position": place, "orientation": {"z": z, "w": w}}},
        "twist": {"twist": twist},
    }


def _exact_quaternion(yaw_rad: float) -> tuple[float, float]:
    """Return (z, w) from which exactly this yaw is read back."""
    near = [
        (value, *(math.nextafter(value, way) for way in (-2.0, 2.0)))
        for value in quaternion_from_yaw(yaw_rad)
    ]
    return next((z, w) for z, w in product(*near) if yaw_from_quaternion(z, w) == yaw_rad)


def _stamp(time_ns: int) -> _Fields:
    sec, nanosec = divmod(time_ns, NANOSECONDS_PER_SECOND)
    return {"sec": sec, "nanosec": nanosec}
