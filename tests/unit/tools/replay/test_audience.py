"""Tests of ``tlcomm_tools.replay.audience``."""

from tlcomm_tools.replay.audience import Audience


def test_it_waits_for_the_last_one() -> None:
    """Half a second after the latest subscriber it is complete, patience or not."""
    audience = Audience(0.0, 100.0)
    assert not audience.is_complete(1.0, 0)
    assert not audience.is_complete(2.0, 1)
    assert not audience.is_complete(2.4, 2)
    assert not audience.is_complete(2.8, 2)
    assert audience.is_complete(2.9, 2)


def test_it_gives_up() -> None:
    """Without a subscriber it goes on when patience is at its end."""
    audience = Audience(10.0, 2.0)
    assert not audience.is_complete(11.9, 0)
    assert audience.is_complete(12.0, 0)
