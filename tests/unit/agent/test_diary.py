"""Meetings ahead, in the order of their windows."""

import pytest

from tlcomm_core.agent.diary import Appointment, Diary, Prospect
from tlcomm_core.game.strategy import Strategy
from tlcomm_core.geometry import Pose

NOW = Prospect(Pose(0.0, 0.0, 0.0), 3, 12.0)


def appointment(window: int, task_index: int) -> Appointment:
    """Return one with that window's number for a partner, at its tenfold for a time."""
    own = Strategy("one", 1.0, float(window), task_index, 10.0 * window - 1.0, 0.0)
    return Appointment(f"{window}", window, own, 10.0 * window, Pose(1.0, float(window), 0.5))


def test_who_has_nothing_ahead_goes_on_now() -> None:
    """The prospect is the present."""
    diary = Diary(5.0)
    assert diary.first is None
    assert diary.prospect(NOW) == NOW


def test_the_prospect_is_after_the_last() -> None:
    """Where that meeting is, with its step done, when it is over."""
    diary = Diary(5.0)
    diary.add(appointment(2, 4))
    diary.add(appointment(3, 6))
    assert diary.first == appointment(2, 4)
    assert diary.prospect(NOW) == Prospect(Pose(1.0, 3.0, 0.5), 6, 35.0)
    assert [diary.take(), diary.take()] == [appointment(2, 4), appointment(3, 6)]
    assert diary.prospect(NOW) == NOW


def test_who_lags_behind_does_as_many_steps_between_as_agreed() -> None:
    """All that is ahead comes after as many steps less; times and places stay."""
    diary = Diary(5.0)
    diary.add(appointment(2, 4))
    diary.add(appointment(3, 6))
    diary.postpone(2)
    assert [diary.take(), diary.take()] == [appointment(2, 2), appointment(3, 4)]


def test_poses_follow_the_map() -> None:
    """The prospect is where the agent will stand, not where it was to."""
    diary = Diary(5.0)
    diary.add(appointment(2, 4))
    diary.stand(lambda own: Pose(2.0, own.own.y_m, 0.0))
    assert diary.prospect(NOW).pose == Pose(2.0, 2.0, 0.0)
    assert diary.take().own == appointment(2, 4).own


def test_windows_come_in_order() -> None:
    """An appointment before another is a mistake of ours."""
    diary = Diary(5.0)
    diary.add(appointment(3, 4))
    with pytest.raises(AssertionError):
        diary.add(appointment(2, 6))
