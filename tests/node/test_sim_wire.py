"""The sim's messages and the core's values, with the real message classes."""

import math

from hypothesis import given
from hypothesis import strategies as st
from nav_msgs.msg import Odometry as OdometryMessage
from rclpy.serialization import deserialize_message, serialize_message
from rosgraph_msgs.msg import Clock

from tlcomm_agent.wire import decode_odometry, encode_drive
from tlcomm_core.agent.actions import Drive
from tlcomm_core.geometry import Pose
from tlcomm_core.wire.world_messages import decode_command
from tlcomm_core.world.observation import Odometry
from tlcomm_msgs import msg
from tlcomm_sim import wire
from tlcomm_sim.outputs import Answer, Tick

FLOATS = st.floats(allow_nan=False, allow_infinity=False)
YAWS = st.floats(-math.pi, math.pi, exclude_min=True).map(
    lambda yaw_rad: Pose(0.0, 0.0, yaw_rad).as_transmitted().yaw_rad
)
STAMPS_NS = st.integers(0, 2**31 * 10**9 - 1)
COUNTS = st.integers(0, 2**64 - 1)


@given(
    st.builds(
        Odometry, STAMPS_NS, st.just("a"), st.builds(Pose, FLOATS, FLOATS, YAWS), FLOATS, FLOATS
    )
)
def test_agents_read_the_bits_of_the_world(odometry: Odometry) -> None:
    """An agent decodes exactly the odometry that the world has shown, the yaw included."""
    data = serialize_message(wire.encode_odometry(odometry))
    assert decode_odometry(deserialize_message(data, OdometryMessage), "a") == odometry


def test_yaws_are_exact_all_around() -> None:
    """No yaw comes back as its neighbour: a dense sweep, where one in thirty would."""
    for step in range(20_000):
        yaw_rad = Pose(0.0, 0.0, -math.pi + math.tau * (step + 0.5) / 20_000).as_transmitted()
        odometry = Odometry(0, "a", yaw_rad, 0.0, 0.0)
        assert decode_odometry(wire.encode_odometry(odometry), "a").pose == yaw_rad


@given(FLOATS, FLOATS)
def test_the_sim_reads_what_agents_command(linear_mps: float, angular_radps: float) -> None:
    """A command comes back as its velocities."""
    message = encode_drive(Drive(linear_mps, angular_radps), "a", 0)
    assert decode_command(message) == (linear_mps, angular_radps)


@given(STAMPS_NS)
def test_clock(time_ns: int) -> None:
    """The clock is exact."""
    message = deserialize_message(serialize_message(wire.encode_clock(time_ns)), Clock)
    assert message.clock.sec * 10**9 + message.clock.nanosec == time_ns


@given(
    st.builds(
        Tick,
        COUNTS,
        st.integers(0, 2**63 - 1),
        COUNTS,
        COUNTS,
        COUNTS,
        COUNTS,
        st.lists(COUNTS, max_size=5).map(tuple),
        stop=st.booleans(),
    )
)
def test_tick(tick: Tick) -> None:
    """A tick's message has all its fields."""
    message = deserialize_message(serialize_message(wire.encode_tick(tick)), msg.Tick)
    fields = {name: getattr(message, name) for name in message.get_fields_and_field_types()}
    assert Tick(**{**fields, "agent_counts": tuple(message.agent_counts)}) == tick


@given(st.integers(-(2**63), 2**63 - 1), st.booleans(), COUNTS, st.booleans())
def test_answer(need_ns: int, has_need: bool, count: int, ready: bool) -> None:
    """An answer's fields are the message's; a need that isn't there is None."""
    message = msg.TickReply(
        agent="a",
        sequence=count,
        ready=ready,
        has_next_need=has_need,
        next_need_ns=need_ns,
        team_messages=count,
        commands=1,
        published=2,
        meetings_ended=3,
    )
    expected = Answer("a", count, ready, need_ns if has_need else None, count, 1, 2, 3)
    assert wire.decode_answer(message) == expected
