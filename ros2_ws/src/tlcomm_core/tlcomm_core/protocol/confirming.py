"""The last phase: everyone says that it holds the team strategy.

``Confirming``  one agent's part in flooding the confirmations
``digest``      64 bits that stand for a team strategy
"""

import hashlib
import json
from collections.abc import Iterable
from dataclasses import asdict

from tlcomm_core.game.strategy import TeamStrategy
from tlcomm_core.protocol.flooding import Flood
from tlcomm_core.protocol.messages import Confirmation
from tlcomm_core.protocol.reception import Reception

__all__ = ["Confirming", "digest"]


def digest(strategy: TeamStrategy) -> int:
    """Return 64 bits that are equal for equal team strategies, and hardly ever for others."""
    text = json.dumps(asdict(strategy), sort_keys=True)
    return int.from_bytes(hashlib.sha256(text.encode()).digest()[:8], "big")


class Confirming:
    """One agent's part in flooding the confirmations.

    An agent confirms one team strategy per round only, and relays only confirmations of the same
    one. So once all members' confirmations are known, no member ever holds another for this round.
    """

    def __init__(
        self, own: str, members: Iterable[str], round_: int, iteration: int, strategy: TeamStrategy
    ) -> None:
        """Confirm ``strategy``, the result of ``iteration``; this is owed to the neighbours."""
        self._own = own
        self._round = round_
        self._members = frozenset(members)
        self._iteration = iteration
        self._strategy = strategy
        self._digest = digest(strategy)
        self._flood: Flood[None] = Flood(self._members, own, None)
        self._is_owed = True

    @property
    def strategy(self) -> TeamStrategy:
        """What is confirmed."""
        return self._strategy

    @property
    def is_complete(self) -> bool:
        """Whether all members are known to have confirmed."""
        return self._flood.is_complete

    def is_shown_complete_by(self, neighbours: Iterable[str]) -> bool:
        """Return whether each neighbour has shown that it knows that all have confirmed."""
        return self._flood.is_shown_complete_by(neighbours)

    def hear(self, message: Confirmation) -> Reception:
        """Take in who has confirmed the same."""
        confirmed = {*message.confirmed, message.sender}
        if not confirmed <= self._members:
            return Reception.FOREIGN
        if (message.digest, message.iteration) != (self._digest, self._iteration):
            return Reception.CONFLICTING
        told = self._flood.learn(message.sender, confirmed, dict.fromkeys(confirmed))
        if told is None:
            return Reception.DUPLICATE
        self._is_owed |= bool(told)
        return Reception.ACCEPTED

    def answer(self) -> None:
        """Owe the confirmation once more, to one who says that it still waits."""
        self._is_owed = True

    def owed(self) -> Confirmation | None:
        """Return what is to be told now, if anything."""
        if not self._is_owed:
            return None
        self._is_owed = False
        return self.repetition()

    def repetition(self) -> Confirmation:
        """Return what to repeat while a neighbour may lack it."""
        return Confirmation(
            sender=self._own,
            round=self._round,
            iteration=self._iteration,
            digest=self._digest,
            confirmed=self._flood.known,
        )
