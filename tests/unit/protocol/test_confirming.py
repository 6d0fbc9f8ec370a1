"""Flooding confirmations."""

from dataclasses import replace

import pytest

from support.snapshots import snapshot
from tlcomm_core.game.strategy import Strategy, TeamStrategy
from tlcomm_core.protocol.confirming import Confirming, digest
from tlcomm_core.protocol.messages import Confirmation
from tlcomm_core.protocol.reception import Reception

STRATEGY = TeamStrategy(
    round=3,
    iteration=4,
    strategies=(Strategy("a", 0.5, 1.5, 7, 190.25, 3.0), Strategy("b", 1.0, 1.5, 2, 191.0, 0.0)),
    communication_s=191.0,
    potential_s=3.75,
    initial_potential_s=9.0,
)


def said(sender: str, *confirmed: str) -> Confirmation:
    """Return a confirmation of the strategy."""
    return Confirmation(sender, 3, 6, digest(STRATEGY), confirmed)


@pytest.fixture
def confirming() -> Confirming:
    """Return agent a's part in a team of three."""
    return Confirming("a", ["a", "b", "c"], 3, 6, STRATEGY)


def test_a_digest_depends_on_every_value() -> None:
    """Equal strategies have equal digests of 64 bits; the least change makes another."""
    assert digest(STRATEGY) == digest(replace(STRATEGY))
    assert 0 <= digest(STRATEGY) < 2**64
    first, second = STRATEGY.strategies
    others = [
        replace(STRATEGY, round=4),
        replace(STRATEGY, iteration=5),
        replace(STRATEGY, communication_s=191.0 + 1e-12),
        replace(STRATEGY, strategies=(second, first)),
        replace(STRATEGY, strategies=(replace(first, x_m=0.5 + 1e-15), second)),
    ]
    assert len({digest(strategy) for strategy in [STRATEGY, *others]}) == len(others) + 1


def test_ones_own_is_owed_once(confirming: Confirming) -> None:
    """Having begun, an agent says so once, and can repeat it."""
    assert confirming.strategy is STRATEGY
    assert confirming.owed() == said("a", "a")
    assert confirming.owed() is None
    assert confirming.repetition() == said("a", "a")


def test_it_is_complete_with_the_last(confirming: Confirming) -> None:
    """Confirmations count directly and by hearsay, the sender's own in any case."""
    assert confirming.hear(said("b")) is Reception.ACCEPTED
    assert not confirming.is_complete
    confirming.owed()
    assert confirming.hear(said("b", "b", "c")) is Reception.ACCEPTED
    assert confirming.is_complete
    assert confirming.owed() == said("a", "a", "b", "c")
    assert not confirming.is_shown_complete_by(["b"])
    assert confirming.hear(said("b", "a", "b", "c")) is Reception.ACCEPTED
    assert confirming.is_shown_complete_by(["b"])
    assert confirming.owed() is None


def test_a_sender_that_lacks_some_is_answered(confirming: Confirming) -> None:
    """Each time that it shows to lack one, it is told."""
    confirming.hear(said("b", "a", "b", "c"))
    confirming.owed()
    for _ in range(2):
        assert confirming.hear(said("c", "c")) is Reception.ACCEPTED
        assert confirming.owed() == said("a", "a", "b", "c")


def test_an_answer_is_owed_when_asked_for(confirming: Confirming) -> None:
    """The confirmation is told again to one who still waits."""
    confirming.owed()
    confirming.answer()
    assert confirming.owed() == said("a", "a")


_IGNORED = {
    "again": (said("b", "a", "b"), Reception.DUPLICATE),
    "of a stranger": (said("b", "b", "stranger"), Reception.FOREIGN),
    "other strategy": (replace(said("c", "c"), digest=1), Reception.CONFLICTING),
    "other iteration": (replace(said("c", "c"), iteration=5), Reception.CONFLICTING),
}


@pytest.mark.parametrize("name", _IGNORED)
def test_what_changes_nothing_is_named(confirming: Confirming, name: str) -> None:
    """What confirms something else never counts."""
    confirming.hear(said("b", "a", "b"))
    before = snapshot(confirming)
    message, reception = _IGNORED[name]
    assert confirming.hear(message) is reception
    assert snapshot(confirming) == before
