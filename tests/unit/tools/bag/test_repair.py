"""Tests of ``tlcomm_tools.bag.repair`` with other people's readers."""

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from mcap.reader import make_reader
from mcap.writer import CompressionType, Writer
from rosbags.highlevel import AnyReader

from support.hand_made_run import AGENTS, SHARE
from tlcomm_core.errors import InputError
from tlcomm_tools.bag.compression import Compression
from tlcomm_tools.bag.container import read_container
from tlcomm_tools.bag.definitions import load_typestore, read_definition
from tlcomm_tools.bag.repair import Repaired, inspect, repair
from tlcomm_tools.bag.topics import recorded_topics
from tlcomm_tools.bag.writer import BagWriter

CUTS = 40
# A serialized rosgraph_msgs/Clock.
DATA = bytes(12)


@pytest.fixture(scope="module", params=Compression)
def whole(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> bytes:
    """Return a bag's file of ten chunks with five messages each, of two topics."""
    store = load_typestore(SHARE)
    topics = recorded_topics(AGENTS)
    definitions = {topic.type: read_definition(store, topic.type) for topic in topics}
    folder = tmp_path_factory.mktemp("whole") / "bag"
    notes = {"scenario": "x"}
    with BagWriter(folder, topics, definitions, notes, compression=request.param) as writer:
        for number in range(50):
            writer.write(number % 2, number, DATA)
            if number % 5 == 4:
                writer.flush()
    return writer.path.read_bytes()


def held(path: Path) -> list[tuple[str, int, int, bytes]]:
    """Return all messages by the mcap library, found through summary and indexes, checked."""
    with path.open("rb") as stream:
        return [
            (channel.topic, message.log_time, message.sequence, message.data)
            for _, channel, message in make_reader(stream, validate_crcs=True).iter_messages()
        ]


def test_every_cut_is_repaired(tmp_path: Path, whole: bytes) -> None:
    """Wherever a file was cut, the whole chunks before it become a bag for every reader."""
    rng = np.random.default_rng(1)
    path = tmp_path / "cut.mcap"
    path.write_bytes(whole)
    everything = held(path)
    saved = 0
    for number in range(CUTS):
        path.write_bytes(whole[: rng.integers(8, len(whole))])
        count = len(read_container(path, lambda _: True).messages)
        folder = tmp_path / f"bag{number}"
        if count == 0:
            with pytest.raises(InputError, match="holds no message that can be read"):
                repair(path, folder)
            assert not folder.exists()
            continue
        assert repair(path, folder) == Repaired(count, count - 1)
        (file,) = folder.glob("*.mcap")
        assert held(file) == everything[:count]
        assert inspect(file).flaw == ""
        with AnyReader([folder]) as reader:
            assert reader.message_count == count
        saved += 1
    assert saved > CUTS // 4
    assert sorted(own.name for own in tmp_path.glob(".*")) == []


def test_a_whole_file_stays_the_same(tmp_path: Path, whole: bytes) -> None:
    """Indexes and summary are the writer's to the byte."""
    path = tmp_path / "a.mcap"
    path.write_bytes(whole)
    repair(path, tmp_path / "bag")
    assert (tmp_path / "bag" / "bag_0.mcap").read_bytes() == whole


def test_notes_and_qualities_are_kept(tmp_path: Path, whole: bytes) -> None:
    """What the bag says of its run and of its topics is in the new one as well."""
    path = tmp_path / "cut.mcap"
    path.write_bytes(whole[:-100])
    repair(path, tmp_path / "bag")
    before, after = (
        read_container(file, lambda _: False) for file in (path, tmp_path / "bag" / "bag_0.mcap")
    )
    assert (after.channels, after.metadata) == (before.channels, {"tlcomm": {"scenario": "x"}})
    with AnyReader([tmp_path / "bag"]) as reader:
        depths = {own.topic: own.ext.offered_qos_profiles[0].depth for own in reader.connections}
    assert (depths["/clock"], depths["/map"]) == (1000, 10)


@pytest.mark.parametrize(
    ("spoil", "flaw"),
    [
        (lambda data: data, "metadata.yaml is missing or doesn't fit the file"),
        (lambda data: data[:-1], "the file has no summary"),
        (lambda data: data[:-40] + b"?" + data[-39:], "the file has no summary"),
        (lambda data: data[: len(data) // 4], "the file has no end"),
    ],
)
def test_flaws(tmp_path: Path, whole: bytes, spoil: Callable[[bytes], bytes], flaw: str) -> None:
    """A bag without metadata.yaml, its last byte, an intact summary or its end isn't whole."""
    path = tmp_path / "a.mcap"
    path.write_bytes(spoil(whole))
    assert inspect(path).flaw == flaw


@pytest.mark.parametrize("compression", list(CompressionType))
@pytest.mark.parametrize("chunked", [True, False])
def test_other_writers_files(tmp_path: Path, compression: CompressionType, chunked: bool) -> None:
    """A file of the mcap library that was never finished is repaired, chunks or not."""
    path = tmp_path / "a.mcap"
    with path.open("wb") as stream:
        writer = Writer(stream, compression=compression, use_chunking=chunked, chunk_size=100)
        writer.start("ros2", "other")
        schema = writer.register_schema("std_msgs/msg/String", "ros2msg", b"string data")
        channel = writer.register_channel("/chatter", "cdr", schema)
        for number in range(9):
            writer.add_message(channel, number, b"%040d" % number, number + 100, number)
    repair(path, tmp_path / "bag")
    count = len(read_container(path, lambda _: True).messages)
    assert count > 5
    assert held(tmp_path / "bag" / "bag_0.mcap") == [
        ("/chatter", number, number, b"%040d" % number) for number in range(count)
    ]


def test_nothing_is_overwritten(tmp_path: Path, whole: bytes) -> None:
    """A folder that is there stays as it is."""
    path = tmp_path / "a.mcap"
    path.write_bytes(whole)
    (tmp_path / "bag").mkdir()
    with pytest.raises(InputError, match=r"bag' exists already: give another folder with -o"):
        repair(path, tmp_path / "bag")
