"""Finishing a bag that was left unfinished: cut off, without its summary or its ``metadata.yaml``.

``Repaired``   what a repair has saved
``Ending``     how a bag ends
``inspect``    how a bag ends
``repair``     writes all that can be read from the front into a new bag

Chunks are copied as they are, so that times, sequence numbers and compression stay. A chunk that
was cut is left out as a whole: a recorder that writes chunk by chunk has each topic up to one time
at their borders, and nowhere else.
"""

import shutil
import struct
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any, BinaryIO, Final
from zlib import crc32

import yaml

from tlcomm_core.errors import InputError
from tlcomm_tools.bag import records
from tlcomm_tools.bag.container import Container, read_container
from tlcomm_tools.bag.parsing import (
    DECODING_ERRORS,
    MESSAGE,
    RECORD,
    read_chunk,
    read_records,
    read_string,
)
from tlcomm_tools.bag.records import MAGIC, Opcode
from tlcomm_tools.bag.writer import CHUNK_SIZE

__all__ = ["Ending", "Repaired", "inspect", "repair"]

_FOOTER: Final = struct.Struct("<BQQQI")
_NUMBER: Final = struct.Struct("<H")
_COMPRESSION_OFFSET: Final = 28


@dataclass(frozen=True, slots=True)
class Ending:
    """How a bag ends.

    Attributes:
        messages: that can be read from the front.
        end_ns: the greatest log time among them, or ``None``.
        flaw: what is missing or damaged, or "" for a bag that is whole.
    """

    messages: int
    end_ns: int | None
    flaw: str


@dataclass(frozen=True, slots=True)
class Repaired:
    """What a repair has saved.

    Attributes:
        messages: in the new bag.
        end_ns: the greatest log time among them.
    """

    messages: int
    end_ns: int


def inspect(path: Path) -> Ending:
    """Return how an MCAP file of a bag ends.

    Raises:
        InputError: it can't be read or is no MCAP file.
    """
    container = read_container(path, lambda _: False)
    count = sum(container.counts.values())
    flaw = container.damage
    if not flaw and not _has_summary(path):
        flaw = "the file has no summary"
    if not flaw and not _is_described(path, count):
        flaw = "metadata.yaml is missing or doesn't fit the file"
    return Ending(count, container.end_ns, flaw)


def repair(path: Path, folder: Path) -> Repaired:
    """Write all that can be read from a file's front into a new bag.

    Args:
        path: an MCAP file.
        folder: the new bag's, which mustn't exist; it appears when it is complete.

    Raises:
        InputError: the folder exists, or the file holds no message.
        OSError: the file system's complaint; no folder is left.

    Deviates: attachments, which ROS's recorders never write, are left out.
    """
    if folder.exists():
        raise InputError(f"{str(folder)!r} exists already: give another folder with -o")
    container = read_container(path, lambda _: False)
    temporary = folder.with_name(f".{folder.name}.tmp")
    temporary.mkdir(parents=True)
    try:
        copy = _copy(path, temporary / f"{folder.name}_0.mcap")
        text = _describe(f"{folder.name}_0.mcap", container, copy)
        (temporary / "metadata.yaml").write_text(text, "utf-8")
        temporary.rename(folder)
    except BaseException:
        shutil.rmtree(temporary)
        raise
    return Repaired(sum(copy.counts.values()), copy.span_ns[1])


def _has_summary(path: Path) -> bool:
    """Tell whether the file's summary is there and undamaged."""
    data = path.read_bytes()
    tail = data[-_FOOTER.size - len(MAGIC) :]
    if not tail.endswith(MAGIC) or len(tail) < _FOOTER.size + len(MAGIC):
        return False
    opcode, _, start, _, checksum = _FOOTER.unpack_from(tail)
    if opcode != Opcode.FOOTER or not 0 < start < len(data):
        return False
    return checksum in {0, crc32(data[start : -len(MAGIC) - 4])}


def _is_described(path: Path, count: int) -> bool:
    """Tell whether ``metadata.yaml`` beside the file is about it and has counted as many."""
    try:
        text = path.with_name("metadata.yaml").read_text("utf-8")
        told = yaml.safe_load(text)["rosbag2_bagfile_information"]
        return path.name in told["relative_file_paths"] and told["message_count"] == count
    except (OSError, yaml.YAMLError, RecursionError, ValueError, KeyError, TypeError):
        return False


def _copy(path: Path, target: Path) -> "_Copy":
    with path.open("rb") as source, target.open("xb") as stream:
        source.seek(len(MAGIC))
        copy = _Copy(stream)
        copy.take_all(source, path.stat().st_size)
        copy.finish()
    if not copy.counts:
        raise InputError(f"{str(path)!r} holds no message that can be read")
    return copy


class _Copy:
    """A new file, complete when it is finished."""

    def __init__(self, stream: BinaryIO) -> None:
        self.counts: dict[int, int] = {}
        self.span_ns = (2**64 - 1, 0)
        self._stream = stream
        self._schemas: dict[int, bytes] = {}
        self._channels: dict[int, bytes] = {}
        self._chunk_indexes: list[bytes] = []
        self._note_indexes: list[bytes] = []
        self._loose = bytearray()
        stream.write(MAGIC)

    def take_all(self, source: BinaryIO, size: int) -> None:
        """Take every record up to the end of the data or the first damage."""
        for opcode, content in read_records(source, size):
            if opcode in {Opcode.DATA_END, Opcode.FOOTER}:
                return
            try:
                self._take(opcode, content)
            except DECODING_ERRORS:
                return

    def _take(self, opcode: int, content: bytes) -> None:
        match opcode:
            case Opcode.CHUNK:
                self._put_loose_messages()
                self._put_chunk(content)
            case Opcode.MESSAGE:
                self._loose += records.record(Opcode.MESSAGE, content)
                if len(self._loose) >= CHUNK_SIZE:
                    self._put_loose_messages()
            case Opcode.HEADER:
                self._stream.write(records.record(Opcode.HEADER, content))
            case Opcode.SCHEMA | Opcode.CHANNEL:
                self._remember(opcode, content)
                self._stream.write(records.record(Opcode(opcode), content))
            case Opcode.METADATA:
                name, _ = read_string(content, 0)
                note = records.record(Opcode.METADATA, content)
                offset = self._stream.tell()
                self._note_indexes.append(records.metadata_index(name, offset, len(note)))
                self._stream.write(note)
            case _:
                # Indexes are made anew.
                pass

    def _remember(self, opcode: int, content: bytes) -> None:
        (number,) = _NUMBER.unpack_from(content)
        known = self._schemas if opcode == Opcode.SCHEMA else self._channels
        known[number] = records.record(Opcode(opcode), content)

    def _put_loose_messages(self) -> None:
        """Put messages that were in no chunk into one, so that there is an index of them."""
        if not self._loose:
            return
        data, self._loose = bytes(self._loose), bytearray()
        times_ns = [log_ns for _, log_ns, _ in _messages_in(data)]
        framed = records.chunk((min(times_ns), max(times_ns)), data, data, "")
        self._put_chunk(framed[RECORD.size :])

    def _put_chunk(self, content: bytes) -> None:
        data = read_chunk(content)
        places: dict[int, list[int]] = {}
        for number, log_ns, offset in _messages_in(data):
            places.setdefault(number, []).extend((log_ns, offset))
        for opcode, start, end in _records_in(data):
            if opcode in {Opcode.SCHEMA, Opcode.CHANNEL}:
                self._remember(opcode, data[start:end])
        begin = self._stream.tell()
        self._stream.write(records.record(Opcode.CHUNK, content))
        self._put_indexes(content, len(data), begin, places)

    def _put_indexes(
        self, content: bytes, size: int, begin: int, places: dict[int, list[int]]
    ) -> None:
        length = self._stream.tell() - begin
        offsets = {}
        for number, own in places.items():
            offsets[number] = self._stream.tell()
            self._stream.write(records.message_index(number, own))
            self.counts[number] = self.counts.get(number, 0) + len(own) // 2
        times_ns = [time_ns for own in places.values() for time_ns in own[::2]]
        span_ns = (min(times_ns, default=0), max(times_ns, default=0))
        if times_ns:
            self.span_ns = (min(self.span_ns[0], span_ns[0]), max(self.span_ns[1], span_ns[1]))
        compression, data_offset = read_string(content, _COMPRESSION_OFFSET)
        place = records.ChunkPlace(
            span_ns=span_ns,
            offset=begin,
            length=length,
            index_offsets=offsets,
            index_length=self._stream.tell() - begin - length,
            sizes=(len(content) - data_offset - 8, size),
        )
        self._chunk_indexes.append(records.chunk_index(place, compression))

    def finish(self) -> None:
        """Put the summary and the end behind the data."""
        self._put_loose_messages()
        counted = records.statistics(
            dict.fromkeys(self._channels, 0) | self.counts,
            len(self._schemas),
            len(self._chunk_indexes),
            len(self._note_indexes),
            self.span_ns,
        )
        groups = (
            (Opcode.SCHEMA, b"".join(self._schemas.values())),
            (Opcode.CHANNEL, b"".join(self._channels.values())),
            (Opcode.CHUNK_INDEX, b"".join(self._chunk_indexes)),
            (Opcode.METADATA_INDEX, b"".join(self._note_indexes)),
            (Opcode.STATISTICS, counted),
        )
        self._stream.write(records.end(self._stream.tell(), groups))


def _records_in(data: bytes) -> Iterator[tuple[int, int, int]]:
    """Yield opcode, start and end of the content of each record inside a chunk."""
    offset = 0
    while offset < len(data):
        opcode, length = RECORD.unpack_from(data, offset)
        start = offset + RECORD.size
        offset = start + length
        if offset > len(data):
            raise ValueError(f"a record of {length} bytes goes beyond its chunk")
        yield opcode, start, offset


def _messages_in(data: bytes) -> Iterator[tuple[int, int, int]]:
    """Yield channel, log time and place of each message inside a chunk."""
    for opcode, start, _ in _records_in(data):
        if opcode == Opcode.MESSAGE:
            number, _, log_ns, _ = MESSAGE.unpack_from(data, start)
            yield number, log_ns, start - RECORD.size


def _describe(name: str, container: Container, copy: _Copy) -> str:
    """Return the text of ``metadata.yaml``."""
    count = sum(copy.counts.values())
    begin = {"nanoseconds_since_epoch": copy.span_ns[0]}
    duration = {"nanoseconds": copy.span_ns[1] - copy.span_ns[0]}
    file = {
        "path": name,
        "starting_time": begin,
        "duration": duration,
        "message_count": count,
    }
    document = {
        "version": 9,
        "storage_identifier": "mcap",
        "duration": duration,
        "starting_time": begin,
        "message_count": count,
        "topics_with_message_count": _describe_topics(container, copy),
        "compression_format": "",
        "compression_mode": "",
        "relative_file_paths": [name],
        "files": [file],
        "custom_data": None,
        "ros_distro": "jazzy",
    }
    return yaml.dump(
        {"rosbag2_bagfile_information": document}, Dumper=_WithoutAliases, sort_keys=False
    )


def _describe_topics(container: Container, copy: _Copy) -> list[dict[str, Any]]:
    return [
        {
            "topic_metadata": {
                "name": channel.topic,
                "type": channel.type,
                "serialization_format": channel.encoding,
                "offered_qos_profiles": _read_profiles(
                    channel.notes.get("offered_qos_profiles", "")
                ),
                "type_description_hash": channel.notes.get("topic_type_hash", ""),
            },
            "message_count": copy.counts.get(number, 0),
        }
        for number, channel in container.channels.items()
    ]


def _read_profiles(text: str) -> list[Any]:
    try:
        profiles = yaml.safe_load(text)
    except (yaml.YAMLError, RecursionError, ValueError):
        return []
    return profiles if isinstance(profiles, list) else []


class _WithoutAliases(yaml.SafeDumper):
    """Writes a value that occurs twice twice: not every reader of bags knows YAML's aliases."""

    def ignore_aliases(self, data: object) -> bool:  # noqa: ARG002 (of no value)
        return True
