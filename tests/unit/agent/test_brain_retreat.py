"""An agent that something has put into a region that its task forbids."""

import math
from itertools import pairwise

import pytest

from support.hall import DURATION_S, PERIOD_S, LoneAgent, hall, of_kind
from tlcomm_core.agent.actions import TaskEventKind
from tlcomm_core.geometry import Pose
from tlcomm_core.scenario.loader import verify
from tlcomm_core.scenario.model import Region
from tlcomm_core.scenario.site import Site

PIT_M, RADIUS_M = (4.25, 1.5), 0.4
BESIDE = Pose(4.25, 0.75, -math.pi / 2.0)


def beside_the_pit(time_s: float) -> LoneAgent:
    """Return a team of one under way, whose task forbids a pit beside its way."""
    scenario = hall(1).scenario
    pit = Region(at_m=PIT_M, radius_m=RADIUS_M)
    regions = {**scenario.workspace.regions, "pit": pit}
    workspace = scenario.workspace.model_copy(update={"regions": regions})
    own = scenario.agents["one"]
    agents = {"one": own.model_copy(update={"task": f"G !pit & {own.task}"})}
    changed = scenario.model_copy(update={"workspace": workspace, "agents": agents})
    agent = LoneAgent("one", 1, site=Site.from_scenario(verify(changed)))
    agent.act()
    agent.advance_to(time_s)
    return agent


def in_the_pit() -> LoneAgent:
    """Return one that has been put into the pit, half a metre from its edge, and has seen it."""
    agent = beside_the_pit(DURATION_S + 3.0)
    assert agent.velocity.linear_mps > 0.0
    agent.put(Pose(4.25, 1.25, -math.pi / 2.0))
    agent.act()
    return agent


def test_it_leaves_by_the_fastest_way_and_goes_on() -> None:
    """It says by how much it was displaced, never comes back, and loses no step or meeting."""
    agent = in_the_pit()
    ((fault_s, fault),) = [(t, e) for t, e in agent.events if e.kind is TaskEventKind.FAULT]
    assert fault_s == agent.now_s
    assert fault.detail.startswith("displaced_m=")
    assert fault.is_coped_with
    agent.advance_to(fault_s + 0.5)
    assert agent.pose.distance_m(BESIDE.x_m, BESIDE.y_m) == pytest.approx(0.0, abs=1e-6)
    while agent.now_s < 10 * PERIOD_S:
        agent.advance_to(agent.now_s + 0.1)
        assert agent.pose.distance_m(*PIT_M) > RADIUS_M
    ends = (TaskEventKind.ACTION_FINISHED, TaskEventKind.REGION_VISITED)
    steps = of_kind([event for _, event in agent.events], *ends)
    assert [event.plan_index for event in steps] == list(range(len(steps)))
    assert len(steps) > 10
    assert len(agent.times_s(TaskEventKind.MEETING_STARTED)) == 10
    assert len(agent.times_s(TaskEventKind.FAULT)) == 1


def test_where_it_meets_is_known_meanwhile() -> None:
    """So another task can be given to it on its way out."""
    agent = in_the_pit()
    start = agent.brain.next_start
    assert start is not None
    agent.change_task("G !pit & G F (b & pick)")
    reached = len(agent.times_s(TaskEventKind.MEETING_REACHED))
    while len(agent.times_s(TaskEventKind.MEETING_REACHED)) == reached:
        agent.advance_to(agent.brain.next_need_s)
    assert agent.pose.distance_m(start.x_m, start.y_m) < 1e-6
    assert len(agent.times_s(TaskEventKind.TASK_CHANGED)) == 1


def test_the_way_out_counts() -> None:
    """It takes as long, out and onward, as is reckoned when time decides what comes next."""
    agent = in_the_pit()
    begun_s, began_m = agent.now_s, (agent.pose.x_m, agent.pose.y_m)
    leg = agent.brain._itinerary.leg(agent.pose, None)
    assert leg.distance_m == pytest.approx(
        sum(math.dist(*ends) for ends in pairwise([began_m, *leg.waypoints_m]))
    )
    agent.advance_to(2 * PERIOD_S)
    reached_s = min(t for t in agent.times_s(TaskEventKind.ACTION_STARTED) if t > begun_s)
    assert reached_s - begun_s == pytest.approx(leg.duration_s)
