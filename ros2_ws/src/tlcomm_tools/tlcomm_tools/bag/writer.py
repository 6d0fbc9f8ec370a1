"""Crash-safe writing of a bag.

``BagWriter``  appends messages; the bag is whole after every flush
``CHUNK_SIZE``  size from which on a flush is due
"""

import os
import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from types import TracebackType
from typing import Self

from tlcomm_tools.bag import records
from tlcomm_tools.bag.compression import DEFAULT, Compression, compress
from tlcomm_tools.bag.definitions import Definition
from tlcomm_tools.bag.metadata import BagCounts, qos_text, render_metadata
from tlcomm_tools.bag.topics import Topic

__all__ = ["CHUNK_SIZE", "BagWriter"]

CHUNK_SIZE = 1024 * 1024
# Rewriting the summary at each flush may take at most this share of the time.
_FLUSH_SHARE = 0.05
_NO_SPAN = (2**63 - 1, 0)


@dataclass(slots=True)
class _Chunk:
    contents: bytearray = field(default_factory=bytearray)
    span_ns: tuple[int, int] = _NO_SPAN
    places: dict[int, list[int]] = field(default_factory=dict)


class BagWriter:
    """A rosbag2 folder with one MCAP file.

    Each flush appends a chunk and, in the same system call, a new summary and footer behind it,
    which the next flush overwrites. So a process that is killed leaves a complete file, but for
    the rare case that it dies inside that call; then everything before the last flush can still
    be read from the front.

    Cost: a flush writes about 100 bytes per chunk so far and 10 per chunk and channel in it;
    flushes become rarer when that would take more than a twentieth of the time.
    """

    def __init__(
        self,
        folder: Path,
        topics: Sequence[Topic],
        definitions: Mapping[str, Definition],
        notes: Mapping[str, str],
        *,
        compression: Compression = DEFAULT,
        period_s: float = 0.5,
        clock: Callable[[], float] = time.monotonic,
    ) -> None:
        """Create the bag with its topics.

        Args:
            folder: the bag's folder, which mustn't exist.
            topics: every topic; its place in this sequence is its number in ``write``.
            definitions: by type, one for each topic's.
            notes: what else a reader should know, kept inside the file.
            compression: of the chunks.
            period_s: wall time after which a flush is due.
            clock: wall time in seconds.

        Raises:
            OSError: the folder or file can't be made.
        """
        folder.mkdir(parents=True)
        self.folder = folder
        self.path = folder / f"{folder.name}_0.mcap"
        self._topics = tuple(topics)
        self._definitions = definitions
        self._period_s = period_s
        self._clock = clock
        self._compression = compression
        self._chunk = _Chunk()
        self._counts = dict.fromkeys(range(1, len(topics) + 1), 0)
        self._span_ns = _NO_SPAN
        self._chunk_indexes: list[bytes] = []
        self._start_file(notes)
        self._flushed_s = clock()
        self._flush_cost_s = 0.0

    def _start_file(self, notes: Mapping[str, str]) -> None:
        start = records.MAGIC + records.header("ros2", "tlcomm")
        note = records.metadata("tlcomm", notes)
        self._note_index = records.metadata_index("tlcomm", len(start), len(note))
        self._schemas, self._channels = self._describe_topics()
        self._fd = os.open(self.path, os.O_WRONLY | os.O_CREAT | os.O_EXCL | os.O_CLOEXEC, 0o644)
        self._data_end = 0
        self._file_end = 0
        self._tail = b""
        self._append(start + note + self._schemas + self._channels)
        self._write_metadata()

    def _describe_topics(self) -> tuple[bytes, bytes]:
        types = sorted({topic.type for topic in self._topics})
        numbers = {name: number for number, name in enumerate(types, start=1)}
        schemas = b"".join(
            records.schema(numbers[name], name, "ros2msg", self._definitions[name].text)
            for name in types
        )
        channels = b"".join(
            records.channel(
                number,
                numbers[topic.type],
                topic.name,
                {
                    "offered_qos_profiles": qos_text(latched=topic.latched),
                    "topic_type_hash": self._definitions[topic.type].type_hash,
                },
            )
            for number, topic in enumerate(self._topics, start=1)
        )
        self._schema_count = len(types)
        return schemas, channels

    def write(self, topic: int, log_ns: int, data: bytes) -> None:
        """Append one serialized message of the topic with this number, in memory until a flush."""
        number = topic + 1
        chunk = self._chunk
        chunk.places.setdefault(number, []).extend((log_ns, len(chunk.contents)))
        sequence = self._counts[number] + 1
        chunk.contents += records.message(number, sequence, log_ns, data)
        self._counts[number] = sequence
        first_ns, last_ns = chunk.span_ns
        chunk.span_ns = (min(first_ns, log_ns), max(last_ns, log_ns))

    def flush_if_due(self) -> None:
        """Flush when a chunk is full, or the last time is long enough ago.

        What is written between two of these calls gets into the file together or not at all.

        Raises:
            OSError: it was due and failed; what was flushed before stays readable.
        """
        wait_s = max(self._period_s, self._flush_cost_s / _FLUSH_SHARE)
        is_full = len(self._chunk.contents) >= CHUNK_SIZE
        if is_full or self._clock() - self._flushed_s >= wait_s:
            self.flush()

    def flush(self) -> None:
        """Bring everything so far into the file and complete it.

        Raises:
            OSError: as the file system says; the bag is left as after the last flush.
        """
        begun_s = self._clock()
        if self._chunk.contents:
            self._append_chunk()
            self._write_metadata()
        self._flushed_s = self._clock()
        self._flush_cost_s = self._flushed_s - begun_s

    def _append_chunk(self) -> None:
        chunk, self._chunk = self._chunk, _Chunk()
        contents = bytes(chunk.contents)
        compressed = compress(contents, self._compression)
        body = records.chunk(chunk.span_ns, contents, compressed, self._compression.tag)
        indexes = b""
        offsets = {}
        for number, places in chunk.places.items():
            offsets[number] = self._data_end + len(body) + len(indexes)
            indexes += records.message_index(number, places)
        place = records.ChunkPlace(
            span_ns=chunk.span_ns,
            offset=self._data_end,
            length=len(body),
            index_offsets=offsets,
            index_length=len(indexes),
            sizes=(len(compressed), len(contents)),
        )
        self._chunk_indexes.append(records.chunk_index(place, self._compression.tag))
        self._span_ns = (
            min(self._span_ns[0], chunk.span_ns[0]),
            max(self._span_ns[1], chunk.span_ns[1]),
        )
        self._append(body + indexes)

    def _append(self, data: bytes) -> None:
        """Put data where the summary begins, and a new summary behind it."""
        end = self._data_end + len(data)
        tail = self._render_tail(end)
        try:
            _write_all(self._fd, data + tail, self._data_end)
        except OSError:
            _write_all(self._fd, self._tail, self._data_end)
            os.ftruncate(self._fd, self._file_end)
            raise
        self._data_end = end
        self._tail = tail
        self._file_end = end + len(tail)

    def _render_tail(self, data_end: int) -> bytes:
        counted = records.statistics(
            self._counts,
            self._schema_count,
            len(self._chunk_indexes),
            1,
            self._span_ns if self._chunk_indexes else (0, 0),
        )
        groups = (
            (records.Opcode.SCHEMA, self._schemas),
            (records.Opcode.CHANNEL, self._channels),
            (records.Opcode.CHUNK_INDEX, b"".join(self._chunk_indexes)),
            (records.Opcode.METADATA_INDEX, self._note_index),
            (records.Opcode.STATISTICS, counted),
        )
        return records.end(data_end, groups)

    def _write_metadata(self) -> None:
        counts = BagCounts(
            messages=tuple(self._counts.values()),
            span_ns=self._span_ns if self._chunk_indexes else None,
        )
        text = render_metadata(self.path.name, self._topics, self._definitions, counts)
        temporary = self.folder / ".metadata.yaml.tmp"
        try:
            temporary.write_text(text, "utf-8")
            temporary.replace(self.folder / "metadata.yaml")
        except OSError:
            temporary.unlink(missing_ok=True)
            raise

    def close(self) -> None:
        """Flush and close; nothing may follow."""
        try:
            self.flush()
        finally:
            os.close(self._fd)

    def __enter__(self) -> Self:
        """Return itself."""
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        """Close."""
        self.close()


def _write_all(fd: int, data: bytes, offset: int) -> None:
    view = memoryview(data)
    while view:
        written = os.pwrite(fd, view, offset)
        view = view[written:]
        offset += written
