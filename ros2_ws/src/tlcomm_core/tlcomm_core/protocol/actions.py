"""What the protocol asks for: immutable requests, in the imperative.

``SendMessage``   say something to whoever is in range
``HoldStrategy``  publish the team strategy that this agent holds as agreed
``CountIgnored``  count a message that was late, duplicate, foreign or malformed
``Action``        any of them
"""

from dataclasses import dataclass

from tlcomm_core.game.strategy import TeamStrategy
from tlcomm_core.protocol.messages import Message

__all__ = ["Action", "CountIgnored", "HoldStrategy", "SendMessage"]


@dataclass(frozen=True, slots=True)
class SendMessage:
    """Say something to whoever is in range."""

    message: Message


@dataclass(frozen=True, slots=True)
class HoldStrategy:
    """Publish the team strategy that this agent now holds as agreed."""

    strategy: TeamStrategy


@dataclass(frozen=True, slots=True)
class CountIgnored:
    """Count a message that changed nothing, by its reason."""

    reason: str


Action = SendMessage | HoldStrategy | CountIgnored
