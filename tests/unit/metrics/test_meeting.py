"""Tests of ``tlcomm_core.metrics.meeting``."""

import pytest

from support.hand_made_run import hand_made_records, hand_made_scenario, task
from tlcomm_core.agent.actions import TaskEventKind
from tlcomm_core.game.strategy import Strategy, TeamStrategy
from tlcomm_core.metrics.meeting import Meeting, meetings
from tlcomm_core.records import RunRecords, StrategyRecord


def agreed(round_: int, **detours_s: float) -> TeamStrategy:
    """Return a strategy whose members have these detours."""
    strategies = tuple(
        Strategy(name, 0.0, 0.0, 1, 0.0, detour_s) for name, detour_s in detours_s.items()
    )
    return TeamStrategy(round_, 0, strategies, 0.0, 0.0, 0.0)


def test_additional_time_is_detour_and_wait() -> None:
    """The last of three comes at 63 s, after the window has opened: the others wait for it."""
    meeting = Meeting(agreed(1, a=1.0, b=2.5, c=0.0), 60.0, {"a": 55.0, "b": 63.0, "c": 60.5})
    assert meeting.starts_s == 63.0
    assert meeting.detour_s == {"a": 1.0, "b": 2.5, "c": 0.0}
    assert meeting.wait_s == {"a": 8.0, "b": 0.0, "c": 2.5}
    assert meeting.additional_s == {"a": 9.0, "b": 2.5, "c": 2.5}
    assert [meeting.took_place_by(end_s) for end_s in (62.9, 63.0)] == [False, True]


def test_a_team_that_is_early_waits_for_its_window() -> None:
    """All are there by 50 s; t_c is 60 s."""
    meeting = Meeting(agreed(1, a=0.0, b=0.0), 60.0, {"a": 45.0, "b": 50.0})
    assert meeting.starts_s == 60.0
    assert meeting.wait_s == {"a": 15.0, "b": 10.0}


def test_without_all_members_there_is_no_meeting() -> None:
    """Who was there waited, but for nothing that took place."""
    meeting = Meeting(agreed(1, a=1.0, b=1.0), 60.0, {"a": 55.0})
    assert (meeting.starts_s, meeting.wait_s, meeting.additional_s) == (None, {}, {})
    assert not meeting.took_place_by(1000.0)


def test_meetings_of_the_hand_made_run() -> None:
    """Three are agreed on; the last is still to come."""
    found = meetings(hand_made_scenario(), hand_made_records())
    assert [(own.round, own.members, own.opens_s) for own in found] == [
        (number, ("east", "west"), 10.0 * number) for number in (1, 2, 3)
    ]
    assert [own.starts_s for own in found] == [10.0, 20.0, None]
    assert found[0].additional_s == pytest.approx({"east": 2.5, "west": 3.5})


def test_pairs_that_meet_in_one_window_are_two_meetings() -> None:
    """Each has the arrivals of its own members, and starts without the other."""
    reached = TaskEventKind.MEETING_REACHED
    first, second = agreed(1, a=0.0, b=1.0), agreed(1, c=2.0, d=3.0)
    records = RunRecords(
        tasks=[
            task(11.0, "a", reached, round_=1),
            task(12.0, "b", reached, round_=1),
            task(14.0, "c", reached, round_=1),
        ],
        strategies=[
            StrategyRecord(2, "c", second),
            StrategyRecord(2, "d", second),
            StrategyRecord(3, "a", first),
            StrategyRecord(3, "b", first),
        ],
    )
    pairs = meetings(hand_made_scenario(), records)
    assert [own.members for own in pairs] == [("a", "b"), ("c", "d")]
    assert [own.additional_s for own in pairs] == [{"a": 1.0, "b": 1.0}, {}]


def test_the_last_arrival_counts() -> None:
    """An agent that waited elsewhere first is there when it reaches its place."""
    reached = TaskEventKind.MEETING_REACHED
    strategy = agreed(1, a=0.0)
    records = RunRecords(
        tasks=[task(11.0, "a", reached, round_=1), task(13.0, "a", reached, round_=1)],
        strategies=[StrategyRecord(1, "a", strategy)],
    )
    assert meetings(hand_made_scenario(), records)[0].starts_s == 13.0
