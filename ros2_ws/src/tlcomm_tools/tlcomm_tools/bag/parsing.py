"""MCAP records from bytes: the other way round from ``records``.

``DamageError``       a file can't be read on from here
``DECODING_ERRORS``   what decoding a damaged record raises
``read_records``      a file's records, one by one
``read_string``, ``read_map``   parts of a record
``read_chunk``        the records inside a chunk, as bytes
``RECORD``, ``MESSAGE``   the framing of a record, the fields before a message's data
"""

import struct
from collections.abc import Iterator
from typing import BinaryIO, Final
from zlib import crc32

import zstandard

from tlcomm_tools.bag.compression import decompress

__all__ = [
    "DECODING_ERRORS",
    "MESSAGE",
    "RECORD",
    "DamageError",
    "read_chunk",
    "read_map",
    "read_records",
    "read_string",
]

RECORD: Final = struct.Struct("<BQ")
MESSAGE: Final = struct.Struct("<HIQQ")
DECODING_ERRORS: Final = (
    struct.error,
    UnicodeDecodeError,
    ValueError,
    RuntimeError,
    zstandard.ZstdError,
    # A chunk that says it is larger than any memory.
    MemoryError,
    OverflowError,
)
_CHUNK = struct.Struct("<QQQI")


class DamageError(Exception):
    """A file can't be read on from here."""


def read_records(stream: BinaryIO, size: int) -> Iterator[tuple[int, bytes]]:
    """Yield opcode and content of every record that is there as a whole."""
    while True:
        head = stream.read(RECORD.size)
        if len(head) < RECORD.size:
            return
        opcode, length = RECORD.unpack(head)
        if stream.tell() + length > size:
            return
        yield opcode, stream.read(length)


def read_string(content: bytes, offset: int) -> tuple[str, int]:
    """Return a string and where it ends."""
    (length,) = struct.unpack_from("<I", content, offset)
    end = offset + 4 + length
    if end > len(content):
        raise ValueError(f"a string of {length} bytes in a record of {len(content)}")
    return content[offset + 4 : end].decode(), end


def read_map(content: bytes, offset: int) -> dict[str, str]:
    """Return a map of strings."""
    (length,) = struct.unpack_from("<I", content, offset)
    offset += 4
    end = offset + length
    entries = {}
    while offset < end:
        key, offset = read_string(content, offset)
        entries[key], offset = read_string(content, offset)
    return entries


def read_chunk(content: bytes) -> bytes:
    """Return the records inside a chunk, decompressed and checked."""
    _, _, size, checksum = _CHUNK.unpack_from(content)
    compression, offset = read_string(content, _CHUNK.size)
    data = decompress(content[offset + 8 :], compression, size)
    if checksum and crc32(data) != checksum:
        raise ValueError("a chunk's checksum doesn't match")
    return data
