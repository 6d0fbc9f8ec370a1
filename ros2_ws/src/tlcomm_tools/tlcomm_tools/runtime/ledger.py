"""What the recorder has received, counted as a tick counts it.

``Ledger``  counts messages and tells what is missing
"""

from collections.abc import Sequence
from dataclasses import dataclass

from tlcomm_tools.bag.topics import Topic

__all__ = ["Expected", "Ledger"]

_WORLD = ("odometry", "connectivity", "clock", "map", "reading")
# What the world says on agents' topics.
_BY_TYPE = {"nav_msgs/msg/Odometry": "odometry", "tlcomm_msgs/msg/Reading": "reading"}


@dataclass(frozen=True, slots=True)
class Expected:
    """How many messages were published since the start.

    Attributes:
        odometry: by the world, for all agents together.
        connectivity: by the world.
        clock: by the world.
        maps: by the world.
        agents: by each agent, on all its recorded topics together.
        readings: by the world, for all agents together.
    """

    odometry: int
    connectivity: int
    clock: int
    maps: int
    agents: tuple[int, ...]
    readings: int = 0

    @property
    def counts(self) -> tuple[int, ...]:
        """All of them, those of agents last."""
        return (
            self.odometry,
            self.connectivity,
            self.clock,
            self.maps,
            self.readings,
            *self.agents,
        )


class Ledger:
    """Counts what arrives on recorded topics."""

    def __init__(self, topics: Sequence[Topic], agents: Sequence[str]) -> None:
        """Count from nothing."""
        self._names = (*_WORLD, *agents)
        self._received = dict.fromkeys(self._names, 0)
        self._sources = [_source(topic) for topic in topics]

    def count(self, topic: int) -> None:
        """Count a message of the topic with this number."""
        self._received[self._sources[topic]] += 1

    @property
    def total(self) -> int:
        """All messages so far."""
        return sum(self._received.values())

    def is_complete(self, expected: Expected) -> bool:
        """Whether everything that was published has arrived."""
        counts = expected.counts
        return all(
            received >= count
            for received, count in zip(self._received.values(), counts, strict=True)
        )

    def describe_missing(self, expected: Expected) -> str:
        """Say what hasn't arrived."""
        counts = expected.counts
        return ", ".join(
            f"{count - self._received[name]} of {name}"
            for name, count in zip(self._names, counts, strict=True)
            if count > self._received[name]
        )


def _source(topic: Topic) -> str:
    return _BY_TYPE.get(topic.type) or topic.agent or topic.name.removeprefix("/")
