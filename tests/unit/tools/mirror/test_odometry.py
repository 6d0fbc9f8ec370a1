"""Tests of ``tlcomm_tools.mirror.odometry``."""

import pytest

from support.hand_made_run import SHARE, hand_made_records, serialize_run
from tlcomm_tools import wire
from tlcomm_tools.bag.definitions import load_typestore
from tlcomm_tools.bag.topics import split_topic
from tlcomm_tools.mirror.odometry import decode_odometry

STORE = load_typestore(SHARE)
MESSAGES = [
    (split_topic(name)[0], data)
    for name, _, data in serialize_run(STORE, hand_made_records())
    if name.endswith("/odom")
]


def test_odometry_is_what_a_decoder_makes_of_it() -> None:
    """Of a whole run, to the bit."""
    for agent, data in MESSAGES:
        message = STORE.deserialize_cdr(data, "nav_msgs/msg/Odometry")
        assert decode_odometry(data, agent) == wire.read_odometry(message, agent)


@pytest.mark.parametrize("frames", [(a, b) for a in range(9) for b in range(9)])
def test_names_of_any_length_shift_what_follows(frames: tuple[int, int]) -> None:
    """The numbers are found behind frames' names of any length."""
    agent, data = MESSAGES[-1]
    message = STORE.deserialize_cdr(data, "nav_msgs/msg/Odometry")
    message.header.frame_id, message.child_frame_id = ("x" * length for length in frames)
    shifted = bytes(STORE.serialize_cdr(message, "nav_msgs/msg/Odometry"))
    assert decode_odometry(shifted, agent) == wire.read_odometry(message, agent)


@pytest.mark.parametrize("cut", [0, 3, 11, 20, 40, 200, 400])
def test_what_is_cut_is_refused(cut: int) -> None:
    """Too few bytes are no odometry, wherever they end."""
    agent, data = MESSAGES[0]
    with pytest.raises(ValueError, match="no "):
        decode_odometry(data[:cut], agent)


def test_other_encodings_are_refused() -> None:
    """Big-endian CDR isn't read as if it weren't."""
    agent, data = MESSAGES[0]
    with pytest.raises(ValueError, match="little-endian"):
        decode_odometry(b"\x00\x00" + data[2:], agent)
