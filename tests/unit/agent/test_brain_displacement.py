"""An agent put elsewhere on its way."""

from support.hall import DURATION_S, PERIOD_S, of_kind, under_way
from tlcomm_core.agent.actions import TaskEventKind
from tlcomm_core.geometry import Pose

_, FINISHED, REACHED, BEGUN, _, _, _, FAULT, VISITED, *_ = TaskEventKind


def test_displaced_it_goes_on_from_where_it_is() -> None:
    """It says by how much, drives to the same target by a way of its own, and loses no step."""
    agent = under_way(DURATION_S + 3.0)
    assert agent.velocity.linear_mps > 0.0
    place = Pose(agent.pose.x_m, agent.pose.y_m + 0.9, 2.0)
    agent.put(place)
    agent.act()
    agent.advance_to(10 * PERIOD_S)
    ((fault_s, fault),) = [(t, event) for t, event in agent.events if event.kind is FAULT]
    assert fault_s < DURATION_S + 3.6
    assert fault.detail == "displaced_m=0.900"
    assert fault.is_coped_with
    assert not fault.is_failed_attempt
    events = of_kind([event for _, event in agent.events], FINISHED, VISITED)
    assert [event.plan_index for event in events] == list(range(len(events)))
    assert len(agent.times_s(BEGUN)) == 10


def test_what_a_controller_is_off_by_is_no_displacement() -> None:
    """Up to a cell."""
    agent = under_way(DURATION_S + 3.0)
    assert agent.velocity.linear_mps > 0.0
    agent.put(Pose(agent.pose.x_m, agent.pose.y_m + 0.49, agent.pose.yaw_rad))
    agent.advance_to(3 * PERIOD_S)
    assert agent.times_s(FAULT) == []


def test_displaced_it_gives_up_a_step_for_the_meeting() -> None:
    """Carried far away, it goes to meet without having done what it has no time for any more."""
    agent, other = under_way(DURATION_S), under_way(2 * PERIOD_S)
    (strategy,) = other.held[0].strategy.strategies
    away = Pose(0.25, 1.75, 0.0)
    while agent.now_s < strategy.arrival_s - 3.0:
        agent.advance_to(agent.now_s + 0.5)
        if agent.velocity.linear_mps > 0.0:
            agent.put(away)
            agent.act()
    agent.advance_to(2 * PERIOD_S)
    reached_s, event = [(t, e) for t, e in agent.events if e.kind is REACHED][1]
    assert event.plan_index < strategy.task_index
    assert reached_s < other.times_s(BEGUN)[1] + 6.0


def test_put_where_no_way_begins_it_keeps_to_its_leg() -> None:
    """Outside the workspace nothing can be planned; the vehicle is driven back by the old leg."""
    agent = under_way(DURATION_S + 3.0)
    agent.put(Pose(agent.pose.x_m, -0.1, agent.pose.yaw_rad))
    agent.act()
    assert agent.times_s(FAULT) == []
    agent.advance_to(10 * PERIOD_S)
    assert len(agent.times_s(BEGUN)) == 10
