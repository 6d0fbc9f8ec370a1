"""What a bag has to publish, in order.

``OfferedTopic``  a topic as it was offered
``Script``        all that is to be published
``read_script``   from a run folder, a bag folder or an MCAP file
"""

from collections.abc import Collection
from dataclasses import dataclass, field
from operator import itemgetter
from pathlib import Path
from typing import Final

from tlcomm_core.errors import InputError
from tlcomm_core.units import NANOSECONDS_PER_SECOND, seconds
from tlcomm_tools.bag.container import Channel, Container, read_container
from tlcomm_tools.bag.reader import find_files
from tlcomm_tools.replay.quality import Quality, read_quality

__all__ = ["CLOCK", "Message", "OfferedTopic", "Script", "read_script"]

CLOCK: Final = "/clock"

# log time (ns), number of its topic, data
Message = tuple[int, int, bytes]


@dataclass(frozen=True, slots=True)
class OfferedTopic:
    """A topic as it was offered.

    Attributes:
        name: absolute.
        type: as ``package/msg/Name``.
        quality: of service.
        type_hash: of the type at that time, or "" if the bag doesn't say.
    """

    name: str
    type: str
    quality: Quality
    type_hash: str = ""


@dataclass(slots=True)
class Script:
    """All that is to be published.

    Attributes:
        topics: whatever is published on, each once.
        messages: by log time; the clock's before others of the same instant, else as in the bag.
        held: what latched topics still offer of the time before, by log time.
        skipped: topics that can't be published, with reasons.
        damage: why reading ended early, or "".
    """

    topics: list[OfferedTopic] = field(default_factory=list)
    messages: list[Message] = field(default_factory=list)
    held: list[Message] = field(default_factory=list)
    skipped: dict[str, str] = field(default_factory=dict)
    damage: str = ""

    @property
    def span_ns(self) -> tuple[int, int]:
        """First and last time."""
        return self.messages[0][0], self.messages[-1][0]


def read_script(path: Path, chosen: Collection[str] | None = None, start_s: float = 0.0) -> Script:
    """Read what is to be published.

    Args:
        path: a run folder, a bag folder or an MCAP file.
        chosen: topics; by default all. The clock is always among them.
        start_s: seconds after the bag's first message at which to begin.

    Returns:
        What can be read of it.

    Raises:
        InputError: there is no bag, or nothing in it of these topics from that time on.

    Cost: all messages are held in memory.
    """
    builder = _Builder(chosen)
    for file in find_files(path):
        container = read_container(file, builder.wants)
        builder.add(container)
        if container.damage:
            break
    script = builder.script
    missing = sorted(set(chosen or ()) - builder.seen)
    if missing:
        raise InputError(
            f"--topics: {str(path)!r} has no topic {missing[0]!r} "
            f"(its topics are {', '.join(sorted(builder.seen)) or 'none'})"
        )
    if not script.messages:
        raise InputError(f"{str(path)!r} holds no messages to replay")
    _put_in_order(script)
    if start_s > 0.0:
        _skip(script, start_s)
    return script


class _Builder:
    def __init__(self, chosen: Collection[str] | None) -> None:
        self.script = Script()
        self.seen: set[str] = set()
        self._chosen = chosen
        self._numbers: dict[str, int] = {}

    def wants(self, channel: Channel) -> bool:
        """Tell whether a channel's messages are to be published, and enter its topic."""
        name = channel.topic
        self.seen.add(name)
        if self._chosen is not None and name != CLOCK and name not in self._chosen:
            return False
        if name in self._numbers:
            return True
        if channel.encoding != "cdr":
            self.script.skipped[name] = f"it is encoded as {channel.encoding!r}, expected 'cdr'"
            return False
        try:
            quality = read_quality(channel.notes.get("offered_qos_profiles", ""))
        except InputError as error:
            self.script.skipped[name] = str(error)
            return False
        self._numbers[name] = len(self.script.topics)
        type_hash = channel.notes.get("topic_type_hash", "")
        self.script.topics.append(OfferedTopic(name, channel.type, quality, type_hash))
        return True

    def add(self, container: Container) -> None:
        """Take a file's messages over."""
        numbers = {
            number: self._numbers[channel.topic]
            for number, channel in container.channels.items()
            if channel.topic in self._numbers
        }
        self.script.messages += [
            (log_ns, numbers[number], data) for number, log_ns, data in container.messages
        ]
        self.script.damage = container.damage


def _put_in_order(script: Script) -> None:
    clocks = [number for number, topic in enumerate(script.topics) if topic.name == CLOCK]
    # Sorting keeps the bag's order within an instant, but there whoever is told of something must
    # already know that it is so late.
    script.messages.sort(key=lambda message: message[1] not in clocks)
    script.messages.sort(key=itemgetter(0))


def _skip(script: Script, start_s: float) -> None:
    first_ns, last_ns = script.span_ns
    from_ns = first_ns + round(start_s * NANOSECONDS_PER_SECOND)
    if from_ns > last_ns:
        raise InputError(
            f"--start: {start_s:g} s is after the end: "
            f"the recording lasts {seconds(last_ns - first_ns):.3f} s"
        )
    count = sum(1 for message in script.messages if message[0] < from_ns)
    before, script.messages = script.messages[:count], script.messages[count:]
    script.held = _still_offered(script.topics, before)


def _still_offered(topics: list[OfferedTopic], before: list[Message]) -> list[Message]:
    """Return what latched publishers have kept of these messages."""
    kept: list[Message] = []
    room = {number: topic.quality.depth for number, topic in enumerate(topics)}
    for message in reversed(before):
        number = message[1]
        left = room[number]
        if not topics[number].quality.latched or left == 0:
            continue
        room[number] = None if left is None else left - 1
        kept.append(message)
    return kept[::-1]
