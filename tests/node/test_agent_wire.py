"""An agent's messages and the core's values, with the real message classes."""

import math
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st
from rclpy.serialization import deserialize_message, serialize_message

from tlcomm_agent import wire, wire_messages
from tlcomm_core.agent.actions import (
    Drive,
    ReportEstimate,
    SayEstimate,
    TaskEvent,
    TaskEventKind,
)
from tlcomm_core.game.offer import MAX_STOPS, MemberOffer, PlannedStop
from tlcomm_core.game.strategy import Strategy, TeamStrategy
from tlcomm_core.geometry import Pose
from tlcomm_core.protocol.actions import SendMessage
from tlcomm_core.protocol.messages import (
    BestResponse,
    Confirmation,
    EstimateExchange,
    Measurement,
    PlanOffer,
    Proposal,
    TeamMessage,
)
from tlcomm_core.protocol.size import size_bytes
from tlcomm_core.records import EstimateRecord, RoundTiming, StrategyRecord, TaskRecord
from tlcomm_core.wire.fields import WireError
from tlcomm_core.wire.team_messages import decode_message
from tlcomm_core.world.observation import Connectivity, Odometry, Reading
from tlcomm_msgs import msg
from tlcomm_sim.wire import encode_connectivity, encode_odometry, encode_reading
from tlcomm_tools.wire import (
    read_estimate,
    read_round_timing,
    read_task_event,
    read_team_strategy,
    read_undelivered,
)

# Generated messages are opaque.
RosMessage = Any

FLOATS = st.floats(allow_nan=False, allow_infinity=False)
NAMES = st.from_regex(r"[a-z][a-z0-9_]{0,20}", fullmatch=True)
UINT32 = st.integers(0, 2**32 - 1)
STAMPS_NS = st.integers(0, 2**31 * 10**9 - 1)
STRATEGIES = st.builds(Strategy, NAMES, FLOATS, FLOATS, UINT32, FLOATS, FLOATS)
STOPS = st.builds(PlannedStop, UINT32, FLOATS, FLOATS, FLOATS, FLOATS)
NAME_TUPLES = st.lists(NAMES, max_size=4).map(tuple)
OFFERS = st.builds(
    MemberOffer,
    NAMES,
    FLOATS,
    FLOATS,
    FLOATS,
    FLOATS,
    FLOATS,
    FLOATS,
    st.lists(STOPS, max_size=4).map(tuple),
    NAME_TUPLES,
    st.integers(0, 2**63 - 1),
)
MESSAGES = st.one_of(
    st.builds(PlanOffer, NAMES, UINT32, NAME_TUPLES, st.lists(OFFERS, max_size=3).map(tuple)),
    st.builds(
        Proposal,
        NAMES,
        UINT32,
        UINT32,
        st.integers(0, 2**16 - 1),
        NAMES,
        FLOATS,
        FLOATS | st.just(-math.inf),
        st.lists(STRATEGIES, max_size=4).map(tuple),
    ),
    st.builds(
        BestResponse, NAMES, UINT32, UINT32, st.integers(0, 2**16 - 1), NAMES, FLOATS, STRATEGIES
    ),
    st.builds(Confirmation, NAMES, UINT32, UINT32, st.integers(0, 2**64 - 1), NAME_TUPLES),
)
MEASUREMENTS = st.builds(Measurement, NAMES, FLOATS, st.integers(-(2**63), 2**63 - 1))
ESTIMATES = st.builds(
    EstimateExchange,
    NAMES,
    UINT32,
    st.integers(0, 2**16 - 1),
    st.booleans(),
    FLOATS,
    st.lists(MEASUREMENTS, max_size=4).map(tuple),
)
# Times of today's wall clock.
WALL_S = st.floats(1.0e9, 2.0**31 - 1.0)


def over_the_wire(message: RosMessage) -> RosMessage:
    """Return a message after it has been bytes."""
    return deserialize_message(serialize_message(message), type(message))


@given(MESSAGES | ESTIMATES, STAMPS_NS)
def test_what_agents_say_survives(message: TeamMessage, stamp_ns: int) -> None:
    """Messages come back equal, to the last bit and nanosecond, on the topic of their type."""
    encoded = wire_messages.encode_message(message, stamp_ns)
    is_estimate = isinstance(message, EstimateExchange)
    action = SayEstimate(message) if is_estimate else SendMessage(message)
    topic, same = wire.encode_action(action, "a", stamp_ns)
    assert isinstance(encoded, wire_messages.team_types(measures=True)[topic])
    assert same == encoded
    assert decode_message(over_the_wire(encoded), topic) == (message, stamp_ns)


@given(
    st.builds(TaskEvent, st.sampled_from(TaskEventKind), NAMES, NAMES, UINT32, UINT32, st.text()),
    NAMES,
    STAMPS_NS,
)
def test_task_events_survive(event: TaskEvent, agent: str, stamp_ns: int) -> None:
    """A task event reads from a bag as it was."""
    event = TaskEvent(
        event.kind,
        event.region,
        event.action,
        event.round,
        event.plan_index,
        # Neither NUL nor lone surrogates are text that ROS carries.
        "".join(c for c in event.detail if c != "\0" and not 0xD800 <= ord(c) <= 0xDFFF),
    )
    encoded = wire.encode_task_event(event, agent, stamp_ns)
    assert read_task_event(over_the_wire(encoded)) == TaskRecord(stamp_ns, agent, event)


@given(
    st.builds(
        TeamStrategy,
        UINT32,
        UINT32,
        st.lists(STRATEGIES, max_size=4).map(tuple),
        FLOATS,
        FLOATS,
        FLOATS,
    ),
    STAMPS_NS,
)
def test_team_strategies_survive(strategy: TeamStrategy, stamp_ns: int) -> None:
    """A team strategy reads from a bag as it was."""
    encoded = over_the_wire(wire.encode_team_strategy(strategy, stamp_ns))
    assert read_team_strategy(encoded, "a") == StrategyRecord(stamp_ns, "a", strategy)


@given(st.builds(RoundTiming, NAMES, UINT32, FLOATS, WALL_S, WALL_S), STAMPS_NS)
def test_timings_survive(timing: RoundTiming, stamp_ns: int) -> None:
    """Wall times of the present come back as the same floats."""
    assert read_round_timing(over_the_wire(wire.encode_round_timing(timing, stamp_ns))) == timing


def test_drive() -> None:
    """A command has its stamp, linear.x and angular.z in the agent's own frame, nothing else."""
    message = wire.encode_drive(Drive(0.5, -1.5), "agent_1", 1_500_000_000)
    odometry = Odometry(0, "agent_1", Pose(0.0, 0.0, 0.0), 0.0, 0.0)
    assert message.header.frame_id == encode_odometry(odometry).child_frame_id
    assert (message.header.stamp.sec, message.header.stamp.nanosec) == (1, 500_000_000)
    assert (message.twist.linear.x, message.twist.angular.z) == (0.5, -1.5)
    assert (message.twist.linear.y, message.twist.angular.x) == (0.0, 0.0)


@given(
    st.dictionaries(
        st.sampled_from([(i, j) for i in range(4) for j in range(i + 1, 4)]), st.floats(0.0, 1.0)
    )
)
def test_neighbours(lengths_m: dict[tuple[int, int], float]) -> None:
    """Of a connectivity an agent learns who is on the other end of its own edges, how far away."""
    names, edges = ("a", "b", "c", "d"), tuple(sorted(lengths_m))
    seen = Connectivity(7, edges, False, tuple(lengths_m[edge] for edge in edges))
    message = encode_connectivity(seen, 1.0, names)
    for own, name in enumerate(names):
        near = {names[i + j - own]: lengths_m[i, j] for i, j in edges if own in (i, j)}
        assert wire.decode_neighbours(over_the_wire(message), name) == (near, 7)


def test_without_distances_neighbours_are_at_the_range() -> None:
    """A world that doesn't tell how far apart agents are is taken to mean the worst."""
    message = encode_connectivity(Connectivity(7, ((0, 1),), False), 1.5, ("a", "b"))
    assert wire.decode_neighbours(over_the_wire(message), "a") == ({"b": 1.5}, 7)


@given(st.dictionaries(NAMES, UINT32))
def test_counts_of_undelivered_messages_survive(counts: dict[str, int]) -> None:
    """Reasons and counts read from a bag as they were."""
    encoded = over_the_wire(wire.encode_undelivered(counts, "a", 7))
    assert (encoded.agent, read_undelivered(encoded)) == ("a", counts)


@given(FLOATS, st.none() | FLOATS, NAMES, STAMPS_NS)
def test_estimates_survive(value: float, measured: float | None, name: str, stamp_ns: int) -> None:
    """They read from a bag as they were made, with the last measurement if there is one."""
    topic, encoded = wire.encode_action(ReportEstimate(value, measured), name, stamp_ns)
    assert topic == "estimate"
    has_measured = measured is not None
    expected = EstimateRecord(stamp_ns, name, value, measured or 0.0, has_measured)
    assert read_estimate(over_the_wire(encoded)) == expected


@given(FLOATS, NAMES, NAMES, STAMPS_NS)
def test_readings_survive(value: float, name: str, region: str, stamp_ns: int) -> None:
    """An agent is told what it has measured, and when."""
    message = over_the_wire(encode_reading(Reading(stamp_ns, name, region, value)))
    assert (message.region, message.agent) == (region, name)
    assert wire.decode_reading(message, name) == (stamp_ns, value)


@pytest.mark.parametrize(
    "reading",
    [Reading(0, "a", "m", math.nan), Reading(0, "a", "m", math.inf), Reading(0, "b", "m", 1.0)],
)
def test_readings_that_are_none_or_another_s_are_refused(reading: Reading) -> None:
    """A sensor that fails, or a wrong connection, doesn't become an estimate."""
    with pytest.raises(WireError):
        wire.decode_reading(encode_reading(reading), "a")


def test_without_a_field_agents_talk_of_rounds_only() -> None:
    """The topic of estimates is there if anything is measured."""
    rounds = wire_messages.team_types(measures=False)
    assert set(rounds) == {"plan_offer", "proposal", "best_response", "confirmation"}
    assert set(wire_messages.team_types(measures=True)) == {*rounds, "estimate_exchange"}


@given(MESSAGES | ESTIMATES, STAMPS_NS)
def test_the_core_knows_how_long_messages_are(message: TeamMessage, stamp_ns: int) -> None:
    """Counted without ROS, a message has as many bytes as ROS makes of it, in whole words."""
    length = len(serialize_message(wire_messages.encode_message(message, stamp_ns)))
    assert size_bytes(message) == length + -length % 4


def offer_message() -> RosMessage:
    """Return a well-formed plan offer with one stop."""
    stop = PlannedStop(1, 2.0, 3.0, 0.5, 4.0)
    offer = MemberOffer("b", 1.0, 2.0, 3.0, 0.0, 1.0, 1.5, (stop,), ("danger",))
    return wire_messages.encode_message(PlanOffer("b", 1, ("b",), (offer,)), 0)


def response_message() -> RosMessage:
    """Return a well-formed best response."""
    strategy = Strategy("b", 1.0, 2.0, 3, 4.0, 5.0)
    return wire_messages.encode_message(BestResponse("b", 1, 2, 0, "b", -1.0, strategy), 0)


def estimate_message() -> RosMessage:
    """Return a well-formed estimate with one measurement."""
    known = (Measurement("a", 2.0, 3),)
    return wire_messages.encode_message(EstimateExchange("b", 1, 2, False, 3.0, known), 0)


def assign(message: RosMessage, path: str, value: object) -> RosMessage:
    """Return the message with a field, given by its path, changed."""
    *parents, field = path.split(".")
    target = message
    for parent in parents:
        target = target[int(parent)] if parent.isdecimal() else getattr(target, parent)
    setattr(target, field, value)
    return message


@pytest.mark.parametrize(
    ("message", "path", "value"),
    [
        (offer_message(), "sender", ""),
        (offer_message(), "sender", "x" * 256),
        (offer_message(), "header.stamp.nanosec", 10**9),
        (offer_message(), "header.stamp.sec", -1),
        (offer_message(), "known", ["a", ""]),
        (offer_message(), "known", ["a"] * 1001),
        (offer_message(), "offers", [msg.MemberOffer(agent="a")] * 1001),
        (offer_message(), "offers.0.agent", ""),
        (offer_message(), "offers.0.heading", math.nan),
        (offer_message(), "offers.0.linear_speed", math.inf),
        (offer_message(), "offers.0.stop_x", [math.nan]),
        (offer_message(), "offers.0.finish_offset", [-math.inf]),
        (offer_message(), "offers.0.stop_y", [1.0, 2.0]),
        (offer_message(), "offers.0.forbidden", [""]),
        (offer_message(), "offers.0.forbidden", ["a"] * 1001),
        (offer_message(), "offers.0.task_index", list(range(MAX_STOPS + 1))),
        (response_message(), "candidate", ""),
        (response_message(), "change", math.nan),
        (response_message(), "strategy.location.x", math.inf),
        (response_message(), "strategy.arrival_time", math.nan),
        (msg.Confirmation(sender="b"), "confirmed", ["a"] * 1001),
        (estimate_message(), "sender", ""),
        (estimate_message(), "value", math.nan),
        (estimate_message(), "known.0.value", math.inf),
        (estimate_message(), "known.0.agent", ""),
        (estimate_message(), "known", [msg.Measurement(agent="a")] * 1001),
    ],
)
def test_malformed_messages_are_refused(message: RosMessage, path: str, value: object) -> None:
    """Names, sizes, stamps and numbers out of their range are refused by name."""
    types = wire_messages.team_types(measures=True)
    topic = next(topic for topic, kind in types.items() if isinstance(message, kind))
    with pytest.raises(WireError):
        decode_message(assign(message, path, value), topic)


@pytest.mark.parametrize(
    "message",
    [
        msg.Connectivity(agents=["b"]),
        msg.Connectivity(agents=["a", "b"], edges=[0]),
        msg.Connectivity(agents=["a", "b"], edges=[0, 2]),
        msg.Connectivity(agents=["a", ""], edges=[0, 1]),
        msg.Connectivity(agents=["a", "b"], edges=[0, 1], distances=[1.0, 2.0]),
        msg.Connectivity(agents=["a", "b"], edges=[0, 1], distances=[math.nan]),
    ],
)
def test_malformed_connectivity_is_refused(message: RosMessage) -> None:
    """A connectivity without the agent, or with edges that lead nowhere, is refused."""
    with pytest.raises(WireError):
        wire.decode_neighbours(message, "a")
