"""Flooding offers."""

from dataclasses import replace

import pytest

from support.meetings import make_offers, make_team
from support.snapshots import snapshot
from tlcomm_core.game.offer import MemberOffer
from tlcomm_core.protocol.gathering import Gathering
from tlcomm_core.protocol.messages import PlanOffer
from tlcomm_core.protocol.reception import Reception

OFFERS = make_offers([(0.0, 0.0), (0.9, 0.0), (1.8, 0.0)], [58.0, 63.0, 61.0])
A, B, C = (offer.agent for offer in OFFERS)


def told(sender: str, known: tuple[str, ...], *offers: MemberOffer) -> PlanOffer:
    """Return a message for round 2."""
    return PlanOffer(sender, 2, known, offers)


@pytest.fixture
def gathering() -> Gathering:
    """Return the first agent's part for round 2; an offer is sound with two stops."""
    return Gathering(OFFERS[0], 2, make_team(3), lambda offer: len(offer.stops) == 2)


def test_the_own_offer_is_owed_once(gathering: Gathering) -> None:
    """It is told at first, and not again unless asked for or repeated."""
    assert gathering.owed() == told(A, (A,), OFFERS[0])
    assert gathering.owed() is None
    assert gathering.repetition() == told(A, (A,), OFFERS[0])


def test_the_whole_team_is_here_when_all_offers_are(gathering: Gathering) -> None:
    """Presence and the meeting's beginning follow from the offers, sorted by agent."""
    gathering.hear(told(B, (B, C), OFFERS[2], OFFERS[1]))
    assert gathering.is_complete
    assert gathering.offers == OFFERS
    assert gathering.meeting_s == 63.0


def test_to_be_told_of_isnt_to_hold(gathering: Gathering) -> None:
    """That a neighbour knows an offer doesn't make it known here."""
    assert gathering.hear(told(B, (A, B, C), OFFERS[1])) is Reception.ACCEPTED
    assert not gathering.is_complete


def test_the_meeting_begins_in_its_window() -> None:
    """Who all are here early begin when the window opens."""
    early = Gathering(replace(OFFERS[0], arrival_s=12.0), 2, make_team(1), lambda _: True)
    assert early.is_complete
    assert early.meeting_s == 60.0


def test_what_is_new_is_relayed_and_what_is_lacking_told(gathering: Gathering) -> None:
    """One message tells both: a new offer to those beyond, one's own to the sender."""
    gathering.owed()
    gathering.hear(told(B, (B,), OFFERS[1]))
    assert gathering.owed() == told(A, (A, B), *OFFERS[:2])
    assert gathering.repetition() == told(A, (A, B), OFFERS[0])
    gathering.hear(told(B, (A, B, C), OFFERS[2]))
    assert gathering.owed() == told(A, (A, B, C), OFFERS[2])


def test_a_question_is_answered_again(gathering: Gathering) -> None:
    """A sender that shows once more what it lacks is told once more, whoever else isn't."""
    gathering.hear(told(B, (B,), OFFERS[1]))
    gathering.owed()
    assert gathering.hear(told(B, (B,), OFFERS[1])) is Reception.ACCEPTED
    assert gathering.owed() == told(A, (A, B), OFFERS[0])


def test_what_neighbours_lack_is_repeated(gathering: Gathering) -> None:
    """To given neighbours all that they haven't shown is told, or nothing."""
    gathering.hear(told(B, (A, B), OFFERS[1]))
    assert gathering.lacking([B]) is None
    assert gathering.lacking([B, C]) == told(A, (A, B), *OFFERS[:2])


_STRANGER = replace(OFFERS[1], agent="stranger")
_IGNORED = {
    "again": (told(B, (A, B), OFFERS[1]), Reception.DUPLICATE),
    "less than before": (told(B, (A, B)), Reception.DUPLICATE),
    "knows a stranger": (told(B, (A, B, "stranger"), OFFERS[2]), Reception.FOREIGN),
    "offer of a stranger": (told(B, (A, B), OFFERS[2], _STRANGER), Reception.FOREIGN),
    "unsound": (told(B, (A, B, C), replace(OFFERS[2], stops=())), Reception.MALFORMED),
    "twice in one": (
        told(B, (A, B, C), OFFERS[2], replace(OFFERS[2], x_m=1.7)),
        Reception.MALFORMED,
    ),
    "another of its own": (told(B, (A, B), replace(OFFERS[1], x_m=0.8)), Reception.CONFLICTING),
    "another of mine": (told(C, (A, C), replace(OFFERS[0], x_m=0.1)), Reception.CONFLICTING),
    "half of it wrong": (
        told(B, (A, B, C), OFFERS[2], replace(OFFERS[1], x_m=0.8)),
        Reception.CONFLICTING,
    ),
}


@pytest.mark.parametrize("name", _IGNORED)
def test_what_changes_nothing_is_named(gathering: Gathering, name: str) -> None:
    """A message is taken in as a whole or not at all, and why not is told."""
    gathering.hear(told(B, (A, B), OFFERS[1]))
    before = snapshot(gathering)
    message, reception = _IGNORED[name]
    assert gathering.hear(message) is reception
    assert snapshot(gathering) == before
