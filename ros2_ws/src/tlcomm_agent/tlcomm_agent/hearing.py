"""What an agent has heard, put together until it is published.

``Hearing``   what an agent heard when
``Hearings``  messages that the radio let through since the last time
``HOLD_NS``   how long they are kept back

A message about each message would double what is recorded of a meeting. So they are kept until
the agent acts half a second later or more, and are published with their own times.
"""

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Final

from tlcomm_core.agent.radio import Heard

__all__ = ["HOLD_NS", "Hearing", "Hearings"]

HOLD_NS: Final = 500_000_000


@dataclass(frozen=True, slots=True)
class Hearing:
    """What an agent heard.

    Attributes:
        agent: its name.
        heard: when it acted (ns), and upon what.
    """

    agent: str
    heard: tuple[tuple[int, Heard], ...]


class Hearings:
    """Messages that the radio let through since the last time they were taken."""

    def __init__(self, agent: str) -> None:
        """Begin without any that this agent has heard."""
        self._agent: Final = agent
        self._held: list[tuple[int, Heard]] = []

    def note(self, heard: Iterable[Heard], now_ns: int) -> bool:
        """Keep what the agent has acted upon now; tell whether it is time to publish all."""
        self._held += [(now_ns, own) for own in heard]
        return bool(self._held) and now_ns - self._held[0][0] >= HOLD_NS

    def take(self) -> Hearing:
        """Return them all, and forget them."""
        held, self._held = self._held, []
        return Hearing(self._agent, tuple(held))
