"""When to begin: publishers and subscribers find each other one by one.

``Audience``  tells when everybody is there
"""

from typing import Final

__all__ = ["Audience"]

# Who is there already is found by all publishers within less, on one machine.
_SETTLED_S: Final = 0.5


class Audience:
    """Tells when everybody is there: somebody, and nobody new for half a second.

    Without anybody it gives up after a while, and says so by being complete.
    """

    def __init__(self, now_s: float, patience_s: float) -> None:
        """Begin to wait.

        Args:
            now_s: time of a clock.
            patience_s: how long to wait for the first one.
        """
        self._matched = 0
        self._changed_s = now_s
        self._until_s = now_s + patience_s

    def is_complete(self, now_s: float, matched: int) -> bool:
        """Return whether to begin, with so many subscriptions found by now."""
        if matched != self._matched:
            self._matched, self._changed_s = matched, now_s
        if matched == 0:
            return now_s >= self._until_s
        return now_s >= self._changed_s + _SETTLED_S
