"""Many messages read at once: where numbers lie in them."""

import math

import pytest

from support.hand_made_run import SHARE, hand_made_records, serialize_run
from tlcomm_core.geometry import Pose
from tlcomm_tools.bag.definitions import load_typestore
from tlcomm_tools.bag.layout import Layout
from tlcomm_tools.bag.poses import read_poses

STORE = load_typestore(SHARE)
ODOMETRY = "nav_msgs/msg/Odometry"
EVENT = "tlcomm_msgs/msg/TaskEvent"


def stored(topic: str) -> list[bytes]:
    """Return the messages on a topic of the run made by hand."""
    rows = serialize_run(STORE, hand_made_records())
    return [data for name, _, data in rows if name == topic]


def test_poses_at_once_are_those_one_by_one() -> None:
    """To the bit, for both agents, whose names differ in length from others'."""
    for agent in ("east", "west"):
        messages = stored(f"/{agent}/odom")
        expected = [own for own in hand_made_records().odometry if own.agent == agent]
        assert Layout.of(STORE, ODOMETRY, messages[0]) is not None
        assert read_poses(STORE, agent, messages) == expected


def test_poses_laid_out_otherwise_are_read_one_by_one() -> None:
    """Frames of another length, and the other order of bytes, in between."""
    messages = stored("/east/odom")
    message = STORE.deserialize_cdr(messages[1], ODOMETRY)
    message.child_frame_id += "_long"
    longer = bytes(STORE.serialize_cdr(message, ODOMETRY))
    swapped = bytes(STORE.serialize_cdr(message, ODOMETRY, little_endian=False))
    plain = read_poses(STORE, "east", messages[:3])
    for other in (longer, swapped):
        mixed = [messages[0], other, messages[2]]
        assert read_poses(STORE, "east", mixed) == plain
        assert read_poses(STORE, "east", mixed[1:]) == plain[1:]


def test_equal_sizes_are_not_equal_layouts() -> None:
    """One string longer and another shorter: the same bytes in all, elsewhere."""
    first = STORE.deserialize_cdr(stored("/east/odom")[0], ODOMETRY)
    first.header.frame_id, first.child_frame_id = "a" * 7, "b" * 15
    one = bytes(STORE.serialize_cdr(first, ODOMETRY))
    first.header.frame_id, first.child_frame_id = "a" * 15, "b" * 7
    other = bytes(STORE.serialize_cdr(first, ODOMETRY))
    layout = Layout.of(STORE, ODOMETRY, one)
    assert layout is not None
    assert len(one) == len(other)
    assert layout.columns([one, other], ["pose.pose.position.x"]) is None
    assert layout.columns([one, one], ["pose.pose.position.y"]) is not None
    assert layout.columns([one], ["pose.pose.height"]) is None


def test_no_poses_are_none() -> None:
    """A topic without messages."""
    assert read_poses(STORE, "east", []) == []


def test_a_number_that_is_none_is_read() -> None:
    """The audit is to name it."""
    message = STORE.deserialize_cdr(stored("/east/odom")[0], ODOMETRY)
    message.pose.pose.position.x = math.nan
    (read,) = read_poses(STORE, "east", [bytes(STORE.serialize_cdr(message, ODOMETRY))])
    assert math.isnan(read.pose.x_m)
    assert isinstance(read.pose, Pose)


@pytest.mark.parametrize("sample", [b"", b"\x00\x01", b"\x00\x01\x00\x00" + b"\xff" * 12])
def test_what_cannot_be_followed_has_no_layout(sample: bytes) -> None:
    """Too short, or with a string that is longer than the message."""
    assert Layout.of(STORE, ODOMETRY, sample) is None


def test_sequences_make_no_layout() -> None:
    """Their lengths are what makes messages differ."""
    strategy = stored("/east/team_strategy")[0]
    assert Layout.of(STORE, "tlcomm_msgs/msg/TeamStrategy", strategy) is None
    assert Layout.of(STORE, EVENT, stored("/east/task_event")[0]) is not None
