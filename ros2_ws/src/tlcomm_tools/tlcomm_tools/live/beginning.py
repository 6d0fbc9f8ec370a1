"""What was said before there was anybody to hear it, from the bag.

``Beginning``  joins the bag's messages and those that are heard

A view that were there when a run's processes look for each other could be taken for one of them.
So it comes when they have found each other, and the run doesn't wait for it. What was said up to a
time that it chooses then is read from the bag, which is being written meanwhile; what was said from
that time on was heard.
"""

from collections.abc import Iterator, Mapping, Sequence
from operator import itemgetter
from pathlib import Path
from typing import Final

from tlcomm_core.errors import InputError
from tlcomm_core.units import nanoseconds
from tlcomm_tools.bag.container import read_container
from tlcomm_tools.bag.reader import find_files
from tlcomm_tools.bag.topics import Topic
from tlcomm_tools.live.intake import Heard, read_stamp

__all__ = ["Beginning"]

# By how much of simulated time topics may overtake each other on their way into the bag.
_OVERTAKING_NS: Final = nanoseconds(1.0)
_FOREVER_NS: Final = 1 << 62

# stamp (ns), topic's number, data
_Said = tuple[int, int, bytes]


class Beginning:
    """Joins the bag's messages and those that are heard."""

    def __init__(self, bag: Path, topics: Sequence[Topic]) -> None:
        """Hear nothing yet.

        Args:
            bag: the bag's folder, which is being written.
            topics: a topic's place in this sequence is its number.
        """
        self._bag: Final = bag
        self._numbers: Final[Mapping[str, int]] = {
            topic.name: number for number, topic in enumerate(topics)
        }
        self._latched: Final = {number for number, topic in enumerate(topics) if topic.latched}
        self._heard: list[Heard] = []
        self._from_ns = 0

    def hear(self, heard: Sequence[Heard]) -> None:
        """Keep what was heard until the beginning is known."""
        self._heard += heard

    def choose(self, heard: Sequence[Heard]) -> bool:
        """Choose the time by what was just heard, when everything that is said is; tell whether so.

        Silence tells no time, and what is latched may have been said long ago.
        """
        stamps_ns = [read_stamp(data) for number, data in heard if number not in self._latched]
        self._from_ns = max(stamps_ns, default=0)
        return bool(stamps_ns)

    def join(self) -> Iterator[Heard] | None:
        """Return all messages, in order of time; ``None`` if the bag doesn't go so far yet."""
        try:
            said = self._read()
        except InputError:
            return None
        if max((own[0] for own in said), default=0) < self._from_ns + _OVERTAKING_NS:
            return None
        return self._joined(said)

    def join_all(self) -> Iterator[Heard]:
        """Return all messages after the end: those of the bag, or what was heard without one."""
        try:
            said = self._read()
        except InputError:
            said = []
        self._from_ns = _FOREVER_NS if said else 0
        return self._joined(said)

    def _read(self) -> list[_Said]:
        said = []
        for file in find_files(self._bag):
            container = read_container(file, lambda channel: channel.topic in self._numbers)
            for channel, stamp_ns, data in container.messages:
                said.append((stamp_ns, self._numbers[container.channels[channel].topic], data))
        return said

    def _joined(self, said: Sequence[_Said]) -> Iterator[Heard]:
        recorded = (own for own in said if own[0] < self._from_ns)
        for _, number, data in sorted(recorded, key=itemgetter(0, 1)):
            yield number, data
        for heard in self._heard:
            if read_stamp(heard[1]) >= self._from_ns:
                yield heard
