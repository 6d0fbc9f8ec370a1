"""Tests of ``tlcomm_tools.bag.stamps``: when a message was stamped."""

import pytest
from rosbags.typesys import Stores, get_types_from_msg, get_typestore
from rosbags.typesys.store import Typestore

from tlcomm_tools.bag.stamps import first_stamp_ns, stamp_reader

STAMP_NS = 7_000_000_009
KIND = "other/msg/Word"


def store_of(definition: str) -> Typestore:
    """Return a store with a message of this definition."""
    store = get_typestore(Stores.ROS2_JAZZY)
    store.register(get_types_from_msg(definition, KIND))
    return store


@pytest.mark.parametrize(
    "definition", ["std_msgs/Header header\nstring word", "string word\nstd_msgs/Header header"]
)
@pytest.mark.parametrize("little_endian", [True, False])
def test_a_stamp_is_read_wherever_it_is(definition: str, little_endian: bool) -> None:
    """At the front without decoding the rest, or behind; in either byte order."""
    store = store_of(definition)
    stamp = store.types["builtin_interfaces/msg/Time"](sec=7, nanosec=9)
    header = store.types["std_msgs/msg/Header"](stamp=stamp, frame_id="map")
    word = store.types[KIND](header=header, word="over")
    data = bytes(store.serialize_cdr(word, KIND, little_endian=little_endian))
    assert stamp_reader(store, KIND)(data) == STAMP_NS


@pytest.mark.parametrize("size", [0, 3, 11])
def test_what_is_too_short_has_no_stamp(size: int) -> None:
    """Whoever sent it."""
    with pytest.raises(ValueError, match=f"{size} bytes are no message with a stamp"):
        first_stamp_ns(bytes(size))
