"""Tests of ``tlcomm_core.metrics.run``: what becomes of the single figures."""

import json
from dataclasses import asdict, fields, replace

import pytest

from support.hand_made_run import (
    BYTES,
    END_S,
    MESSAGES,
    hand_made_records,
    hand_made_scenario,
    task,
)
from tlcomm_core.agent.actions import TaskEventKind
from tlcomm_core.game.strategy import Strategy, TeamStrategy
from tlcomm_core.method import Method
from tlcomm_core.metrics.run import run_metrics
from tlcomm_core.metrics.summary import AgentMetrics, RunMetrics, TeamMetrics
from tlcomm_core.records import EstimateRecord, RunRecords, StrategyRecord
from tlcomm_core.scenario.model import MeasuredField
from tlcomm_core.units import nanoseconds


def metrics(records: RunRecords, method: Method = Method.TEAM, end_s: float = END_S) -> RunMetrics:
    """Return the figures of the hand-made scenario."""
    return run_metrics(hand_made_scenario(), records, method, nanoseconds(end_s))


def test_an_agents_figures() -> None:
    """Those of east: 10 s from one satisfaction to the next, and twice 0.5 s of detour and 2 s of
    waiting; links are down from 2 s to 8 s and from 12 s to 18 s.
    """
    east = metrics(hand_made_records()).agents["east"]
    expected = {
        "tasks_satisfied": 2,
        "tasks_per_hour": 2 * 3600.0 / 25.0,
        "makespan_s": 10.0,
        "mean_cycle_s": 10.0,
        "meetings": 2,
        "detour_s": 0.5,
        "wait_s": 2.0,
        "additional_s": 2.5,
        "additional_with_duration_s": 4.5,
        "own_work_s": 4.5,
        "lost_s": 11.0,
        "lost_per_window_s": 9.0,
        "lost_per_meeting_s": 9.0,
        "information_age_mean_s": 2 * (0.5 * 6.0 * 6.0) / 25.0,
        "information_age_max_s": 6.0,
        "deviation_mean": None,
        "deviation_max": None,
        "deviation_settled_max": None,
        "distance_m": 10.0,
        "messages": MESSAGES["east"],
        "bytes": BYTES["east"],
    }
    assert asdict(east) == {
        name: value if value is None else pytest.approx(value) for name, value in expected.items()
    }


def test_the_teams_figures() -> None:
    """Sums of what adds up, means of what doesn't; west waits for 3 s each time."""
    found = metrics(hand_made_records())
    team, agents = found.team, found.agents
    assert (team.tasks_satisfied, team.makespan_sum_s, team.makespan_max_s) == (4, 20.0, 10.0)
    assert (team.windows, team.windows_kept, team.windows_missed) == (3, 3, 0)
    assert (team.meetings, team.team_meetings, team.pair_meetings) == (2, 2, 0)
    assert (team.wait_s, team.additional_s) == (2.5, 3.0)
    assert team.additional_with_duration_s == 5.0
    assert team.distance_m == pytest.approx(18.0)
    assert team.messages == sum(MESSAGES.values())
    assert team.lost_s == pytest.approx(agents["east"].lost_s + agents["west"].lost_s)
    assert team.lost_per_window_s == pytest.approx(9.0)


def test_computing_is_the_mean_over_meetings() -> None:
    """Of three that were agreed on, though the last is still to come."""
    records = hand_made_records()
    records.timings = [
        replace(own, solve_wall_s=0.08) if own.round == 1 else own for own in records.timings
    ]
    computing = metrics(records).computing
    assert computing.solve_wall_s == pytest.approx((0.08 + 0.02 + 0.02) / 3.0)
    assert computing.coordination_wall_s == pytest.approx(0.25)


def test_what_one_agent_lacks_the_team_lacks() -> None:
    """A sum over agents without one of them would be another figure."""
    records = hand_made_records()
    satisfied, west = TaskEventKind.TASK_SATISFIED, "west"
    records.tasks = [
        own for own in records.tasks if (own.agent, own.event.kind) != (west, satisfied)
    ]
    del records.messages_sent[west]
    team = metrics(records).team
    assert team.tasks_satisfied == 2
    assert (team.makespan_sum_s, team.makespan_max_s, team.mean_cycle_s) == (None, None, None)
    assert (team.messages, team.bytes) == (None, sum(BYTES.values()))


def test_a_pairs_meeting_counts_for_its_members() -> None:
    """In a team of three, one attends none, and has no mean."""
    scenario = hand_made_scenario()
    middle = scenario.agents["east"].model_copy(update={"start": (4.25, 0.25, 0.0)})
    trio = scenario.model_copy(update={"agents": {**scenario.agents, "middle": middle}})
    pair = TeamStrategy(
        round=1,
        iteration=0,
        strategies=tuple(Strategy(name, 0.0, 0.0, 1, 9.0, 1.0) for name in ("east", "west")),
        communication_s=10.0,
        potential_s=0.0,
        initial_potential_s=0.0,
    )
    reached = TaskEventKind.MEETING_REACHED
    records = RunRecords(
        tasks=[task(9.0, name, reached, round_=1) for name in ("east", "west")],
        strategies=[StrategyRecord(1, "east", pair)],
    )
    found = run_metrics(trio, records, Method.PAIRWISE, nanoseconds(12.0))
    assert (found.team.meetings, found.team.team_meetings, found.team.pair_meetings) == (1, 0, 1)
    assert {name: own.meetings for name, own in found.agents.items()} == {
        "east": 1,
        "west": 1,
        "middle": 0,
    }
    assert found.agents["middle"].additional_s is None
    assert found.team.additional_s == pytest.approx(2.0)
    early = run_metrics(trio, records, Method.PAIRWISE, nanoseconds(9.5))
    assert early.team.meetings == 0


def test_turns_are_no_meetings() -> None:
    """What a method without meetings holds as strategies costs no additional time; finding them
    takes time, and waiting for others loses it.
    """
    found = metrics(hand_made_records(), Method.ALL_TIME)
    assert (found.team.meetings, found.team.additional_s) == (0, None)
    assert found.team.lost_per_window_s == pytest.approx(9.0)
    assert found.team.lost_per_meeting_s is None
    assert found.computing == metrics(hand_made_records()).computing


def test_estimates_are_compared_with_the_field() -> None:
    """Each agent's, and over agents and time; after the first one."""
    field = MeasuredField(action="pick", profile=((0.0, 4.0),))
    scenario = hand_made_scenario().model_copy(update={"field": field})
    records = hand_made_records()
    records.estimates = [
        EstimateRecord(nanoseconds(5.0), "east", 5.0, 5.0, has_measurement=True),
        EstimateRecord(nanoseconds(15.0), "west", 2.0, 2.0, has_measurement=True),
        EstimateRecord(nanoseconds(20.0), "west", 2.0, 2.0, has_measurement=True),
    ]
    found = run_metrics(scenario, records, Method.TEAM, nanoseconds(END_S))
    assert (found.agents["east"].deviation_mean, found.agents["west"].deviation_max) == (1.0, 2.0)
    assert found.team.deviation_mean == pytest.approx((20.0 * 1.0 + 10.0 * 2.0) / 30.0)
    assert found.team.deviation_max == 2.0
    records.estimates[-1] = replace(records.estimates[-1], value=4.5)
    found = run_metrics(scenario, records, Method.TEAM, nanoseconds(END_S))
    assert found.agents["west"].deviation_settled_max == 0.5
    assert (found.team.deviation_max, found.team.deviation_settled_max) == (2.0, 1.0)


def test_nothing_recorded_is_a_document() -> None:
    """With the same keys, null where nothing is known, in valid JSON."""
    document = metrics(RunRecords(), end_s=0.0).document()
    assert json.loads(json.dumps(document, allow_nan=False)) == document
    assert document["team"].keys() == {field.name for field in fields(TeamMetrics)}
    assert document["agents"]["east"].keys() == {field.name for field in fields(AgentMetrics)}
    assert document["team"]["lost_s"] is None
