"""Tests of ``tlcomm_tools.bag.reader``: bags as records."""

import re
import shutil
from pathlib import Path
from types import SimpleNamespace

import pytest
from rosbags.rosbag2 import StoragePlugin, Writer
from rosbags.typesys import Stores, get_typestore

from support.hand_made_run import (
    AGENTS,
    BYTES,
    MESSAGES,
    SHARE,
    hand_made_records,
    serialize_run,
    write_bag,
)
from tlcomm_core.errors import InputError
from tlcomm_core.records import EstimateRecord, RunRecords, event_log
from tlcomm_core.world.observation import Connectivity
from tlcomm_tools.bag.definitions import load_typestore
from tlcomm_tools.bag.reader import read_run
from tlcomm_tools.bag.topics import recorded_topics
from tlcomm_tools.wire import read_connectivity


def assert_equal(read: RunRecords, written: RunRecords) -> None:
    """Compare everything; of lists what isn't ordered by time is ordered by agent."""
    assert list(event_log(read)) == list(event_log(written))
    assert sorted(read.odometry, key=repr) == sorted(written.odometry, key=repr)
    assert read.connectivity == written.connectivity
    assert read.estimates == written.estimates
    assert sorted(read.timings, key=repr) == sorted(written.timings, key=repr)
    assert read.messages_sent == written.messages_sent
    assert read.bytes_sent == written.bytes_sent
    assert read.messages_undelivered == written.messages_undelivered
    assert sorted(read.said, key=repr) == sorted(written.said, key=repr)
    assert sorted(read.heard, key=repr) == sorted(written.heard, key=repr)
    assert read.heard_until_ns == written.heard_until_ns


def test_a_connectivity_of_before_has_no_distances() -> None:
    """Bags from before they were told can still be read."""
    header = SimpleNamespace(stamp=SimpleNamespace(sec=1, nanosec=2))
    old = SimpleNamespace(header=header, edges=[0, 1], connected=True)
    assert read_connectivity(old) == Connectivity(1_000_000_002, ((0, 1),), connected=True)


def test_a_bag_gives_back_the_records(tmp_path: Path) -> None:
    """What is written is read: the records are equal."""
    records = hand_made_records()
    write_bag(tmp_path / "bag", records)
    run = read_run(tmp_path / "bag")
    assert_equal(run.records, records)
    assert (run.agents, run.end_ns, run.damage) == (AGENTS, 25_000_000_000, "")
    assert run.notes["scenario"].startswith("name: line")


def test_a_bag_gives_back_estimates(tmp_path: Path) -> None:
    """Of those that have measured and of those that have only heard, in order of time."""
    records = hand_made_records()
    records.estimates = [
        EstimateRecord(1_000_000_000, "west", 2.5, 2.5, has_measurement=True),
        EstimateRecord(1_500_000_000, "east", 2.25, 0.0, has_measurement=False),
    ]
    write_bag(tmp_path / "bag", records)
    assert_equal(read_run(tmp_path / "bag").records, records)


def test_records_are_in_order_of_time(tmp_path: Path) -> None:
    """Each list is ordered by its stamps, whatever the order in the bag."""
    store = load_typestore(SHARE)
    with Writer(tmp_path / "bag", version=9, storage_plugin=StoragePlugin.MCAP) as writer:
        connections = {
            topic.name: writer.add_connection(topic.name, topic.type, typestore=store)
            for topic in recorded_topics(AGENTS)
        }
        for name, _, data in reversed(list(serialize_run(store, hand_made_records()))):
            writer.write(connections[name], 0, data)
    records = read_run(tmp_path / "bag").records
    for entries in (records.odometry, records.connectivity, records.tasks, records.strategies):
        stamps_ns = [entry.stamp_ns for entry in entries]
        assert stamps_ns == sorted(stamps_ns)


def test_run_folder_bag_folder_and_file_are_the_same(tmp_path: Path) -> None:
    """The same bag is found from its run's folder, its own folder and its file."""
    writer = write_bag(tmp_path / "bag", hand_made_records())
    runs = [read_run(path) for path in (tmp_path, tmp_path / "bag", writer.path)]
    assert all(run.records == runs[0].records for run in runs)


def test_a_bag_of_another_writer(tmp_path: Path) -> None:
    """A bag made by the rosbags library, without our notes, gives the same records.

    It logs when messages came in, by the wall clock; the run ends by the messages' own stamps.
    """
    records = hand_made_records()
    store = load_typestore(SHARE)
    with Writer(tmp_path / "bag", version=9, storage_plugin=StoragePlugin.MCAP) as writer:
        connections = {
            topic.name: writer.add_connection(topic.name, topic.type, typestore=store)
            for topic in recorded_topics(AGENTS)
        }
        for number, (name, _, data) in enumerate(serialize_run(store, records)):
            writer.write(connections[name], 1_800_000_000_000_000_000 + number, data)
    run = read_run(tmp_path / "bag")
    assert_equal(run.records, records)
    assert run.notes == {}
    assert run.end_ns == 25_000_000_000


def test_a_bag_in_several_files(tmp_path: Path) -> None:
    """The files of a split bag are read that metadata.yaml lists, and no others."""
    early, late = hand_made_records(), hand_made_records()
    for own in (early.odometry, early.connectivity, early.tasks, early.strategies, early.said):
        own[:] = [entry for entry in own if entry.stamp_ns < 10_000_000_000]
    for own in (late.odometry, late.connectivity, late.tasks, late.strategies, late.said):
        own[:] = [entry for entry in own if entry.stamp_ns >= 10_000_000_000]
    late.timings = []
    first = write_bag(tmp_path / "bag", early).path
    second = write_bag(tmp_path / "more", late).path
    shutil.copy(second, tmp_path / "bag" / "stray.mcap")
    shutil.move(second, tmp_path / "bag" / "a_before_all.mcap")
    metadata = tmp_path / "bag" / "metadata.yaml"
    metadata.write_text(
        metadata.read_text("utf-8").replace(
            f"relative_file_paths:\n    - {first.name}",
            f"relative_file_paths:\n    - {first.name}\n    - a_before_all.mcap",
        ),
        "utf-8",
    )
    run = read_run(tmp_path / "bag")
    assert list(event_log(run.records)) == list(event_log(hand_made_records()))
    assert run.records.messages_sent == MESSAGES
    assert run.records.bytes_sent == BYTES


def test_a_bag_without_metadata(tmp_path: Path) -> None:
    """metadata.yaml may be missing, or say nothing true."""
    write_bag(tmp_path / "bag", hand_made_records())
    metadata = tmp_path / "bag" / "metadata.yaml"
    for text in ("rosbag2_bagfile_information: {relative_file_paths: [gone.mcap]}", "[", "7"):
        metadata.write_text(text, "utf-8")
        assert len(read_run(tmp_path / "bag").records.tasks) == len(hand_made_records().tasks)
    metadata.unlink()
    assert len(read_run(tmp_path / "bag").records.tasks) == len(hand_made_records().tasks)


def test_a_cut_bag_is_read_with_a_note(tmp_path: Path) -> None:
    """A bag without its end gives its records, and says what is wrong."""
    writer = write_bag(tmp_path / "bag", hand_made_records())
    data = writer.path.read_bytes()
    end = data.index(b"\x0f\x04\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00")
    writer.path.write_bytes(data[:end])
    run = read_run(tmp_path)
    assert run.damage == "the file has no end"
    assert_equal(run.records, hand_made_records())


def make_foreign_bag(folder: Path) -> None:
    """Write a bag of something else."""
    store = get_typestore(Stores.ROS2_JAZZY)
    with Writer(folder, version=9, storage_plugin=StoragePlugin.MCAP) as writer:
        connection = writer.add_connection("/chatter", "std_msgs/msg/String", typestore=store)
        message = store.types["std_msgs/msg/String"](data="hello")
        writer.write(connection, 1, store.serialize_cdr(message, "std_msgs/msg/String"))


def make_sqlite_bag(folder: Path) -> None:
    """Write a bag that isn't MCAP."""
    with Writer(folder, version=9, storage_plugin=StoragePlugin.SQLITE3):
        pass


def make_empty_bag(folder: Path) -> None:
    """Write a bag without messages."""
    records = RunRecords(messages_sent={})
    write_bag(folder, records)


@pytest.mark.parametrize(
    ("make", "complaint"),
    [
        (lambda _: None, "doesn't exist"),
        (Path.mkdir, "holds no bag"),
        (make_foreign_bag, "is no bag of a tlcomm run: it has no topic 'connectivity'"),
        (make_sqlite_bag, "is an SQLite bag"),
        (make_empty_bag, "is empty: it holds no messages of a run"),
    ],
)
def test_bad_bags_are_input_errors(tmp_path: Path, make: object, complaint: str) -> None:
    """Whatever isn't a run's bag gives one line with its name and the reason."""
    assert callable(make)
    make(tmp_path / "bag")
    with pytest.raises(InputError, match=re.escape(complaint)) as caught:
        read_run(tmp_path / "bag")
    assert "bag" in str(caught.value)
    assert "\n" not in str(caught.value)


def test_a_message_that_is_nonsense_is_an_input_error(tmp_path: Path) -> None:
    """A message that can't be decoded is told with the bag's name."""
    store = load_typestore(SHARE)
    with Writer(tmp_path / "bag", version=9, storage_plugin=StoragePlugin.MCAP) as writer:
        connections = {
            topic.name: writer.add_connection(topic.name, topic.type, typestore=store)
            for topic in recorded_topics(AGENTS)
        }
        writer.write(connections["/east/task_event"], 1, b"\0\1\0\0nonsense")
    with pytest.raises(InputError, match="can't be decoded"):
        read_run(tmp_path / "bag")
