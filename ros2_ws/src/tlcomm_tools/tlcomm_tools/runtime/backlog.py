"""What has arrived and isn't in the bag yet.

``Arrived``  a message as it came
``Backlog``  keeps messages until all of one time are there

Topics overtake each other, and a run in lock step goes on while the recorder is being ticked: what
has arrived may be later than the tick. Such messages are neither counted nor handed out before a
tick covers them.
"""

from collections.abc import Sequence
from typing import Final

from tlcomm_tools.bag.topics import Topic
from tlcomm_tools.runtime.ledger import Expected, Ledger

__all__ = ["FOR_EVER", "Arrived", "Backlog"]

FOR_EVER: Final = 2**63 - 1

# stamp (ns), topic's number, data
Arrived = tuple[int, int, bytes]


class Backlog:
    """Keeps messages until all of one time are there."""

    def __init__(self, topics: Sequence[Topic], agents: Sequence[str], until_ns: int) -> None:
        """Begin with nothing.

        Args:
            topics: what arrives; a topic's place in this sequence is its number.
            agents: in the order in which ticks count their messages.
            until_ns: nothing later is handed out, until ``cover`` says so.
        """
        self._ledger: Final = Ledger(topics, agents)
        self._until_ns = until_ns
        self._due: list[Arrived] = []
        self._later: list[Arrived] = []

    @property
    def total(self) -> int:
        """How many messages have been counted."""
        return self._ledger.total

    def take(self, stamp_ns: int, number: int, data: bytes) -> None:
        """Take a message of the topic with this number."""
        if stamp_ns <= self._until_ns:
            self._due.append((stamp_ns, number, data))
            self._ledger.count(number)
        else:
            self._later.append((stamp_ns, number, data))

    def cover(self, until_ns: int) -> None:
        """Count and hand out what isn't later than this from now on."""
        self._until_ns = until_ns
        waiting, self._later = self._later, []
        for stamp_ns, number, data in waiting:
            self.take(stamp_ns, number, data)

    def is_complete(self, expected: Expected) -> bool:
        """Whether all that was published up to the covered time has arrived."""
        return self._ledger.is_complete(expected)

    def describe_missing(self, expected: Expected) -> str:
        """Say what hasn't arrived."""
        return self._ledger.describe_missing(expected)

    def hand_out(self) -> list[Arrived]:
        """Return what has arrived up to the covered time, by time and by topic; once."""
        due, self._due = self._due, []
        due.sort(key=_by_time_and_topic)
        return due


def _by_time_and_topic(arrived: Arrived) -> tuple[int, int]:
    return arrived[:2]
