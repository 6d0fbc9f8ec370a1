"""Messages that changed nothing, counted by reason.

``Ignored``  per reason, how many
"""

from collections import Counter
from typing import Final

__all__ = ["Ignored"]

_MOST_REASONS: Final = 100
_FURTHER: Final = "further reasons"


class Ignored(Counter[str]):
    """Per reason, how many messages changed nothing; reasons that others make up are bounded."""

    def note(self, reason: str) -> str | None:
        """Count a message; return what to tell of it, ``None`` if that has been told before."""
        if reason not in self and len(self) >= _MOST_REASONS:
            reason = _FURTHER
        self[reason] += 1
        return reason if self[reason] == 1 else None
