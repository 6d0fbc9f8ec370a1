"""MCAP records as bytes (https://mcap.dev/spec, version 0, little-endian).

``Opcode``   the kinds of record
``record``   a record's framing
``string``, ``string_map``, ``header``, ``schema``, ``channel``, …   the contents
"""

import struct
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from enum import IntEnum
from zlib import crc32

__all__ = [
    "MAGIC",
    "ChunkPlace",
    "Opcode",
    "channel",
    "chunk",
    "chunk_index",
    "data_end",
    "end",
    "footer",
    "header",
    "message",
    "message_index",
    "metadata",
    "metadata_index",
    "record",
    "schema",
    "statistics",
    "string",
    "string_map",
    "summary_offset",
]

MAGIC = b"\x89MCAP0\r\n"
_MESSAGE = struct.Struct("<BQHIQQ")
_MESSAGE_FIELDS_SIZE = 22


class Opcode(IntEnum):
    """First byte of a record."""

    HEADER = 0x01
    FOOTER = 0x02
    SCHEMA = 0x03
    CHANNEL = 0x04
    MESSAGE = 0x05
    CHUNK = 0x06
    MESSAGE_INDEX = 0x07
    CHUNK_INDEX = 0x08
    STATISTICS = 0x0B
    METADATA = 0x0C
    METADATA_INDEX = 0x0D
    SUMMARY_OFFSET = 0x0E
    DATA_END = 0x0F


@dataclass(frozen=True, slots=True)
class ChunkPlace:
    """Where a chunk lies and what is in it, for the index.

    Attributes:
        span_ns: least and greatest log time inside.
        offset: of the chunk's record in the file.
        length: of that record.
        index_offsets: per channel, where its message index lies.
        index_length: of all message indexes together.
        sizes: of the records, compressed and not.
    """

    span_ns: tuple[int, int]
    offset: int
    length: int
    index_offsets: Mapping[int, int]
    index_length: int
    sizes: tuple[int, int]


def record(opcode: Opcode, content: bytes) -> bytes:
    """Frame a record."""
    return struct.pack("<BQ", opcode, len(content)) + content


def string(text: str) -> bytes:
    """Encode a length-prefixed string."""
    data = text.encode()
    return struct.pack("<I", len(data)) + data


def string_map(entries: Mapping[str, str]) -> bytes:
    """Encode a map of strings."""
    data = b"".join(string(key) + string(value) for key, value in entries.items())
    return struct.pack("<I", len(data)) + data


def _number_map(entries: Mapping[int, int]) -> bytes:
    data = b"".join(struct.pack("<HQ", key, value) for key, value in entries.items())
    return struct.pack("<I", len(data)) + data


def header(profile: str, library: str) -> bytes:
    """Encode the file's first record."""
    return record(Opcode.HEADER, string(profile) + string(library))


def schema(number: int, name: str, encoding: str, text: str) -> bytes:
    """Encode a message type's definition."""
    content = struct.pack("<H", number) + string(name) + string(encoding) + string(text)
    return record(Opcode.SCHEMA, content)


def channel(number: int, schema_number: int, topic: str, notes: Mapping[str, str]) -> bytes:
    """Encode a topic of CDR messages."""
    content = struct.pack("<HH", number, schema_number) + string(topic) + string("cdr")
    return record(Opcode.CHANNEL, content + string_map(notes))


def message(channel_number: int, sequence: int, log_ns: int, data: bytes) -> bytes:
    """Encode a message."""
    size = _MESSAGE_FIELDS_SIZE + len(data)
    return _MESSAGE.pack(Opcode.MESSAGE, size, channel_number, sequence, log_ns, log_ns) + data


def chunk(span_ns: tuple[int, int], contents: bytes, compressed: bytes, compression: str) -> bytes:
    """Encode a chunk of records."""
    content = struct.pack("<QQQI", *span_ns, len(contents), crc32(contents)) + string(compression)
    return record(Opcode.CHUNK, content + struct.pack("<Q", len(compressed)) + compressed)


def message_index(channel_number: int, places: Sequence[int]) -> bytes:
    """Encode where one channel's messages lie in a chunk: log times and offsets in turn."""
    data = struct.pack(f"<{len(places)}Q", *places)
    return record(Opcode.MESSAGE_INDEX, struct.pack("<HI", channel_number, len(data)) + data)


def chunk_index(place: ChunkPlace, compression: str) -> bytes:
    """Encode where a chunk lies."""
    content = struct.pack("<QQQQ", *place.span_ns, place.offset, place.length)
    content += _number_map(place.index_offsets) + struct.pack("<Q", place.index_length)
    return record(
        Opcode.CHUNK_INDEX, content + string(compression) + struct.pack("<QQ", *place.sizes)
    )


def metadata(name: str, entries: Mapping[str, str]) -> bytes:
    """Encode a named map of strings."""
    return record(Opcode.METADATA, string(name) + string_map(entries))


def metadata_index(name: str, offset: int, length: int) -> bytes:
    """Encode where a named map of strings lies."""
    return record(Opcode.METADATA_INDEX, struct.pack("<QQ", offset, length) + string(name))


def statistics(
    counts: Mapping[int, int], schemas: int, chunks: int, metadatas: int, span_ns: tuple[int, int]
) -> bytes:
    """Encode how much of what is in the file; ``counts`` has every channel."""
    content = struct.pack(
        "<QHIIIIQQ", sum(counts.values()), schemas, len(counts), 0, metadatas, chunks, *span_ns
    )
    return record(Opcode.STATISTICS, content + _number_map(counts))


def summary_offset(opcode: Opcode, start: int, length: int) -> bytes:
    """Encode where the summary's records of one kind lie."""
    return record(Opcode.SUMMARY_OFFSET, struct.pack("<BQQ", opcode, start, length))


def data_end() -> bytes:
    """Encode the end of the data (without a checksum over all of it)."""
    return record(Opcode.DATA_END, struct.pack("<I", 0))


def footer(summary: bytes, summary_start: int, offsets_start: int) -> bytes:
    """Encode the last record, with the summary's checksum."""
    head = struct.pack("<BQQQ", Opcode.FOOTER, 20, summary_start, offsets_start)
    return head + struct.pack("<I", crc32(head, crc32(summary)))


def end(start: int, groups: Sequence[tuple[Opcode, bytes]]) -> bytes:
    """Encode what comes behind the data: the summary, where what lies in it, and the end.

    Args:
        start: where the data end in the file.
        groups: the summary's records, those of one kind together.
    """
    ended = data_end()
    start += len(ended)
    summary, offsets = bytearray(), bytearray()
    for opcode, group in groups:
        if group:
            offsets += summary_offset(opcode, start + len(summary), len(group))
            summary += group
    offsets_start = start + len(summary)
    summary += offsets
    return ended + bytes(summary) + footer(bytes(summary), start, offsets_start) + MAGIC
