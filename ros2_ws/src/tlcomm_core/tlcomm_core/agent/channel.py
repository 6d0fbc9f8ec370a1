"""What becomes of a message between two agents in range.

``Passage``  how late it is heard, or why it isn't
``Channel``  decides on all messages to one agent

A message waits until those that its sender sent before are through (bandwidth); then it may be
lost, be delayed at random, and be heard twice. Chance is drawn from the message alone: from the
run's seed, who says it to whom, when, and what. So its fate depends neither on what else is on the
air nor on the order in which messages are taken off it, and is the same in every harness.
"""

import math
from collections.abc import Iterator
from dataclasses import dataclass, fields
from hashlib import blake2b
from typing import Final

from tlcomm_core.protocol.messages import TeamMessage
from tlcomm_core.protocol.size import size_bytes
from tlcomm_core.scenario.model import Radio
from tlcomm_core.units import NANOSECONDS_PER_SECOND, nanoseconds

__all__ = ["CONGESTED", "LOST", "Channel", "Passage"]

LOST: Final = "lost"
CONGESTED: Final = "congested"

# A message that would wait longer than this before its first bit is sent is dropped.
_LONGEST_QUEUE_NS: Final = 1_000_000_000

_BITS_PER_BYTE: Final = 8
_DRAWS: Final = 4
_DRAW_BYTES: Final = 8
_DRAW_BITS: Final = 53


@dataclass(frozen=True, slots=True)
class Passage:
    """What becomes of a message.

    Attributes:
        delays_ns: how long after the fixed latency each copy of it is heard; none if it isn't.
        obstacle: why it isn't heard, or "".
    """

    delays_ns: tuple[int, ...]
    obstacle: str = ""


_AT_ONCE: Final = Passage((0,))


class Channel:
    """The way of all messages to one agent."""

    def __init__(self, radio: Radio, range_m: float, seed: int, receiver: str) -> None:
        """Begin with nothing under way.

        Args:
            radio: how good it is.
            range_m: R.
            seed: the run's.
            receiver: the agent's name.
        """
        self._radio: Final = radio
        self._range_m: Final = range_m
        self._origin: Final = f"{seed}/{receiver}"
        self._jitter_ns: Final = nanoseconds(radio.jitter_s)
        self._is_certain: Final = not any(
            (radio.loss, radio.loss_at_range, radio.jitter_s, radio.duplication)
        )
        self._free_ns: dict[str, int] = {}

    def carry(self, message: TeamMessage, sent_ns: int, distance_m: float) -> Passage:
        """Return what becomes of a message.

        Args:
            message: what a neighbour says; of one sender, in the order of saying.
            sent_ns: when it says it.
            distance_m: how far away it is.
        """
        queued_ns = self._queued_ns(message, sent_ns)
        if queued_ns is None:
            return Passage((), CONGESTED)
        if self._is_certain:
            return Passage((queued_ns,)) if queued_ns else _AT_ONCE
        lost, late, doubled, doubly_late = self._draws(message, sent_ns)
        if lost < self._loss(distance_m):
            return Passage((), LOST)
        delays_ns = [queued_ns + round(late * self._jitter_ns)]
        if doubled < self._radio.duplication:
            delays_ns.append(queued_ns + round(doubly_late * self._jitter_ns))
        return Passage(tuple(delays_ns))

    def _loss(self, distance_m: float) -> float:
        """Return the probability of loss: linear in the distance."""
        near, far = self._radio.loss, self._radio.loss_at_range
        if far is None:
            return near
        return near + (far - near) * min(distance_m / self._range_m, 1.0)

    def _queued_ns(self, message: TeamMessage, sent_ns: int) -> int | None:
        """Return how long it takes until the message is through; ``None`` if it is dropped."""
        if self._radio.bandwidth_bps is None:
            return 0
        begin_ns = max(sent_ns, self._free_ns.get(message.sender, 0))
        if begin_ns - sent_ns > _LONGEST_QUEUE_NS:
            return None
        bits = _BITS_PER_BYTE * size_bytes(message)
        on_air_ns = math.ceil(bits * NANOSECONDS_PER_SECOND / self._radio.bandwidth_bps)
        self._free_ns[message.sender] = begin_ns + on_air_ns
        return begin_ns + on_air_ns - sent_ns

    def _draws(self, message: TeamMessage, sent_ns: int) -> Iterator[float]:
        """Yield numbers in [0, 1) that are the message's own, as if drawn at random."""
        key = f"{self._origin}/{sent_ns}/{_ticket(message)}"
        digest = blake2b(key.encode(), digest_size=_DRAWS * _DRAW_BYTES).digest()
        for start in range(0, len(digest), _DRAW_BYTES):
            bits = int.from_bytes(digest[start : start + _DRAW_BYTES], "big")
            yield (bits >> (_BITS_PER_BYTE * _DRAW_BYTES - _DRAW_BITS)) * 2.0**-_DRAW_BITS


def _ticket(message: TeamMessage) -> str:
    """Return what tells a message from all others of the same instant; of offers, whose."""
    values = (getattr(message, field.name) for field in fields(message))
    words = [
        " ".join(str(getattr(item, "agent", item)) for item in value)
        if isinstance(value, tuple)
        else str(value)
        for value in values
    ]
    return "/".join((type(message).__name__, *words))
