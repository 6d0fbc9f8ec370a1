"""Reading an MCAP file from its front, so that a file without its end is read as far as it goes.

``Channel``         a topic in a file
``StoredMessage``   one message, not decoded
``Container``       what a file holds
``read_container``  reads one file
"""

import struct
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import BinaryIO
from zlib import crc32

import lz4.frame  # type: ignore[import-untyped]
import zstandard

from tlcomm_core.errors import InputError
from tlcomm_tools.bag.records import MAGIC, Opcode

__all__ = ["Channel", "Container", "StoredMessage", "read_container"]

_RECORD = struct.Struct("<BQ")
_MESSAGE = struct.Struct("<HIQQ")
_CHUNK = struct.Struct("<QQQI")
# Some middleware hands messages on with the bytes that fill them up, some without.
_WORD = 4


@dataclass(frozen=True, slots=True)
class Channel:
    """A topic in a file.

    Attributes:
        topic: its name.
        type: as ``package/msg/Name``, or "" for none.
        encoding: of its messages.
        definition: of its type.
        definition_encoding: of that.
    """

    topic: str
    type: str
    encoding: str
    definition: str
    definition_encoding: str


# channel number, log time (ns), data
StoredMessage = tuple[int, int, bytes]


@dataclass(slots=True)
class Container:
    """What a file holds.

    Attributes:
        channels: by number.
        messages: of the wanted topics, in the file's order.
        counts: messages per channel, unwanted ones included.
        lengths: bytes of these messages' data per channel, each in whole words as DDS sends it.
        metadata: named maps of strings.
        end_ns: the greatest log time, or ``None`` without messages.
        damage: why reading ended before the end, or "".
    """

    channels: dict[int, Channel] = field(default_factory=dict)
    messages: list[StoredMessage] = field(default_factory=list)
    counts: dict[int, int] = field(default_factory=dict)
    lengths: dict[int, int] = field(default_factory=dict)
    metadata: dict[str, dict[str, str]] = field(default_factory=dict)
    end_ns: int | None = None
    damage: str = ""


class _DamageError(Exception):
    """The file can't be read on from here."""


def read_container(path: Path, wanted: Callable[[Channel], bool]) -> Container:
    """Read a file as far as it goes.

    Args:
        path: the file.
        wanted: which channels' messages to keep; the others are only counted and measured.

    Raises:
        InputError: it can't be read or is no MCAP file.

    Cost: linear in the file; about 1 µs per message that isn't wanted, 2 µs for the others.
    """
    try:
        size = path.stat().st_size
        with path.open("rb") as stream:
            if stream.read(len(MAGIC)) != MAGIC:
                raise InputError(f"{str(path)!r} is no MCAP file")
            parser = _Parser(wanted)
            try:
                parser.read(stream, size)
            except _DamageError as error:
                parser.container.damage = str(error)
    except OSError as error:
        raise InputError(f"can't read {str(path)!r}: {error.strerror}") from error
    return parser.container


class _Parser:
    def __init__(self, wanted: Callable[[Channel], bool]) -> None:
        self.container = Container()
        self._wanted = wanted
        self._kept: set[int] = set()
        self._schemas: dict[int, tuple[str, str, str]] = {}

    def read(self, stream: BinaryIO, size: int) -> None:
        """Take every record up to the end of the data."""
        for opcode, content in _read_records(stream, size):
            if opcode in {Opcode.DATA_END, Opcode.FOOTER}:
                return
            try:
                self._take(opcode, content)
            except (
                struct.error,
                UnicodeDecodeError,
                ValueError,
                RuntimeError,
                zstandard.ZstdError,
            ) as error:
                raise _DamageError(f"a damaged record: {error}") from error
        raise _DamageError("the file has no end")

    def _take(self, opcode: int, content: bytes) -> None:
        if opcode == Opcode.CHUNK:
            self._take_chunk(content)
        elif opcode == Opcode.MESSAGE:
            self._take_message(content, 0, len(content))
        elif opcode == Opcode.SCHEMA:
            self._take_schema(content)
        elif opcode == Opcode.CHANNEL:
            self._take_channel(content)
        elif opcode == Opcode.METADATA:
            name, offset = _read_string(content, 0)
            self.container.metadata[name] = _read_map(content, offset)

    def _take_chunk(self, content: bytes) -> None:
        _, _, size, checksum = _CHUNK.unpack_from(content)
        compression, offset = _read_string(content, _CHUNK.size)
        data = _decompress(content[offset + 8 :], compression, size)
        if checksum and crc32(data) != checksum:
            raise ValueError("a chunk's checksum doesn't match")
        offset, unpack = 0, _RECORD.unpack_from
        while offset < len(data):
            opcode, length = unpack(data, offset)
            offset += _RECORD.size
            if opcode == Opcode.MESSAGE:
                self._take_message(data, offset, offset + length)
            else:
                self._take(opcode, data[offset : offset + length])
            offset += length

    def _take_message(self, data: bytes, start: int, end: int) -> None:
        number, _, log_ns, _ = _MESSAGE.unpack_from(data, start)
        container = self.container
        container.counts[number] = container.counts.get(number, 0) + 1
        length = end - start - _MESSAGE.size
        container.lengths[number] = container.lengths.get(number, 0) + length + -length % _WORD
        if container.end_ns is None or log_ns > container.end_ns:
            container.end_ns = log_ns
        if number in self._kept:
            container.messages.append((number, log_ns, data[start + _MESSAGE.size : end]))

    def _take_schema(self, content: bytes) -> None:
        (number,) = struct.unpack_from("<H", content)
        name, offset = _read_string(content, 2)
        encoding, offset = _read_string(content, offset)
        definition, _ = _read_string(content, offset)
        self._schemas[number] = (name, encoding, definition)

    def _take_channel(self, content: bytes) -> None:
        number, schema = struct.unpack_from("<HH", content)
        topic, offset = _read_string(content, 4)
        encoding, _ = _read_string(content, offset)
        name, definition_encoding, definition = self._schemas.get(schema, ("", "", ""))
        channel = Channel(topic, name, encoding, definition, definition_encoding)
        self.container.channels[number] = channel
        if self._wanted(channel):
            self._kept.add(number)


def _read_records(stream: BinaryIO, size: int) -> Iterator[tuple[int, bytes]]:
    while True:
        head = stream.read(_RECORD.size)
        if len(head) < _RECORD.size:
            return
        opcode, length = _RECORD.unpack(head)
        if stream.tell() + length > size:
            return
        yield opcode, stream.read(length)


def _read_string(content: bytes, offset: int) -> tuple[str, int]:
    (length,) = struct.unpack_from("<I", content, offset)
    end = offset + 4 + length
    if end > len(content):
        raise ValueError(f"a string of {length} bytes in a record of {len(content)}")
    return content[offset + 4 : end].decode(), end


def _read_map(content: bytes, offset: int) -> dict[str, str]:
    (length,) = struct.unpack_from("<I", content, offset)
    offset += 4
    end = offset + length
    entries = {}
    while offset < end:
        key, offset = _read_string(content, offset)
        entries[key], offset = _read_string(content, offset)
    return entries


def _decompress(data: bytes, compression: str, size: int) -> bytes:
    if compression == "zstd":
        return zstandard.decompress(data, max_output_size=size)
    if compression == "lz4":
        unpacked: bytes = lz4.frame.decompress(data)
        return unpacked
    if compression:
        raise ValueError(f"unknown compression {compression!r}")
    return data
