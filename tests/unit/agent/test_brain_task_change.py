"""Another task for an agent on its way."""

import pytest

from support.hall import PERIOD_S, exchange, of_kind, two_agents, under_way
from tlcomm_core.agent.actions import TaskEventKind
from tlcomm_core.errors import InputError, PlanningError
from tlcomm_core.geometry import wrap_angle

_, FINISHED, REACHED, BEGUN, _, SATISFIED, _, _, VISITED, CHANGED, *_ = TaskEventKind


OTHER_TASK = "G F (b & pick)"


@pytest.mark.parametrize("time_s", [0.0, 5.0, 10.0, 14.2, 28.0])
def test_another_task_begins_at_the_next_meeting(time_s: float) -> None:
    """Until then all is as agreed; from then on, and in what is offered there, it is the other."""
    agent = under_way(time_s)
    old = under_way(10 * PERIOD_S).events
    plan = agent.change_task(OTHER_TASK)
    agent.advance_to(10 * PERIOD_S)
    ((changed_s, change),) = [(t, event) for t, event in agent.events if event.kind is CHANGED]
    assert change.detail == f"task={OTHER_TASK}"
    assert changed_s == next(t for t in agent.times_s(REACHED) if t > time_s)
    assert [e for t, e in agent.events if t < changed_s] == [e for t, e in old if t < changed_s]
    later = [e for t, e in agent.events if t > changed_s]
    steps = of_kind(later, FINISHED, VISITED)
    assert [event.plan_index for event in steps] == list(range(len(steps)))
    expected = [plan.step(index) for index in range(len(steps))]
    assert [(e.region, e.action) for e in steps] == [(s.region, s.action or "") for s in expected]
    assert len(of_kind(later, SATISFIED)) > 5
    assert len(agent.times_s(BEGUN)) == len([t for t, e in old if e.kind is BEGUN])


def test_the_last_of_several_tasks_counts() -> None:
    """What nobody has begun is forgotten."""
    agent = under_way()
    agent.change_task(OTHER_TASK)
    agent.change_task("G F a")
    agent.advance_to(2 * PERIOD_S)
    changes = [event.detail for _, event in agent.events if event.kind is CHANGED]
    assert changes == ["task=G F a"]


@pytest.mark.parametrize(
    ("task", "error", "reason"),
    [
        ("G F (b &", InputError, "task: .*column 9"),
        ("G F (b & sing)", InputError, "task: unknown region or action 'sing'"),
        ("F b & G !b", PlanningError, "contradict"),
        ("G F (a & b)", PlanningError, "can't be done"),
        ("G F (a & pick) & G !b", PlanningError, "forbids region 'b' always"),
    ],
)
def test_without_a_plan_the_old_task_goes_on(
    task: str, error: type[Exception], reason: str
) -> None:
    """The reason is one line; nothing else is different from not having asked."""
    agent, other = under_way(), under_way()
    with pytest.raises(error, match=reason) as caught:
        agent.change_task(task)
    assert "\n" not in str(caught.value)
    agent.advance_to(3 * PERIOD_S)
    other.advance_to(3 * PERIOD_S)
    assert agent.done == other.done


def test_no_task_is_changed_before_an_agreement() -> None:
    """Where another plan would begin isn't known then; as soon as it is, it can be asked for."""
    one, two = two_agents()
    with pytest.raises(PlanningError, match="isn't agreed on yet"):
        one.change_task(OTHER_TASK)
    exchange(one, two, 0.0)
    one.change_task(OTHER_TASK)
    fresh = type(one.brain)(one.brain._settings)
    assert fresh.next_start is None


@pytest.mark.parametrize("time_s", [0.0, 4.0, 14.2, 28.0])
def test_another_plan_starts_where_the_meeting_is(time_s: float) -> None:
    """As the agent will stand there, yaw included."""
    agent = under_way(time_s)
    start = agent.brain.next_start
    assert start is not None
    agent.advance_to(next(t for t in under_way(100.0).times_s(REACHED) if t > time_s))
    assert agent.pose.distance_m(start.x_m, start.y_m) < 1e-6
    assert wrap_angle(agent.pose.yaw_rad - start.yaw_rad) == pytest.approx(0.0, abs=1e-6)
