"""Counting team messages that have arrived, in the order in which they were sent.

``Arrivals``  how many of each sender's messages are due and have come

A sender's messages travel on several topics, and ROS keeps the order on each of them only: a later
message may overtake an earlier one. So it isn't enough that as many messages have come as a tick
counts; they must be those that were sent early enough to be due at the tick.
"""

import heapq
from collections.abc import Iterable

__all__ = ["Arrivals"]


class Arrivals:
    """How many of each sender's messages are due and have come."""

    def __init__(self, senders: Iterable[str], latency_ns: int) -> None:
        """Begin without any.

        Args:
            senders: whose messages come.
            latency_ns: a message sent at t is due at t + latency.
        """
        self._latency_ns = latency_ns
        self._due = dict.fromkeys(senders, 0)
        self._early: dict[str, list[int]] = {sender: [] for sender in self._due}

    def note(self, sender: str, sent_ns: int) -> None:
        """Count a message that came."""
        heapq.heappush(self._early[sender], sent_ns)

    def are_complete(self, counts: dict[str, int], now_ns: int) -> bool:
        """Return whether of every sender as many messages have come as are due.

        Args:
            counts: of each sender, how many messages are due since the start.
            now_ns: the time, which never goes back from call to call.
        """
        for sender, early in self._early.items():
            while early and early[0] + self._latency_ns <= now_ns:
                heapq.heappop(early)
                self._due[sender] += 1
        return all(self._due[sender] >= counts[sender] for sender in self._due)
