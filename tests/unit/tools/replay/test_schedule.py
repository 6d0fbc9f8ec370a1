"""Tests of ``tlcomm_tools.replay.schedule``."""

import pytest

from tlcomm_core.errors import InputError
from tlcomm_tools.replay.schedule import Schedule

# Two messages at 1 s, one at 2 s and one at 4 s.
TIMES_NS = (10**9, 10**9, 2 * 10**9, 4 * 10**9)
MANY = 100


def test_messages_are_due_at_the_rate() -> None:
    """At rate 2 a second of the bag takes half a second, from whenever it begins."""
    schedule = Schedule(TIMES_NS, 2.0, 100.0)
    assert schedule.take_due(100.0, MANY) == range(2)
    assert schedule.wait_s(100.0) == pytest.approx(0.5)
    assert list(schedule.take_due(100.49, MANY)) == []
    assert schedule.take_due(100.5, MANY) == range(2, 3)
    assert schedule.wait_s(101.0) == pytest.approx(0.5)
    assert not schedule.is_over
    assert schedule.take_due(101.5, MANY) == range(3, 4)
    assert schedule.is_over
    assert list(schedule.take_due(200.0, MANY)) == []


def test_what_is_late_is_due_at_once() -> None:
    """Nothing is left out, a few at a time."""
    schedule = Schedule(TIMES_NS, 1.0, 0.0)
    assert [schedule.take_due(50.0, 3), schedule.take_due(50.0, 3)] == [range(3), range(3, 4)]


def test_a_pause_takes_no_time_of_the_bag() -> None:
    """What was half a second ahead is so still, however long the pause."""
    schedule = Schedule(TIMES_NS, 1.0, 0.0)
    schedule.take_due(0.5, MANY)
    schedule.toggle_pause(0.5)
    assert schedule.is_paused
    assert schedule.wait_s(60.0) is None
    assert list(schedule.take_due(60.0, MANY)) == []
    assert schedule.reached_ns(60.0) == 1.5e9
    schedule.toggle_pause(60.0)
    assert schedule.wait_s(60.0) == pytest.approx(0.5)
    assert schedule.take_due(60.5, MANY) == range(2, 3)


def test_a_pause_holds_what_is_late() -> None:
    """What was due already, but not taken, waits as well."""
    schedule = Schedule(TIMES_NS, 1.0, 0.0)
    schedule.take_due(50.0, 1)
    schedule.toggle_pause(50.0)
    assert list(schedule.take_due(50.0, MANY)) == []
    schedule.toggle_pause(50.0)
    assert schedule.take_due(50.0, MANY) == range(1, 4)


def test_a_step_is_an_instant() -> None:
    """A step pauses and takes all of the next instant; going on, time continues from there."""
    schedule = Schedule(TIMES_NS, 1.0, 0.0)
    assert schedule.take_step(0.0) == range(2)
    assert schedule.is_paused
    assert schedule.take_step(7.0) == range(2, 3)
    assert schedule.reached_ns(7.0) == 2e9
    schedule.toggle_pause(10.0)
    assert schedule.wait_s(10.0) == pytest.approx(2.0)
    assert schedule.take_step(10.0) == range(3, 4)
    assert schedule.is_over
    assert schedule.take_step(10.0) == range(0)


def test_a_loop_begins_again() -> None:
    """After the last message the first are due at once, and the rest as before."""
    schedule = Schedule(TIMES_NS, 1.0, 0.0, loops=True)
    assert schedule.take_due(3.0, MANY) == range(4)
    assert not schedule.is_over
    assert schedule.wait_s(3.0) == 0.0
    assert schedule.take_due(3.0, MANY) == range(2)
    assert schedule.wait_s(3.0) == pytest.approx(1.0)
    schedule.take_due(6.0, MANY)
    assert schedule.take_step(6.0) == range(2)


def test_a_loop_needs_time() -> None:
    """One instant can't be repeated for ever."""
    with pytest.raises(InputError, match="--loop: all messages to replay are of one instant"):
        Schedule((5, 5), 1.0, 0.0, loops=True)
