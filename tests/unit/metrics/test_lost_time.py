"""Tests of ``tlcomm_core.metrics.lost_time``, by hand."""

import math

import pytest

from support.gate import OPENED_S, SHUT_S, gate
from support.hand_made_run import hand_made_records, hand_made_scenario, task
from tlcomm_core.agent.actions import TaskEventKind
from tlcomm_core.geometry import Pose
from tlcomm_core.metrics.lost_time import LostTime, lost_time
from tlcomm_core.records import RunRecords
from tlcomm_core.units import nanoseconds
from tlcomm_core.world.observation import Odometry

PERIOD_S = 10.0


def test_a_run_made_by_hand() -> None:
    """East leaves after 2 s, drives 2.5 m and picks for 1 s; then it goes and comes for nothing, as
    it picks there again 10 s later. West has 2 m to go, and by its odometry half a turn to make.
    """
    found = lost_time(hand_made_scenario(), hand_made_records())
    east, west = found["east"], found["west"]
    assert east.finished_s == (5.5, 15.5)
    assert east.own_work_s == pytest.approx((3.5, 4.5))
    assert east.lost_s == pytest.approx((2.0, 11.0))
    half_turn_s = math.pi / 1.5
    assert west.own_work_s == pytest.approx((3.0 + half_turn_s, 4.0 + half_turn_s))


def test_rates_are_of_the_time_between_the_first_step_and_the_last() -> None:
    """9 s were lost from 5.5 s to 15.5 s, in which one of three meetings ended."""
    east = lost_time(hand_made_scenario(), hand_made_records())["east"]
    assert east.ended_s == (2.0, 12.0, 22.0)
    assert east.per_meeting_s == pytest.approx(9.0)
    assert east.per_window_s(PERIOD_S) == pytest.approx(9.0)
    assert east.per_window_s(5.0) == pytest.approx(4.5)


def test_one_step_has_no_rates() -> None:
    """Neither a meeting nor any time is between the first step and the last."""
    alone = LostTime((5.5,), (3.5,), (2.0,))
    assert (alone.per_meeting_s, alone.per_window_s(PERIOD_S)) == (None, None)


def test_the_time_of_failed_attempts_is_lost() -> None:
    """What counts as work is the attempt that succeeds."""
    records = hand_made_records()
    again = task(5.0, "east", TaskEventKind.ACTION_STARTED, region="right", action="pick")
    records.tasks = sorted([*records.tasks, again], key=lambda own: own.stamp_ns)
    assert lost_time(hand_made_scenario(), records)["east"].own_work_s[0] == pytest.approx(3.0)


def test_who_finished_nothing_lost_nothing_known() -> None:
    """It isn't there; neither is anybody without any records."""
    records = hand_made_records()
    records.tasks = [own for own in records.tasks if own.agent == "west"]
    assert lost_time(hand_made_scenario(), records).keys() == {"west"}
    assert lost_time(hand_made_scenario(), RunRecords()) == {}


def test_without_odometry_nothing_is_known() -> None:
    """Where an agent did its steps must be."""
    records = hand_made_records()
    records.odometry = [own for own in records.odometry if own.agent == "west"]
    assert lost_time(hand_made_scenario(), records).keys() == {"west"}


@pytest.mark.parametrize(("there_s", "is_known"), [(OPENED_S - 5.0, False), (OPENED_S + 5.0, True)])
def test_the_way_is_one_that_was_open_in_between(there_s: float, is_known: bool) -> None:
    """From one room, shut by then, to the other: known once the way there has been opened."""
    visited, here_s = TaskEventKind.REGION_VISITED, SHUT_S + 1.0
    records = RunRecords(
        tasks=[task(time_s, "one", visited) for time_s in (here_s, there_s)],
        odometry=[
            Odometry(nanoseconds(time_s), "one", Pose(x_m, 1.25, 0.0), 0.0, 0.0)
            for time_s, x_m in ((0.0, 2.75), (here_s, 0.75), (there_s, 7.25))
        ],
    )
    assert ("one" in lost_time(gate(), records)) is is_known
