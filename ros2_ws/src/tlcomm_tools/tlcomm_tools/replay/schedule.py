"""What is due at which time: a bag's times against a clock that can be paused.

``Schedule``  says which messages are due
"""

from collections.abc import Sequence

from tlcomm_core.errors import InputError
from tlcomm_core.units import NANOSECONDS_PER_SECOND

__all__ = ["Schedule"]


class Schedule:
    """Which messages are due, at a rate, with pauses and steps.

    Times of the bag are ``…_ns``, times of the clock that goes on outside are ``now_s``. What
    can't be published in time is due at once afterwards: nothing is ever left out.
    """

    def __init__(
        self, times_ns: Sequence[int], rate: float, now_s: float, *, loops: bool = False
    ) -> None:
        """Begin now with the first message.

        Args:
            times_ns: of the messages, not empty, ascending.
            rate: seconds of the bag per second of the clock, above 0.
            now_s: the clock's time.
            loops: whether it begins again after the end.

        Raises:
            InputError: it loops over a single instant.
        """
        if loops and times_ns[0] == times_ns[-1]:
            raise InputError("--loop: all messages to replay are of one instant")
        self._times_ns = times_ns
        self._rate = rate
        self._loops = loops
        self._next = 0
        self._since_s = now_s
        self._since_ns = float(times_ns[0])
        self._is_paused = False

    @property
    def is_over(self) -> bool:
        """Whether nothing will be due any more."""
        return self._next == len(self._times_ns) and not self._loops

    @property
    def is_paused(self) -> bool:
        """Whether nothing is due until it goes on."""
        return self._is_paused

    def reached_ns(self, now_s: float) -> int:
        """Return how far it has come, as a time of the bag."""
        if self._is_paused:
            return int(self._since_ns)
        passed_s = now_s - self._since_s
        return int(self._since_ns + passed_s * self._rate * NANOSECONDS_PER_SECOND)

    def take_due(self, now_s: float, at_most: int) -> range:
        """Return the numbers of messages that are due and weren't taken yet.

        The range never reaches beyond the end: one that begins with 0 begins the bag anew.
        """
        if self._is_paused or self.is_over:
            return range(0)
        self._begin_again_after_the_end(now_s)
        reached_ns = self.reached_ns(now_s)
        first = self._next
        last = min(first + at_most, len(self._times_ns))
        while self._next < last and self._times_ns[self._next] <= reached_ns:
            self._next += 1
        return range(first, self._next)

    def take_step(self, now_s: float) -> range:
        """Pause, and return the numbers of all messages of the next instant."""
        if self.is_over:
            return range(0)
        self._begin_again_after_the_end(now_s)
        first, instant_ns = self._next, self._times_ns[self._next]
        while self._next < len(self._times_ns) and self._times_ns[self._next] == instant_ns:
            self._next += 1
        self._is_paused = True
        self._since_ns = float(instant_ns)
        return range(first, self._next)

    def wait_s(self, now_s: float) -> float | None:
        """Return how long nothing is due; ``None`` while it is paused."""
        if self._is_paused:
            return None
        if self._next == len(self._times_ns):
            return 0.0
        ahead_ns = self._times_ns[self._next] - self.reached_ns(now_s)
        return max(0.0, ahead_ns / NANOSECONDS_PER_SECOND / self._rate)

    def toggle_pause(self, now_s: float) -> None:
        """Pause, or go on from there."""
        self._since_ns = float(self.reached_ns(now_s))
        self._since_s = now_s
        self._is_paused = not self._is_paused

    def _begin_again_after_the_end(self, now_s: float) -> None:
        if self._next == len(self._times_ns):
            self._next = 0
            self._since_s = now_s
            self._since_ns = float(self._times_ns[0])
