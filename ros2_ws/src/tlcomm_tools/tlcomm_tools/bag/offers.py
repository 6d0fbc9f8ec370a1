"""The plans that agents laid open, from among all that they relayed.

``read_offers``  one agent's own
"""

import struct
from bisect import bisect_right
from collections.abc import Iterator, Sequence
from itertools import groupby
from typing import Final, NamedTuple

from rosbags.typesys.store import Typestore

from tlcomm_core.protocol.messages import PlanOffer
from tlcomm_core.records import OfferRecord
from tlcomm_core.wire.fields import WireError
from tlcomm_core.wire.team_messages import decode_message
from tlcomm_tools.bag.cdr import Cursor, is_little_endian
from tlcomm_tools.wire import DecodedMessage, stamp_ns

__all__ = ["read_offers"]

_TYPE: Final = "tlcomm_msgs/msg/PlanOffer"
_TOPIC: Final = "plan_offer"
_NUMBER: Final = struct.Struct("<I")
# The fields that lie before a message's offers, as far as they are looked at.
_BEGINNING: Final = ("header", "sender", "round")


class _Ticket(NamedTuple):
    """When a message was sent, for which round."""

    stamp_ns: int
    round: int


def read_offers(
    store: Typestore, agent: str, messages: Sequence[bytes], arrivals_ns: Sequence[int]
) -> list[OfferRecord]:
    """Return an agent's own offers, as it said each first.

    A plan is laid open on coming to a meeting, for one round or for several. So of all messages
    only the first after each arrival that is for a round need be decoded.

    Args:
        store: with the definition of ``tlcomm_msgs/PlanOffer``.
        agent: whose.
        messages: as stored, in the order of sending.
        arrivals_ns: when it has come to meetings, ascending.

    Returns:
        Those that are as messages may be.
    """
    found: list[OfferRecord] = []
    known: set[tuple[int, int]] = set()
    for data, ticket in zip(messages, _tickets(store, messages), strict=True):
        key = (bisect_right(arrivals_ns, ticket.stamp_ns), ticket.round)
        if key in known:
            continue
        try:
            said, _ = decode_message(store.deserialize_cdr(data, _TYPE), _TOPIC)
        except WireError:
            # Nobody agrees on anything with what nobody takes.
            continue
        assert isinstance(said, PlanOffer), "that is what the topic holds"
        own = next((offer for offer in said.offers if offer.agent == agent), None)
        if own is not None:
            known.add(key)
            found.append(OfferRecord(ticket.stamp_ns, agent, ticket.round, own))
    return [next(same) for _, same in groupby(found, key=lambda own: (own.round, own.offer))]


def _tickets(store: Typestore, messages: Sequence[bytes]) -> Iterator[_Ticket]:
    _, fields = store.fielddefs[_TYPE]
    begins = tuple(name for name, _ in fields[: len(_BEGINNING)])
    is_usual = begins == _BEGINNING and all(map(is_little_endian, messages))
    for data in messages:
        if is_usual:
            yield _glanced(data)
        else:
            message: DecodedMessage = store.deserialize_cdr(data, _TYPE)
            yield _Ticket(stamp_ns(message.header.stamp), int(message.round))


def _glanced(data: bytes) -> _Ticket:
    """Return a message's ticket without decoding it."""
    cursor = Cursor(data)
    sent_ns = cursor.take_stamp_ns()
    # The frame and the sender.
    cursor.skip_text()
    cursor.skip_text()
    (number,) = cursor.take(_NUMBER)
    return _Ticket(sent_ns, number)
