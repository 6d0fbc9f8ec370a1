"""What an agent's radio lets through: messages of neighbours, at the instant they arrive.

``Radio``         the filter between what is on the air and what the agent hears
``Heard``         a message that it let through
``OUT_OF_RANGE``  why a message from elsewhere isn't heard
``UNSEEN``        the same where obstacles matter too

Over ROS every agent's messages reach every process; range is this filter's doing, as are loss and
delay, which its ``Channel`` decides on. It knows the agent's own neighbours and how far away they
are, and nothing else of the connectivity.
"""

from bisect import bisect_right
from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Final

from tlcomm_core.agent.channel import Channel
from tlcomm_core.protocol.messages import (
    BestResponse,
    Confirmation,
    EstimateExchange,
    PlanOffer,
    Proposal,
    TeamMessage,
)

__all__ = ["OUT_OF_RANGE", "UNSEEN", "Heard", "Radio"]

OUT_OF_RANGE: Final = "out of range"
UNSEEN: Final = "out of range or sight"

# Messages that one sender sends at the same instant are heard in this order of their kinds, since
# ROS keeps the order on each topic only.
_KIND_RANK: Final[dict[type[TeamMessage], int]] = {
    PlanOffer: 0,
    Proposal: 1,
    BestResponse: 2,
    Confirmation: 3,
    EstimateExchange: 4,
}

# Free running, a message may be taken off the air some time after it arrived, and links may have
# changed since. One that comes later than this isn't let through.
_MEMORY_NS: Final = 10_000_000_000


@dataclass(frozen=True, slots=True)
class Heard:
    """A message that a radio let through.

    Attributes:
        message: what was said.
        said_ns: when, by the sender's clock.
    """

    message: TeamMessage
    said_ns: int


class Radio:
    """The filter between what is on the air and what the agent hears.

    Attributes:
        undelivered: how many messages weren't let through, by reason.
    """

    def __init__(
        self,
        latency_ns: int,
        channel: Channel,
        unlinked: str = OUT_OF_RANGE,
        lag_ns: int | None = None,
    ) -> None:
        """Begin without neighbours.

        Args:
            latency_ns: fixed part of the time from sending to hearing. Who is a neighbour when it
                has passed hears the message, then or later.
            channel: what becomes of messages of neighbours.
            unlinked: why others aren't heard.
            lag_ns: how old what the agent knows of its neighbours, and how late its clock, may be
                when a message is decided on: until then it waits. ``None`` in lock step, where
                both are up to date.
        """
        self._latency_ns: Final = latency_ns
        self._channel: Final = channel
        self._unlinked: Final = unlinked
        self._lag_ns: Final = lag_ns
        self._since_ns: list[int] = [-1]
        self._neighbours: list[Mapping[str, float]] = [{}]
        self._on_air: list[tuple[int, Heard]] = []
        self._under_way: list[tuple[int, Heard]] = []
        self.undelivered: Final[Counter[str]] = Counter()

    @property
    def next_due_ns(self) -> int | None:
        """When the next message of those that have been decided on is heard; ``None``: none is."""
        return min((due_ns for due_ns, _ in self._under_way), default=None)

    def see_neighbours(self, stamp_ns: int, distances_m: Mapping[str, float]) -> None:
        """Note who is in range from ``stamp_ns`` on, not before what was noted last.

        Args:
            stamp_ns: from when on.
            distances_m: how far away each neighbour is.
        """
        self._since_ns.append(stamp_ns)
        self._neighbours.append(distances_m)

    def receive(self, message: TeamMessage, said_ns: int, taken_ns: int | None = None) -> None:
        """Take a message off the air, whoever sent it.

        Args:
            message: what was said.
            said_ns: when, by the sender's clock.
            taken_ns: when it was taken, by the agent's own clock if that may be another: what was
                heard was said before.
        """
        sent_ns = said_ns
        if taken_ns is not None:
            sent_ns = max(min(said_ns, taken_ns), said_ns - (self._lag_ns or 0))
        self._on_air.append((sent_ns, Heard(message, said_ns)))

    def heard(self, now_ns: int) -> list[Heard]:
        """Return, and forget, the messages that are heard by now.

        The order depends on the messages only, not on when they were taken off the air.
        """
        reached = [entry for entry in self._on_air if self._is_reached(entry, now_ns)]
        self._on_air = [entry for entry in self._on_air if not self._is_reached(entry, now_ns)]
        for sent_ns, own in sorted(reached, key=_turn):
            self._pass_on(own, sent_ns)
        due = [entry for entry in self._under_way if entry[0] <= now_ns]
        self._under_way = [entry for entry in self._under_way if entry[0] > now_ns]
        self._forget_before(now_ns)
        return [own for _, own in sorted(due, key=_turn)]

    def _is_reached(self, entry: tuple[int, Heard], now_ns: int) -> bool:
        """Tell whether a message can be decided on."""
        sent_ns, own = entry
        is_known = self._lag_ns is None or self._since_ns[-1] >= own.said_ns - self._lag_ns
        return is_known and sent_ns + self._latency_ns <= now_ns

    def _pass_on(self, own: Heard, sent_ns: int) -> None:
        """Decide on a message for which the fixed latency has passed."""
        reached_ns = sent_ns + self._latency_ns
        distance_m = self._distance_m(own.message.sender, reached_ns)
        if distance_m is None:
            self.undelivered[self._unlinked] += 1
            return
        passage = self._channel.carry(own.message, sent_ns, distance_m)
        if passage.obstacle:
            self.undelivered[passage.obstacle] += 1
        self._under_way += [(reached_ns + delay_ns, own) for delay_ns in passage.delays_ns]

    def _distance_m(self, sender: str, time_ns: int) -> float | None:
        """Return how far away a neighbour was at a time; ``None`` if it was none."""
        known = bisect_right(self._since_ns, time_ns) - 1
        return self._neighbours[known].get(sender) if known >= 0 else None

    def _forget_before(self, now_ns: int) -> None:
        """Keep what decides on messages that are still to come, and no more."""
        oldest = max(0, bisect_right(self._since_ns, now_ns - _MEMORY_NS) - 1)
        del self._since_ns[:oldest], self._neighbours[:oldest]


def _turn(entry: tuple[int, Heard]) -> tuple[int, str, int]:
    """Return what messages are sorted by: time, sender, kind; else they stay as they came."""
    time_ns, own = entry
    return time_ns, own.message.sender, _KIND_RANK[type(own.message)]
