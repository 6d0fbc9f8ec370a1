"""Tests of ``tlcomm_tools.bag.container`` on whole, cut and foreign files."""

import struct
from io import BytesIO
from pathlib import Path

import pytest
import zstandard
from mcap.writer import CompressionType, Writer

from support.hand_made_run import hand_made_records, write_bag
from tlcomm_core.errors import InputError
from tlcomm_tools.bag.container import Channel, Container, read_container
from tlcomm_tools.bag.records import MAGIC, Opcode, record, string


def read(path: Path) -> Container:
    """Read all channels."""
    return read_container(path, lambda _: True)


def write_foreign(path: Path, compression: CompressionType, *, chunked: bool = True) -> None:
    """Write two messages with the mcap library."""
    stream = BytesIO()
    writer = Writer(stream, compression=compression, use_chunking=chunked)
    writer.start("ros2", "other")
    schema = writer.register_schema("std_msgs/msg/String", "ros2msg", b"string data")
    channel = writer.register_channel("/chatter", "cdr", schema)
    writer.add_message(channel, 5, b"one", 5)
    writer.add_message(channel, 3, b"two", 3)
    writer.finish()
    path.write_bytes(stream.getvalue())


@pytest.mark.parametrize("compression", list(CompressionType))
@pytest.mark.parametrize("chunked", [True, False])
def test_other_writers_files(tmp_path: Path, compression: CompressionType, chunked: bool) -> None:
    """Files of the mcap library are read with every compression, and without chunks."""
    write_foreign(tmp_path / "a.mcap", compression, chunked=chunked)
    container = read(tmp_path / "a.mcap")
    assert container.channels == {
        1: Channel("/chatter", "std_msgs/msg/String", "cdr", "string data", "ros2msg")
    }
    assert container.messages == [(1, 5, b"one"), (1, 3, b"two")]
    assert (container.counts, container.end_ns, container.damage) == ({1: 2}, 5, "")
    assert container.lengths == {1: 8}


def test_unwanted_messages_are_only_counted(tmp_path: Path) -> None:
    """What isn't wanted isn't kept, but counts, lengths and times include it."""
    write_foreign(tmp_path / "a.mcap", CompressionType.NONE)
    container = read_container(tmp_path / "a.mcap", lambda _: False)
    assert (container.messages, container.counts, container.end_ns) == ([], {1: 2}, 5)
    assert container.lengths == {1: 8}


def test_every_cut_of_a_file_is_readable(tmp_path: Path) -> None:
    """A file cut anywhere after its magic gives the messages before the cut, and says so."""
    path = write_bag(tmp_path / "bag", hand_made_records()).path
    whole = path.read_bytes()
    counts = []
    for length in range(8, len(whole), 97):
        path.write_bytes(whole[:length])
        container = read(path)
        counts.append(len(container.messages))
        assert container.damage in {"", "the file has no end"}
    assert counts == sorted(counts)
    assert counts[0] == 0
    assert counts[-1] == len(read_whole(path, whole).messages)


def read_whole(path: Path, whole: bytes) -> Container:
    """Read the whole file; nothing is wrong with it."""
    path.write_bytes(whole)
    container = read(path)
    assert container.damage == ""
    return container


def test_every_flipped_byte_is_survived(tmp_path: Path) -> None:
    """A damaged byte never raises anything: what is before the damage is read, the rest noted."""
    path = write_bag(tmp_path / "bag", hand_made_records()).path
    whole = path.read_bytes()
    noted = 0
    for position in range(8, len(whole), 131):
        path.write_bytes(whole[:position] + bytes([whole[position] ^ 0xFF]) + whole[position + 1 :])
        noted += read(path).damage != ""
    assert noted > 0


@pytest.mark.parametrize("size", [2**60, 2**64 - 1])
def test_a_chunk_larger_than_memory_is_damage(tmp_path: Path, size: int) -> None:
    """However large it says that it is: nothing is read of it."""
    data = zstandard.ZstdCompressor(write_content_size=False).compress(bytes(1000))
    content = struct.pack("<QQQI", 0, 0, size, 0) + string("zstd") + struct.pack("<Q", len(data))
    (tmp_path / "a.mcap").write_bytes(MAGIC + record(Opcode.CHUNK, content + data))
    assert read(tmp_path / "a.mcap").damage.startswith("a damaged record")


@pytest.mark.parametrize("content", [b"", b"\x89MCAP", b"SQLite format 3\0 and more"])
def test_other_files_are_refused(tmp_path: Path, content: bytes) -> None:
    """A file without the magic isn't MCAP."""
    (tmp_path / "a.mcap").write_bytes(content)
    with pytest.raises(InputError, match="is no MCAP file"):
        read(tmp_path / "a.mcap")


def test_an_unreadable_file_is_an_input_error(tmp_path: Path) -> None:
    """A file that isn't there gives the reason and its name."""
    with pytest.raises(InputError, match=r"can't read .*b\.mcap.*No such file"):
        read(tmp_path / "b.mcap")
