"""How long messages are when they are sent.

``size_bytes``  of one message

Counted, not measured, so that it is known without ROS: the fields as the ``.msg`` files list them,
in the plain encoding of the Common Data Representation (OMG DDS-XTypes 1.3, XCDR version 1), with
its alignment, four bytes of encapsulation and the header's stamp and frame, and filled up to whole
words of four bytes, in which DDS sends it (OMG DDSI-RTPS 2.3, 9.4.1). What UDP and the middleware
wrap around it isn't counted.
"""

from collections.abc import Collection
from typing import Final, assert_never

from tlcomm_core.game.offer import MemberOffer
from tlcomm_core.game.strategy import Strategy
from tlcomm_core.protocol.messages import (
    BestResponse,
    Confirmation,
    EstimateExchange,
    PlanOffer,
    Proposal,
    TeamMessage,
)

__all__ = ["size_bytes"]

_ENCAPSULATION: Final = 4
_WORD: Final = 4
_FRAME: Final = "map"
_BYTE, _SHORT, _INT, _DOUBLE = 1, 2, 4, 8


def size_bytes(message: TeamMessage) -> int:
    """Return the length of a message as it is serialised for sending."""
    layout = _Layout()
    layout.numbers(_INT, 2)
    layout.text(_FRAME)
    layout.text(message.sender)
    match message:
        case PlanOffer():
            layout.numbers(_INT)
            layout.texts(message.known)
            layout.numbers(_INT)
            for offer in message.offers:
                _lay_offer(layout, offer)
        case Proposal():
            layout.numbers(_INT, 2)
            layout.numbers(_SHORT)
            layout.text(message.candidate)
            layout.numbers(_DOUBLE, 2)
            layout.numbers(_INT)
            for strategy in message.strategies:
                _lay_strategy(layout, strategy)
        case BestResponse():
            layout.numbers(_INT, 2)
            layout.numbers(_SHORT)
            layout.text(message.candidate)
            layout.numbers(_DOUBLE)
            _lay_strategy(layout, message.strategy)
        case Confirmation():
            layout.numbers(_INT, 2)
            layout.numbers(_DOUBLE)
            layout.texts(message.confirmed)
        case EstimateExchange():
            layout.numbers(_INT)
            layout.numbers(_SHORT)
            layout.numbers(_BYTE)
            layout.numbers(_DOUBLE)
            layout.numbers(_INT)
            for measurement in message.known:
                layout.text(measurement.agent)
                layout.numbers(_DOUBLE, 2)
        case _:
            assert_never(message)
    return _ENCAPSULATION + layout.end + -layout.end % _WORD


class _Layout:
    """Fields one behind the other, each aligned to its width."""

    def __init__(self) -> None:
        self.end = 0

    def numbers(self, width: int, count: int = 1) -> None:
        """Add some numbers of equal width; what aligns them is there even if they are none."""
        self.end += -self.end % width + width * count

    def text(self, value: str) -> None:
        """Add a text: its length, its bytes and a zero."""
        self.numbers(_INT)
        self.end += len(value.encode()) + 1

    def texts(self, values: Collection[str]) -> None:
        """Add texts, their number first."""
        self.numbers(_INT)
        for value in values:
            self.text(value)

    def column(self, width: int, count: int) -> None:
        """Add numbers of equal width, how many first."""
        self.numbers(_INT)
        self.numbers(width, count)


def _lay_offer(layout: _Layout, offer: MemberOffer) -> None:
    layout.text(offer.agent)
    layout.numbers(_DOUBLE, 7)
    layout.texts(offer.avoided)
    layout.numbers(_DOUBLE)
    layout.column(_INT, len(offer.stops))
    for _ in range(4):
        layout.column(_DOUBLE, len(offer.stops))


def _lay_strategy(layout: _Layout, strategy: Strategy) -> None:
    layout.text(strategy.agent)
    layout.numbers(_DOUBLE, 3)
    layout.numbers(_INT)
    layout.numbers(_DOUBLE, 2)
