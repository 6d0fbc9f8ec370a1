"""What an agent's radio lets through: messages of neighbours, at the instant they arrive.

``Radio``  the filter between what is on the air and what the agent hears

Over ROS every agent's messages reach every process; range is this filter's doing, as loss and
delay would be. It knows the agent's own neighbours, and nothing else of the connectivity.
"""

from bisect import bisect_right
from typing import Final

from tlcomm_core.protocol.messages import BestResponse, Confirmation, Message, PlanOffer, Proposal

__all__ = ["Radio"]

# Messages that one sender sends at the same instant are heard in this order of their kinds, since
# ROS keeps the order on each topic only.
_KIND_RANK: Final[dict[type[Message], int]] = {
    PlanOffer: 0,
    Proposal: 1,
    BestResponse: 2,
    Confirmation: 3,
}

# Free running, a message may be taken off the air some time after it arrived, and links may have
# changed since. One that comes later than this isn't let through.
_MEMORY_NS: Final = 10_000_000_000


class Radio:
    """The filter between what is on the air and what the agent hears."""

    def __init__(self, latency_ns: int) -> None:
        """Begin without neighbours.

        Args:
            latency_ns: time from sending to hearing.
        """
        self._latency_ns = latency_ns
        self._since_ns: list[int] = [-1]
        self._neighbours: list[frozenset[str]] = [frozenset()]
        self._on_air: list[tuple[int, Message]] = []
        self.out_of_range = 0

    def see_neighbours(self, stamp_ns: int, neighbours: frozenset[str]) -> None:
        """Note who is in range from ``stamp_ns`` on, not before what was noted last."""
        self._since_ns.append(stamp_ns)
        self._neighbours.append(neighbours)

    def receive(self, message: Message, sent_ns: int) -> None:
        """Take a message off the air, whoever sent it."""
        self._on_air.append((sent_ns + self._latency_ns, message))

    def heard(self, now_ns: int) -> list[Message]:
        """Return, and forget, the messages that have arrived by now and were in range then.

        The order depends on the messages only, not on when they were taken off the air.
        """
        arrived = [entry for entry in self._on_air if entry[0] <= now_ns]
        self._on_air = [entry for entry in self._on_air if entry[0] > now_ns]
        arrived.sort(key=lambda entry: (entry[0], entry[1].sender, _KIND_RANK[type(entry[1])]))
        messages = [message for due_ns, message in arrived if self._is_in_range(message, due_ns)]
        self.out_of_range += len(arrived) - len(messages)
        self._forget_before(now_ns)
        return messages

    def _is_in_range(self, message: Message, due_ns: int) -> bool:
        known = bisect_right(self._since_ns, due_ns) - 1
        return known >= 0 and message.sender in self._neighbours[known]

    def _forget_before(self, now_ns: int) -> None:
        """Keep what decides on messages that are still to come, and no more."""
        oldest = max(0, bisect_right(self._since_ns, now_ns - _MEMORY_NS) - 1)
        del self._since_ns[:oldest], self._neighbours[:oldest]
