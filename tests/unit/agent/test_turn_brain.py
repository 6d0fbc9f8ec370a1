"""A team of the hall that takes turns."""

from collections import defaultdict
from itertools import groupby

import pytest

from support.hall import LoneAgent, hall
from tlcomm_core.agent.actions import Fault, TaskEvent, TaskEventKind
from tlcomm_core.agent.controller import Pacing
from tlcomm_core.agent.member import create
from tlcomm_core.agent.turn_brain import TurnBrain
from tlcomm_core.errors import PlanningError
from tlcomm_core.method import Method
from tlcomm_core.mission import Mission
from tlcomm_core.records import RunRecords
from tlcomm_core.scenario.model import Change, DriveOverride, Faults
from tlcomm_core.scenario.site import Site
from tlcomm_core.simulation import simulate
from tlcomm_core.units import seconds
from tlcomm_core.workspace.atlas import Atlas

WINDOWS = 6
STEPS = (TaskEventKind.ACTION_FINISHED, TaskEventKind.REGION_VISITED)


def run(site: Site, windows: int = WINDOWS, seed: int = 0) -> RunRecords:
    """Return what a run by turns leaves."""
    return simulate(Mission(site, seed, windows, None, method=Method.ALL_TIME)).records


def events_of(records: RunRecords, *kinds: TaskEventKind) -> list[tuple[str, TaskEvent]]:
    """Return the events of some kinds with who did it, in order."""
    return [(own.agent, own.event) for own in records.tasks if own.event.kind in kinds]


@pytest.fixture(scope="module")
def records() -> RunRecords:
    """Return what three agents leave."""
    return run(hall(3))


def test_turns_go_round(records: RunRecords) -> None:
    """By name, each with the steps of its agent up to its next action: a visit and an action."""
    turns = [(own.round, name) for name, own in events_of(records, *STEPS)]
    by_turn = [(turn, [name for _, name in own]) for turn, own in groupby(turns, lambda t: t[0])]
    names = ("one", "three", "two")
    assert [turn for turn, _ in by_turn] == list(range(by_turn[0][0], by_turn[-1][0] + 1))
    # The run may end in the last one.
    for turn, acting in by_turn[:-1]:
        assert acting == [names[(turn - 1) % 3]] * 2


def test_tasks_progress(records: RunRecords) -> None:
    """Everybody's, equally often."""
    satisfied = [name for name, _ in events_of(records, TaskEventKind.TASK_SATISFIED)]
    counts = {name: satisfied.count(name) for name in ("one", "two", "three")}
    assert min(counts.values()) >= 2
    assert max(counts.values()) - min(counts.values()) <= 1


def test_all_arrive_together_as_foreseen(records: RunRecords) -> None:
    """But for the leader, which acts first and comes when it has."""
    reached: dict[int, dict[str, float]] = defaultdict(dict)
    for own in records.tasks:
        if own.event.kind is TaskEventKind.MEETING_REACHED:
            reached[own.event.round][own.agent] = seconds(own.stamp_ns)
    for record in records.strategies:
        arrivals_s = reached.get(record.strategy.round, {})
        for own in record.strategy.strategies:
            if own.agent in arrivals_s:
                assert arrivals_s[own.agent] == pytest.approx(own.arrival_s, abs=1e-6)
        *followers_s, _ = sorted(own.arrival_s for own in record.strategy.strategies)
        assert len(set(followers_s)) == 1


def test_the_team_is_as_slow_as_its_slowest() -> None:
    """Nobody drives faster than all can, nor turns."""
    scenario = hall(3).scenario
    slow = {"one": DriveOverride(linear_mps=0.4), "two": DriveOverride(angular_radps=0.7)}
    agents = {
        name: agent.model_copy(update={"motion": slow.get(name, DriveOverride())})
        for name, agent in scenario.agents.items()
    }
    site = Site.from_scenario(scenario.model_copy(update={"agents": agents}))
    odometry = run(site, 2).odometry
    assert max(abs(seen.linear_mps) for seen in odometry) == 0.4
    assert max(abs(seen.angular_radps) for seen in odometry) == 0.7


def test_a_failed_action_is_begun_anew_in_the_same_turn() -> None:
    """As often as the scenario allows; then the next has its turn, and it goes on in its own."""
    records = run(hall(2, Faults(action_failure=0.6, retries=1)), 12, seed=1)
    kinds = (TaskEventKind.FAULT, TaskEventKind.ACTION_FINISHED)
    failed, done = defaultdict[int, int](int), set()
    for _, own in events_of(records, *kinds):
        if own.kind is TaskEventKind.FAULT:
            assert own.detail.startswith(f"{Fault.FAILED}=")
            failed[own.round] += 1
        else:
            done.add(own.round)
    assert max(failed.values()) == 2
    assert {turn for turn, times in failed.items() if times == 1} <= done
    assert {turn for turn, times in failed.items() if times == 2}.isdisjoint(done)
    assert all(seen.connected for seen in records.connectivity)


def test_where_the_map_closes_a_leaders_way_the_next_one_leads() -> None:
    """Nobody can get to one end of the hall any more: what is at the other end is still done."""
    scenario = hall(2).scenario
    closed = Change(at_s=40.0, obstacles_m=((1.5, 0.0, 2.0, 2.0),))
    opened = Change(at_s=70.0, obstacles_m=())
    workspace = scenario.workspace.model_copy(update={"changes": (closed, opened)})
    records = run(Site.from_scenario(scenario.model_copy(update={"workspace": workspace})), 5)
    assert all(seen.connected for seen in records.connectivity)
    last_s = max(
        seconds(own.stamp_ns)
        for own in records.tasks
        if own.event.kind is TaskEventKind.TASK_SATISFIED
    )
    assert last_s > 100.0


def test_a_member_is_told_whether_its_team_can_begin() -> None:
    """Before anything runs; another method doesn't mind."""
    scenario = hall(2).scenario
    communication = scenario.communication.model_copy(update={"range_m": 0.51})
    site = Site.from_scenario(scenario.model_copy(update={"communication": communication}))
    with pytest.raises(PlanningError, match=r"agents\.two\.start: no ways within"):
        create("one", site, Pacing.EVENT, Atlas(site.grid), method=Method.ALL_TIME)
    create("one", site, Pacing.EVENT, Atlas(site.grid))


def test_another_task_begins_at_the_next_turn() -> None:
    """Asked for on the way, it is planned from where the team is going."""
    agent = LoneAgent("one", 1, method=Method.ALL_TIME)
    assert isinstance(agent.brain, TurnBrain)
    agent.act()
    agent.advance_to(1.0)
    agent.change_task("G F (b & place)")
    agent.advance_to(60.0)
    changed = [own.round for _, own in agent.events if own.kind is TaskEventKind.TASK_CHANGED]
    assert changed == [1]
    assert {own.region for _, own in agent.events if own.round > 1 and own.action} == {"b"}
