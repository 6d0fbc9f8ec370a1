"""Tests of ``tlcomm_tools.mirror.mirror``, also with other people's readers."""

import subprocess
import sys
from collections import Counter
from pathlib import Path

import pytest

from support.hand_made_run import AGENTS, SHARE, hand_made_records, serialize_run
from support.mirroring import TOPICS, make_mirror, mirror_run, write_mirrored_bag
from tlcomm_core.units import nanoseconds
from tlcomm_tools.bag.definitions import load_typestore, read_definition
from tlcomm_tools.bag.reader import read_run

# What a machine without ROS and without this project has not.
_ALONE = """
import sys
class Absent:
    def find_spec(self, name, path=None, target=None):
        first = name.partition(".")[0]
        if first.startswith(("tlcomm", "rcl")) or first.endswith(("_msgs", "_interfaces")):
            raise ModuleNotFoundError(name)
sys.meta_path.insert(0, Absent())
path, counts = sys.argv[1], {}
"""
_READERS = {
    "rosbags": """
from pathlib import Path
from rosbags.highlevel import AnyReader
with AnyReader([Path(path).parent]) as reader:
    for connection, _, data in reader.messages():
        message = reader.deserialize(data, connection.msgtype)
        counts[connection.topic] = counts.get(connection.topic, 0) + 1
""",
    "mcap-ros2-support": """
from mcap_ros2.reader import read_ros2_messages
for own in read_ros2_messages(path):
    assert own.ros_msg is not None
    counts[own.channel.topic] = counts.get(own.channel.topic, 0) + 1
""",
    "mcap": """
from mcap.reader import make_reader
from mcap_ros2.decoder import DecoderFactory
with open(path, "rb") as stream:
    reader = make_reader(stream, validate_crcs=True, decoder_factories=[DecoderFactory()])
    for _, channel, _, message in reader.iter_decoded_messages():
        counts[channel.topic] = counts.get(channel.topic, 0) + 1
""",
}


@pytest.mark.parametrize("library", _READERS)
def test_other_people_decode_every_message(tmp_path: Path, library: str) -> None:
    """By the definitions inside alone: without ROS, and without this project."""
    path = write_mirrored_bag(tmp_path / "bag")
    code = f"{_ALONE}{_READERS[library]}print(sorted(counts.items()))"
    done = subprocess.run(
        [sys.executable, "-I", "-c", code, str(path)],
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    store = load_typestore(SHARE)
    expected = Counter(name for name, _, _ in serialize_run(store, hand_made_records()))
    expected.update(name for name, _ in mirror_run(25.0))
    assert done.stdout.strip() == str(sorted(expected.items()))


def test_mirrors_change_nothing_about_a_run(tmp_path: Path) -> None:
    """The records read from a bag with mirrors are those that were written."""
    write_mirrored_bag(tmp_path / "bag")
    run = read_run(tmp_path / "bag")
    assert run.damage == ""
    assert run.records.odometry == hand_made_records().odometry
    assert run.records.messages_sent == hand_made_records().messages_sent


def test_mirrors_come_at_whole_seconds() -> None:
    """Paths at every second one, the others at each from 0 on; the regions stay."""
    times_s: dict[str, list[float]] = {}
    for name, time_s in mirror_run(4.9):
        times_s.setdefault(name, []).append(time_s)
    assert times_s.pop("/region_markers") == [0.0]
    assert times_s.pop("/team_markers") == [0.0, 1.0, 2.0, 3.0, 4.0]
    assert times_s.pop("/diagnostics") == [0.0, 1.0, 2.0, 3.0, 4.0]
    assert sorted(times_s) == [f"/{name}/{kind}" for name in AGENTS for kind in ("plan", "trail")]
    assert all(own == [0.0, 2.0, 4.0] for own in times_s.values())


def test_mirrors_dont_depend_on_the_order_of_arrival() -> None:
    """Topics overtake each other, and time goes on by larger or smaller steps."""
    store = load_typestore(SHARE)
    rows = [
        ([topic.name for topic in TOPICS].index(name), stamp_ns, data)
        for name, stamp_ns, data in serialize_run(store, hand_made_records())
    ]
    at_once, by_steps = make_mirror(store), make_mirror(store)
    for row in sorted(rows):
        at_once.take(*row)
    for row in rows:
        by_steps.take(*row)
    made = [own for step in range(25) for own in by_steps.advance(nanoseconds(step + 0.5))]
    assert list(at_once.advance(nanoseconds(24.5))) == made


def test_a_message_that_makes_no_sense_is_passed_over() -> None:
    """An event of a kind that nobody knows shows nothing, and mirrors go on."""
    store = load_typestore(SHARE)
    mirror = make_mirror(store)
    event = "tlcomm_msgs/msg/TaskEvent"
    number = [topic.type for topic in TOPICS].index(event)
    rows = serialize_run(store, hand_made_records())
    data = next(data for name, _, data in rows if name.endswith("task_event"))
    message = store.deserialize_cdr(data, event)
    message.kind = 99
    mirror.take(number, 0, bytes(store.serialize_cdr(message, event)))
    assert list(mirror.advance(0))


def test_no_topic_has_bounded_arrays() -> None:
    """Some viewers can't show them."""
    store = load_typestore(SHARE)
    types = {topic.type for topic in (*TOPICS, *make_mirror(store).topics)}
    own = [name for name in types if name.startswith("tlcomm_msgs/")]
    texts = [read_definition(store, name).text for name in own]
    lines = [line.partition("#")[0] for text in texts for line in text.splitlines()]
    assert own
    assert [line for line in lines if "<=" in line] == []
