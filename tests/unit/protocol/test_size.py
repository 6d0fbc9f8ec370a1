"""Lengths of messages, counted."""

from dataclasses import replace

from tlcomm_core.game.offer import MemberOffer, PlannedStop
from tlcomm_core.game.strategy import Strategy
from tlcomm_core.protocol.messages import BestResponse, Confirmation, PlanOffer, Proposal
from tlcomm_core.protocol.size import size_bytes

STOP = PlannedStop(1, 2.0, 3.0, 0.5, 4.0)
OFFER = MemberOffer("b", 1.0, 2.0, 3.0, 0.0, 1.0, 1.5, (STOP, STOP), ("danger",))


def test_a_confirmation_is_counted_by_hand() -> None:
    """4 of encapsulation, 8 + 8 of header, 6 + 2, 4 + 4, then 8, 4, 4 + 2, and 2 to fill."""
    assert size_bytes(Confirmation("b", 1, 2, 7, ("b",))) == 4 + 16 + 8 + 8 + 8 + 4 + 6 + 2


def test_names_count_by_their_bytes() -> None:
    """As UTF-8, and with what aligns the field behind."""
    short, long = (Confirmation(name, 1, 2, 7, ()) for name in ("b", "béé"))
    assert size_bytes(long) == size_bytes(short) + 8


def test_offers_grow_with_their_stops() -> None:
    """A stop takes one index and four doubles; columns without stops take their lengths alone."""
    message = PlanOffer("b", 1, ("b",), (OFFER,))
    sizes = [
        size_bytes(replace(message, offers=(replace(OFFER, stops=(STOP,) * count),)))
        for count in (0, 2, 4, 10)
    ]
    assert sizes[2] - sizes[1] == 2 * (4 + 4 * 8)
    assert sizes[3] - sizes[2] == 6 * (4 + 4 * 8)
    assert size_bytes(replace(message, offers=(OFFER, OFFER))) > 2 * (sizes[1] - 40)


def test_a_proposal_grows_with_the_team() -> None:
    """A strategy takes a name, a place of three doubles, an index and two doubles."""
    strategy = Strategy("b", 1.0, 2.0, 3, 4.0, 5.0)
    small, large = (
        size_bytes(Proposal("b", 1, 0, 0, "b", 9.0, 3.0, (strategy,) * count)) for count in (2, 5)
    )
    assert large - small == 3 * (4 + 2 + 2 + 3 * 8 + 4 + 4 + 2 * 8)


def test_a_best_response_has_one_length() -> None:
    """Whatever its numbers are."""
    strategy = Strategy("b", 1.0, 2.0, 3, 4.0, 5.0)
    message = BestResponse("b", 1, 2, 0, "b", -1.0, strategy)
    assert size_bytes(message) == size_bytes(replace(message, iteration=10**9, change_s=-1e300))
