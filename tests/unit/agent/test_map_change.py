"""A map that changes while an agent is under way, acts or meets."""

import numpy as np
import pytest

from support.hall import DURATION_S, PERIOD_S, LoneAgent, hall, of_kind, under_way
from tlcomm_core.agent.actions import TaskEvent, TaskEventKind
from tlcomm_core.protocol.messages import PlanOffer
from tlcomm_core.scenario.model import Region
from tlcomm_core.scenario.site import Site
from tlcomm_core.workspace.grid import Box

STARTED, FINISHED, REACHED, BEGUN, _, SATISFIED, _, FAULT, VISITED, _, PLANNED = TaskEventKind

# Across the whole hall, between where the agent starts and region a.
WALL = (1.0, 0.0, 1.5, 2.0)
# The same with a gap at the top.
GATE = (1.0, 0.0, 1.5, 1.5)
# On the other side, towards region b.
OTHER_GATE = (3.5, 0.0, 4.0, 1.5)
# The cell of region a's middle; in a region of 0.6 m those beside it stay free.
A_CELL = (0.5, 0.5, 1.0, 1.0)
# On its way to region a.
DRIVING_S = DURATION_S + 3.0
# It has begun to pick there.
ACTING_S = 9.0


def told(agent: LoneAgent, *kinds: TaskEventKind) -> list[TaskEvent]:
    """Return the events of some kinds."""
    return of_kind([event for _, event in agent.events], *kinds)


def offers(agent: LoneAgent) -> list[PlanOffer]:
    """Return what it has offered."""
    return [message for message in agent.sent if isinstance(message, PlanOffer)]


def is_clear_of(agent: LoneAgent, box: Box) -> bool:
    """Tell whether the agent is outside a box."""
    x_min, y_min, x_max, y_max = box
    return not (x_min < agent.pose.x_m < x_max and y_min < agent.pose.y_m < y_max)


def test_driving_it_takes_the_way_that_is_left() -> None:
    """It turns off at once, never touches what has closed, and loses no step and no meeting."""
    agent, other = under_way(DRIVING_S), under_way(10 * PERIOD_S)
    agent.show_map(GATE)
    while agent.now_s < 10 * PERIOD_S:
        agent.advance_to(agent.now_s + 0.25)
        assert is_clear_of(agent, GATE)
    assert agent.times_s(VISITED)[0] > other.times_s(VISITED)[0] + 1.0
    steps = told(agent, FINISHED, VISITED)
    assert [event.plan_index for event in steps] == list(range(len(steps)))
    assert len(agent.times_s(BEGUN)) == 10
    assert agent.times_s(FAULT) == []


@pytest.mark.parametrize("time_s", [DRIVING_S, ACTING_S])
def test_what_closes_elsewhere_changes_nothing_until_the_next_meeting(time_s: float) -> None:
    """Its ways being free as before, it keeps to them and to their times."""
    agent, other = under_way(time_s), under_way(2 * PERIOD_S)
    agent.show_map((0.0, 1.5, 0.5, 2.0))
    agent.advance_to(2 * PERIOD_S)
    until_s = other.times_s(REACHED)[1]
    expected = [(t, action) for t, action in other.done if t < until_s]
    assert [(t, action) for t, action in agent.done if t < until_s] == expected
    assert len(expected) > 30


def test_acting_it_takes_another_way_afterwards() -> None:
    """The action ends as it would have; the next leg leads through the gap."""
    agent, other = under_way(ACTING_S), under_way(2 * PERIOD_S)
    agent.show_map(OTHER_GATE)
    assert agent.times_s(STARTED) == other.times_s(STARTED)[:1]
    while agent.now_s < 5 * PERIOD_S:
        agent.advance_to(agent.now_s + 0.25)
        assert is_clear_of(agent, OTHER_GATE)
    assert agent.times_s(FINISHED)[0] == other.times_s(FINISHED)[0]
    at_b = [
        [t for t, e in own.events if e.kind is VISITED and e.region == "b"]
        for own in (agent, other)
    ]
    assert at_b[0][0] > at_b[1][0] + 1.0
    assert len(agent.times_s(BEGUN)) == 5


def test_a_region_out_of_reach_is_left_for_the_meeting() -> None:
    """At each meeting it says that there is no other plan, and when the way opens it goes on."""
    agent = under_way(DRIVING_S)
    agent.show_map(WALL)
    agent.advance_to(3 * PERIOD_S + 15.0)
    assert told(agent, FINISHED, VISITED) == []
    assert len(agent.times_s(BEGUN)) == 4
    cut_off, *blocked = told(agent, FAULT)
    assert cut_off.detail == "cut_off_m=1.000"
    assert len(blocked) == len(agent.times_s(REACHED)) - 1
    assert all("'a' can't be reached" in event.detail for event in blocked)
    assert all(event.is_coped_with for event in told(agent, FAULT))
    agent.show_map()
    agent.advance_to(8 * PERIOD_S)
    steps = told(agent, FINISHED, VISITED)
    assert [event.plan_index for event in steps] == list(range(len(steps)))
    assert len(agent.times_s(SATISFIED)) >= 3
    assert len(agent.times_s(BEGUN)) == 8
    assert told(agent, FAULT) == [cut_off, *blocked]


def test_where_another_cell_of_a_region_is_free_it_plans_anew() -> None:
    """From the next meeting on, with steps from 0 again, and the plan's old place isn't entered."""
    scenario = hall(1).scenario
    regions = {**scenario.workspace.regions, "a": Region(at_m=(0.75, 0.75), radius_m=0.6)}
    workspace = scenario.workspace.model_copy(update={"regions": regions})
    site = Site.from_scenario(scenario.model_copy(update={"workspace": workspace}))
    agent = LoneAgent("one", 1, site=site)
    agent.act()
    agent.advance_to(DRIVING_S)
    agent.show_map(A_CELL)
    while agent.now_s < 5 * PERIOD_S:
        agent.advance_to(agent.now_s + 0.25)
        assert is_clear_of(agent, A_CELL)
    (planned_s,) = agent.times_s(PLANNED)
    assert planned_s == agent.times_s(REACHED)[1]
    assert [event.detail for event in told(agent, FAULT)] == ["cut_off_m=0.500"]
    steps = [e for t, e in agent.events if t > planned_s and e.kind in {FINISHED, VISITED}]
    assert [event.plan_index for event in steps] == list(range(len(steps)))
    assert len(agent.times_s(SATISFIED)) >= 2
    assert len(agent.times_s(BEGUN)) == 5


def test_out_of_a_cell_that_closes_round_it_it_drives_on() -> None:
    """By the shortest way to a cell from where its target can be reached."""
    agent = under_way(DRIVING_S)
    x_m = agent.pose.x_m
    around = (1.5, 0.5, 2.0, 1.0)
    assert not is_clear_of(agent, around), x_m
    agent.show_map(around)
    agent.advance_to(DRIVING_S + 4.0)
    assert is_clear_of(agent, around)
    agent.advance_to(5 * PERIOD_S)
    assert told(agent, FAULT) == []
    assert len(agent.times_s(BEGUN)) == 5
    assert agent.times_s(SATISFIED)


def test_an_offer_says_with_which_map_it_was_made() -> None:
    """The latest that its maker had been shown before it arrived."""
    agent = under_way(0.0)
    agent.advance_to(DRIVING_S)
    agent.show_map(GATE)
    agent.advance_to(3 * PERIOD_S)
    made = [(message.round, message.offers[0].map_ns) for message in offers(agent)]
    assert {map_ns for round_, map_ns in made if round_ == 1} == {0}
    assert {map_ns for round_, map_ns in made if round_ == 2} == {round(DRIVING_S * 1e9)}


def test_a_map_that_isnt_later_changes_nothing() -> None:
    """Nor one of equal cells, but for what the agent's offers say."""
    agent, other = under_way(DRIVING_S), under_way(3 * PERIOD_S)
    shape = agent.brain.travel.grid.shape
    agent.member.see_map(0, np.zeros(shape, dtype=np.bool_))
    agent.show_map()
    agent.advance_to(3 * PERIOD_S)
    assert agent.events == other.events
