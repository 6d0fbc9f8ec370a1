"""An agent by itself: its plan and nothing else."""

import math

import pytest

from support.hall import LoneAgent
from tlcomm_core.agent.actions import SendMessage, TaskEventKind
from tlcomm_core.agent.events import TimePassed
from tlcomm_core.agent.lone_brain import LoneBrain
from tlcomm_core.method import Method


def by_itself() -> LoneAgent:
    """Return an agent of the hall that meets nobody, setting out."""
    agent = LoneAgent("one", 2, method=Method.NONE)
    agent.act()
    return agent


def test_it_is_as_quick_as_its_plan() -> None:
    """Each pass takes what the plan's suffix takes, and nobody is told anything."""
    agent = by_itself()
    agent.advance_to(300.0)
    assert isinstance(agent.brain, LoneBrain)
    plan = agent.brain._settings.plan
    satisfied_s = agent.times_s(TaskEventKind.TASK_SATISFIED)
    expected_s = [plan.first_s + k * plan.suffix_s for k in range(len(satisfied_s))]
    assert satisfied_s == pytest.approx(expected_s)
    assert len(satisfied_s) >= 300.0 // plan.suffix_s
    assert not any(isinstance(action, SendMessage) for _, action in agent.done)


def test_another_task_begins_at_once() -> None:
    """From where it is, in the middle of a way; the old one isn't satisfied any more."""
    agent = by_itself()
    agent.advance_to(1.0)
    plan = agent.change_task("G F (b & place)")
    agent.act()
    agent.advance_to(60.0)
    assert agent.times_s(TaskEventKind.TASK_CHANGED) == [1.0]
    assert {event.region for _, event in agent.events if event.action} == {"b"}
    assert {step.region for step in plan.suffix} == {"b"}


def test_where_the_map_closes_its_plan_it_waits() -> None:
    """It says so once, and goes on when the way is open again."""
    agent = by_itself()
    agent.advance_to(1.0)
    agent.show_map((1.5, 0.0, 2.0, 2.0), (4.0, 0.0, 4.5, 2.0))
    agent.advance_to(61.0)
    assert agent.brain.next_need_s == math.inf
    agent.act()
    agent.show_map()
    agent.advance_to(121.0)
    faults = [event for _, event in agent.events if event.kind is TaskEventKind.FAULT]
    assert [event.detail.partition("=")[0] for event in faults] == ["blocked"]
    assert agent.times_s(TaskEventKind.PLAN_CHANGED) == [61.0]
    assert agent.times_s(TaskEventKind.TASK_SATISFIED)[0] > 61.0


def test_before_its_first_odometry_it_needs_nothing() -> None:
    """It can't know where it is."""
    brain = LoneBrain(by_itself().brain._settings)
    assert brain.next_start is None
    assert brain.next_need_s == math.inf
    assert brain.handle(TimePassed(), 0.0) == ()
