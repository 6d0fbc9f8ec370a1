"""Tests of ``tlcomm_tools.bag.writer`` with other people's readers."""

import resource
import signal
import struct
import subprocess
import sys
from pathlib import Path
from zlib import crc32

import pytest
import yaml
import zstandard
from mcap.data_stream import ReadDataStream
from mcap.opcode import Opcode
from mcap.reader import make_reader
from mcap.records import Chunk, MessageIndex
from rosbags.highlevel import AnyReader
from rosbags.interfaces import QosDurability

from support.hand_made_run import AGENTS, SHARE, hand_made_records, write_bag
from tlcomm_tools.bag.container import read_container
from tlcomm_tools.bag.definitions import load_typestore, read_definition
from tlcomm_tools.bag.topics import recorded_topics
from tlcomm_tools.bag.writer import CHUNK_SIZE, BagWriter

TOPICS = recorded_topics(AGENTS)
CLOCK = 0
# A serialized rosgraph_msgs/Clock.
DATA = bytes([0, 1, 0, 0]) + (7).to_bytes(4, "little") + (9).to_bytes(4, "little")


class FakeClock:
    """A clock that a test sets."""

    now_s = 0.0

    def __call__(self) -> float:
        """Return the time."""
        return self.now_s


def open_bag(folder: Path, clock: FakeClock) -> BagWriter:
    """Return a writer that flushes every half second of the clock."""
    store = load_typestore(SHARE)
    definitions = {topic.type: read_definition(store, topic.type) for topic in TOPICS}
    return BagWriter(folder, TOPICS, definitions, {"scenario": "x"}, period_s=0.5, clock=clock)


def count_messages(path: Path) -> int:
    """Count the messages in a bag by the mcap library, checksums and all."""
    with path.open("rb") as stream:
        return sum(1 for _ in make_reader(stream, validate_crcs=True).iter_messages())


def test_rosbags_reads_the_same_messages(tmp_path: Path) -> None:
    """The rosbags library decodes every message with the definitions inside the bag."""
    records = hand_made_records()
    write_bag(tmp_path / "bag", records)
    with AnyReader([tmp_path / "bag"]) as reader:
        decoded = [
            (connection.topic, reader.deserialize(data, connection.msgtype))
            for connection, _, data in reader.messages()
        ]
    poses = [message.pose.pose.position.x for topic, message in decoded if topic == "/east/odom"]
    assert poses == [own.pose.x_m for own in records.odometry if own.agent == "east"]
    held = [message for topic, message in decoded if topic == "/west/team_strategy"]
    assert [message.strategies[1].agent for message in held] == ["west"] * 3


def test_mcap_reads_summary_and_notes(tmp_path: Path) -> None:
    """The mcap library finds profile, statistics, schemas, channels and notes in the summary."""
    writer = write_bag(tmp_path / "bag", hand_made_records())
    with writer.path.open("rb") as stream:
        reader = make_reader(stream, validate_crcs=True)
        summary = reader.get_summary()
        assert summary is not None
        assert summary.statistics is not None
        assert reader.get_header().profile == "ros2"
        assert summary.statistics.message_count == count_messages(writer.path)
        assert len(summary.channels) == summary.statistics.channel_count == len(TOPICS)
        assert {own.name for own in summary.schemas.values()} == {own.type for own in TOPICS}
        assert {own.encoding for own in summary.schemas.values()} == {"ros2msg"}
        (note,) = reader.iter_metadata()
    assert note.name == "tlcomm"
    assert note.metadata["scenario"].startswith("name: line")


def test_messages_of_one_topic_are_found_by_index(tmp_path: Path) -> None:
    """A reader that seeks by chunk and message indexes finds exactly a topic's messages."""
    records = hand_made_records()
    writer = write_bag(tmp_path / "bag", records)
    with writer.path.open("rb") as stream:
        found = list(make_reader(stream).iter_messages(topics=["/east/odom"]))
    times_ns = [message.log_time for _, _, message in found]
    assert times_ns == [own.stamp_ns for own in records.odometry if own.agent == "east"]


def test_message_indexes_point_at_their_messages(tmp_path: Path) -> None:
    """Each entry of each message index leads to a message of its channel and time."""
    writer = write_bag(tmp_path / "bag", hand_made_records())
    with writer.path.open("rb") as stream:
        summary = make_reader(stream).get_summary()
        assert summary is not None
        found = 0
        for place in summary.chunk_indexes:
            stream.seek(place.chunk_start_offset + 9)
            chunk = Chunk.read(ReadDataStream(stream))
            data = zstandard.decompress(chunk.data, chunk.uncompressed_size)
            for channel, offset in place.message_index_offsets.items():
                stream.seek(offset)
                assert stream.read(1)[0] == Opcode.MESSAGE_INDEX
                stream.seek(offset + 9)
                index = MessageIndex.read(ReadDataStream(stream))
                assert index.channel_id == channel
                for time_ns, position in index.records:
                    opcode, _, number, _, log_ns = struct.unpack_from("<BQHIQ", data, position)
                    assert (opcode, number, log_ns) == (Opcode.MESSAGE, channel, time_ns)
                    found += 1
    assert found == count_messages(writer.path)


def test_the_footer_has_the_summarys_checksum(tmp_path: Path) -> None:
    """The checksum covers the summary and the footer up to itself, as the format demands."""
    data = write_bag(tmp_path / "bag", hand_made_records()).path.read_bytes()
    start, _, checksum = struct.unpack("<QQI", data[-28:-8])
    assert data[-37] == Opcode.FOOTER
    assert crc32(data[start:-12]) == checksum


def test_metadata_has_counts_and_qualities(tmp_path: Path) -> None:
    """metadata.yaml counts each topic's messages, and offers map and strategies latched."""
    records = hand_made_records()
    write_bag(tmp_path / "bag", records)
    text = (tmp_path / "bag" / "metadata.yaml").read_text("utf-8")
    told = yaml.safe_load(text)["rosbag2_bagfile_information"]
    counts = {
        own["topic_metadata"]["name"]: own["message_count"]
        for own in told["topics_with_message_count"]
    }
    assert counts["/connectivity"] == len(records.connectivity)
    assert counts["/clock"] == 0
    assert told["message_count"] == sum(counts.values())
    assert told["duration"]["nanoseconds"] == 25_000_000_000
    with AnyReader([tmp_path / "bag"]) as reader:
        latched = {
            own.topic
            for own in reader.connections
            if own.ext.offered_qos_profiles[0].durability is QosDurability.TRANSIENT_LOCAL
        }
    assert latched == {"/map", "/east/team_strategy", "/west/team_strategy"}


def test_the_bag_is_whole_after_each_flush(tmp_path: Path) -> None:
    """An open bag is a complete file with everything up to the last flush."""
    clock = FakeClock()
    writer = open_bag(tmp_path / "bag", clock)
    for number in range(5):
        writer.write(CLOCK, number, DATA)
        assert count_messages(writer.path) == number
        clock.now_s += 1.0
        writer.flush_if_due()
        assert count_messages(writer.path) == number + 1
        with AnyReader([tmp_path / "bag"]) as reader:
            assert reader.message_count == number + 1
    writer.close()


def test_a_flush_is_due_when_its_period_is_over(tmp_path: Path) -> None:
    """Nothing gets into the file before its period is over, and all does after it."""
    clock = FakeClock()
    writer = open_bag(tmp_path / "bag", clock)
    writer.write(CLOCK, 0, DATA)
    clock.now_s = 0.4
    writer.write(CLOCK, 1, DATA)
    writer.flush_if_due()
    assert count_messages(writer.path) == 0
    clock.now_s = 0.5
    writer.write(CLOCK, 2, DATA)
    assert count_messages(writer.path) == 0
    writer.flush_if_due()
    assert count_messages(writer.path) == 3
    writer.close()


def test_a_flush_is_due_when_a_chunk_is_full(tmp_path: Path) -> None:
    """However short the time, no more than a chunk is held back."""
    writer = open_bag(tmp_path / "bag", FakeClock())
    count = CHUNK_SIZE // len(DATA)
    for number in range(count):
        writer.write(CLOCK, number, DATA)
        writer.flush_if_due()
    assert 0 < count_messages(writer.path) < count
    writer.close()
    assert count_messages(writer.path) == count


def test_a_killed_writer_leaves_a_whole_bag(tmp_path: Path) -> None:
    """SIGKILL in the middle of writing leaves what was flushed, for every reader."""
    code = f"""
import sys
sys.path[:0] = {sys.path!r}
from pathlib import Path
from test_writer import CLOCK, DATA, FakeClock, open_bag
clock = FakeClock()
writer = open_bag(Path({str(tmp_path / "bag")!r}), clock)
for number in range(1000):
    writer.write(CLOCK, number, DATA)
    writer.flush_if_due()
    clock.now_s += 0.1
print("written", flush=True)
while True:
    writer.write(CLOCK, 1000, DATA)
    writer.flush_if_due()
"""
    environment = {"PYTHONPATH": str(Path(__file__).parent)}
    with subprocess.Popen(
        [sys.executable, "-c", code], stdout=subprocess.PIPE, env=environment
    ) as process:
        assert process.stdout is not None
        assert process.stdout.readline() == b"written\n"
        process.send_signal(signal.SIGKILL)
    (path,) = (tmp_path / "bag").glob("*.mcap")
    assert count_messages(path) >= 990
    assert read_container(path, lambda _: True).damage == ""
    with AnyReader([tmp_path / "bag"]) as reader:
        assert reader.message_count >= 990


def test_a_full_disk_leaves_what_was_written(tmp_path: Path) -> None:
    """When a flush fails the file is as after the flush before it, and the error comes up."""
    writer = open_bag(tmp_path / "bag", FakeClock())
    writer.write(CLOCK, 1, DATA)
    writer.flush()
    size = writer.path.stat().st_size
    writer.write(CLOCK, 2, DATA)
    soft, hard = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (size + 10, hard))
    try:
        with pytest.raises(OSError, match="File too large"):
            writer.flush()
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, (soft, hard))
    assert count_messages(writer.path) == 1
    writer.close()
    assert count_messages(writer.path) == 1


def test_an_existing_folder_is_refused(tmp_path: Path) -> None:
    """A bag never goes where something is already."""
    with pytest.raises(FileExistsError):
        open_bag(tmp_path, FakeClock())
