"""Tests of ``tlcomm_tools.bag.compression``, also with other people's readers."""

import tracemalloc
from pathlib import Path

import lz4.frame  # type: ignore[import-untyped]
import pytest
import zstandard
from mcap.reader import make_reader
from rosbags.highlevel import AnyReader

from support.hand_made_run import AGENTS, SHARE, hand_made_records, serialize_run
from tlcomm_tools.bag.compression import Compression, compress, decompress
from tlcomm_tools.bag.container import read_container
from tlcomm_tools.bag.definitions import load_typestore, read_definition
from tlcomm_tools.bag.parsing import DECODING_ERRORS
from tlcomm_tools.bag.topics import recorded_topics
from tlcomm_tools.bag.writer import BagWriter

RECORDS = b"a record " * 1000


def write(folder: Path, compression: Compression) -> BagWriter:
    """Write the run made by hand."""
    store, topics = load_typestore(SHARE), recorded_topics(AGENTS)
    numbers = {topic.name: number for number, topic in enumerate(topics)}
    definitions = {topic.type: read_definition(store, topic.type) for topic in topics}
    with BagWriter(folder, topics, definitions, {}, compression=compression) as writer:
        for name, stamp_ns, data in serialize_run(store, hand_made_records()):
            writer.write(numbers[name], stamp_ns, data)
    return writer


@pytest.mark.parametrize("compression", Compression)
def test_every_reader_reads_it(tmp_path: Path, compression: Compression) -> None:
    """The libraries mcap and rosbags, and this project's own reader, find the same messages."""
    path = write(tmp_path / "bag", compression).path
    own = read_container(path, lambda _: True)
    with path.open("rb") as stream:
        reader = make_reader(stream, validate_crcs=True)
        summary = reader.get_summary()
        assert summary is not None
        assert {chunk.compression for chunk in summary.chunk_indexes} == {compression.tag}
        theirs = [(kept.channel_id, kept.data) for _, _, kept in reader.iter_messages()]
    assert sorted((number, data) for number, _, data in own.messages) == sorted(theirs)
    with AnyReader([tmp_path / "bag"]) as bags:
        assert [data for _, _, data in bags.messages()] != []
        assert bags.message_count == len(theirs)


def test_compressed_bags_are_smaller(tmp_path: Path) -> None:
    """By lz4 less than by zstd."""
    sizes = [write(tmp_path / own, own).path.stat().st_size for own in Compression]
    assert sizes == sorted(sizes, reverse=True)
    assert sizes[-1] < sizes[0] // 2


@pytest.mark.parametrize("compression", Compression)
def test_what_is_packed_is_unpacked(compression: Compression) -> None:
    """To the byte, and nothing at all, too."""
    for data in (RECORDS, b""):
        assert decompress(compress(data, compression), compression.tag, len(data)) == data


@pytest.mark.parametrize("compression", Compression)
@pytest.mark.parametrize("told", [0, 1, len(RECORDS) - 1, len(RECORDS) + 1, 2**62])
def test_no_more_is_unpacked_than_a_chunk_says(compression: Compression, told: int) -> None:
    """A chunk that says another size is damaged, however much it would unpack to."""
    packed = compress(RECORDS, compression)
    with pytest.raises(DECODING_ERRORS):
        decompress(packed, compression.tag, told)


@pytest.mark.parametrize("tells_size", [False, True])
def test_a_small_file_doesnt_fill_the_memory(tells_size: bool) -> None:
    """Frames that unpack to a thousand times as much are stopped at what the chunk says."""
    much = bytes(10**7)
    for tag, packed in (
        ("lz4", lz4.frame.compress(much, store_size=tells_size)),
        ("zstd", zstandard.ZstdCompressor(write_content_size=tells_size).compress(much)),
    ):
        tracemalloc.start()
        with pytest.raises(DECODING_ERRORS):
            decompress(packed, tag, 10)
        _, peak = tracemalloc.get_traced_memory()
        tracemalloc.stop()
        assert peak < len(much) // 10, tag


def test_an_unknown_way_is_refused() -> None:
    """With its name."""
    with pytest.raises(ValueError, match="unknown compression 'brotli'"):
        decompress(b"", "brotli", 0)
