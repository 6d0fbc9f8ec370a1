"""Tests of ``tlcomm_core.metrics`` on a run made by hand."""

import json
from dataclasses import replace

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
from tlcomm_core.metrics import RunFacts, connected_intervals, patience_s, result_document
from tlcomm_core.records import RunRecords
from tlcomm_core.world.observation import Connectivity

FACTS = RunFacts("team", "best-response", 3, "lockstep", END_S, 5.0)


def document(records: RunRecords, facts: RunFacts = FACTS) -> dict:
    """Return the result document of the hand-made scenario."""
    return result_document(hand_made_scenario(), records, facts)


def test_a_good_run_has_verdict_ok() -> None:
    """Windows kept, tasks satisfied and agreement give the verdict "ok"."""
    assert document(hand_made_records())["verdict"] == "ok"


def test_the_facts_are_in_the_document() -> None:
    """What the records don't say is from the facts; the factor is simulated per wall time."""
    result = document(hand_made_records())
    wanted = {
        "format": "tlcomm-result/1",
        "scenario": "line",
        "method": "team",
        "solver": "best-response",
        "seed": 3,
        "pace": "lockstep",
        "sim_s": 25.0,
        "wall_s": 5.0,
        "realtime_factor": 5.0,
    }
    assert {key: result[key] for key in wanted} == wanted


def test_unknown_wall_time_is_null() -> None:
    """Without a wall time neither it nor the real-time factor is available."""
    result = document(hand_made_records(), replace(FACTS, wall_s=None))
    assert (result["wall_s"], result["realtime_factor"]) == (None, None)


def test_windows_are_counted_with_the_one_satisfied_early() -> None:
    """A window counts once D_c was seen in it, though it isn't over."""
    links = document(hand_made_records())["communication"]
    assert links == {"windows": 3, "satisfied": 3, "missed": 0, "missed_rounds": []}


def test_a_missed_window_is_named() -> None:
    """A window without D_c of connection is in the list and in the verdict."""
    records = hand_made_records()
    records.connectivity = [
        Connectivity(0, ((0, 1),), True),
        Connectivity(3_000_000_000, (), False),
    ]
    result = document(records)
    assert result["communication"] == {
        "windows": 2,
        "satisfied": 1,
        "missed": 1,
        "missed_rounds": [1],
    }
    assert result["verdict"] == ["window 1 missed: connected for 0.000 s at most, not 2 s"]


def test_rounds_are_those_that_took_place() -> None:
    """Round 3 is agreed on, but its meeting is still to come."""
    assert [own["round"] for own in document(hand_made_records())["rounds"]] == [1, 2]


def test_a_round_holds_the_papers_quantities() -> None:
    """Φ is the agreed one, additional time is the planned detour and the realised wait."""
    own = document(hand_made_records())["rounds"][0]
    assert own["window"] == [10.0, 20.0]
    assert (own["t_c"], own["planned_t_c"], own["iterations"]) == (10.0, 10.0, 1)
    assert own["potential"] == pytest.approx(1.0 + (10.0 - 8.0) + (10.0 - 7.0))
    assert own["initial_potential"] == pytest.approx(own["potential"] + 1.0)
    # 0.5 s of detour each; east is there at 8 s, west at 7 s.
    assert own["additional_time"] == pytest.approx({"east": 2.5, "west": 3.5})
    assert sum(own["additional_time"].values()) == pytest.approx(own["potential"])


def test_a_late_arrival_moves_the_realised_meeting() -> None:
    """t_c is the last arrival when that is after the window's opening."""
    records = hand_made_records()
    records.tasks = [
        task(11.0, "east", TaskEventKind.MEETING_REACHED, round_=1)
        if own.agent == "east"
        and own.event.kind is TaskEventKind.MEETING_REACHED
        and own.event.round == 1
        else own
        for own in records.tasks
    ]
    own = document(records)["rounds"][0]
    assert own["t_c"] == 11.0
    assert own["additional_time"] == pytest.approx({"east": 0.5, "west": 4.5})


def test_a_meeting_that_failed_is_null() -> None:
    """A round whose window went by without all agents has neither t_c nor additional times."""
    records = hand_made_records()
    records.tasks = [
        own
        for own in records.tasks
        if not (own.agent == "east" and own.event.kind is TaskEventKind.MEETING_REACHED)
    ]
    own = document(records)["rounds"][0]
    assert (own["t_c"], own["additional_time"]) == (None, {"east": None, "west": None})


def test_coordination_begins_when_the_team_is_complete() -> None:
    """Coordination is from the last first offer to the last agreement; computing is the worst."""
    own = document(hand_made_records())["rounds"][0]
    assert own["coordination_wall_s"] == pytest.approx(0.25)
    assert own["solve_wall_s"] == 0.02


def test_coordination_needs_everybodys_timing() -> None:
    """Without one agent's timing there is no coordination time, and without any no computing."""
    records = hand_made_records()
    records.timings = [own for own in records.timings if own.agent == "east"]
    assert document(records)["rounds"][0]["coordination_wall_s"] is None
    records.timings = []
    assert document(records)["rounds"][0]["solve_wall_s"] is None


def test_an_agents_figures() -> None:
    """Satisfactions, the longest time between two, the distance driven and messages sent."""
    agents = document(hand_made_records())["agents"]
    assert agents["east"] == {
        "tasks_satisfied": 2,
        "makespan_s": pytest.approx(10.0),
        "distance_m": pytest.approx(10.0),
        "messages_sent": MESSAGES["east"],
        "bytes_sent": BYTES["east"],
        "messages_undelivered": {"lost": 2, "out of range": 5},
    }
    assert agents["west"]["messages_undelivered"] == {}
    assert agents["west"]["distance_m"] == pytest.approx(8.0)


def test_what_nobody_counted_is_unknown() -> None:
    """Records without counts of messages give null, not 0."""
    records = hand_made_records()
    records.messages_sent.clear()
    records.bytes_sent.clear()
    records.messages_undelivered.clear()
    own = document(records)["agents"]["west"]
    assert (own["messages_sent"], own["bytes_sent"], own["messages_undelivered"]) == (None,) * 3


def test_one_satisfaction_has_no_makespan() -> None:
    """A makespan needs two satisfactions; null otherwise."""
    records = hand_made_records()
    records.tasks = [own for own in records.tasks if own.stamp_ns < 10_000_000_000]
    assert document(records)["agents"]["west"]["makespan_s"] is None


def test_a_starving_task_fails() -> None:
    """A task that isn't satisfied for longer than its patience is in the verdict."""
    records = hand_made_records()
    records.tasks = [
        own
        for own in records.tasks
        if own.agent == "east" or own.event.kind is not TaskEventKind.TASK_SATISFIED
    ]
    records.connectivity = [Connectivity(0, ((0, 1),), True)]
    facts = replace(FACTS, sim_s=31.0)
    assert patience_s(hand_made_scenario(), "west") == 30.0
    assert document(records, facts)["verdict"] == [
        "west: task not satisfied from 0.000 s to 31.000 s"
    ]


def test_different_strategies_fail() -> None:
    """Two agents with different strategies for a round are a disagreement."""
    records = hand_made_records()
    first = records.strategies[0]
    records.strategies[0] = replace(first, strategy=replace(first.strategy, iteration=9))
    assert document(records)["verdict"] == ["round 1: agents hold different strategies"]


def test_a_missing_strategy_fails() -> None:
    """A round before the last one that an agent holds no strategy for is named with the agent."""
    records = hand_made_records()
    records.strategies = [
        own for own in records.strategies if (own.agent, own.strategy.round) != ("west", 2)
    ]
    assert document(records)["verdict"] == ["round 2: not held by west"]


def test_who_says_that_it_is_in_doubt_needs_no_strategy() -> None:
    """An agent that left without the others' confirmations of that very round holds nothing, which
    fails nothing.
    """
    for round_, verdict in ((1, "ok"), (0, ["round 2: not held by west"])):
        records = hand_made_records()
        records.strategies = [
            own for own in records.strategies if (own.agent, own.strategy.round) != ("west", 2)
        ]
        detail = f"agreement=doubtful round={round_ + 1}"
        doubt = task(13.0, "west", TaskEventKind.FAULT, round_=round_, detail=detail)
        records.tasks = sorted([*records.tasks, doubt], key=lambda own: own.stamp_ns)
        assert document(records)["verdict"] == verdict


def test_faults_and_failures_come_up() -> None:
    """What broke the run and what an agent reports as a fault are in the verdict."""
    records = hand_made_records()
    records.tasks.append(task(25.0, "east", TaskEventKind.FAULT, detail="lost"))
    facts = replace(FACTS, failures=("west: killed by SIGKILL",))
    assert document(records, facts)["verdict"] == [
        "west: killed by SIGKILL",
        "east: fault at 25.000 s: lost",
    ]


def test_what_agents_cope_with_is_no_failure() -> None:
    """It isn't in the verdict, and each failed attempt leaves the task a window more."""
    records = hand_made_records()
    records.connectivity = [Connectivity(0, ((0, 1),), True)]
    done = [own for own in records.tasks if own.event.kind is not TaskEventKind.TASK_SATISFIED]
    failed = task(5.0, "west", TaskEventKind.FAULT, action="pick", detail="action=pick attempt=1")
    pushed = task(6.0, "west", TaskEventKind.FAULT, detail="displaced_m=0.700")
    records.tasks = [own for own in done if own.agent == "west"] + [failed, pushed]
    period_s = hand_made_scenario().communication.period_s

    def complaints(sim_s: float) -> list[str]:
        verdict = document(records, replace(FACTS, sim_s=sim_s))["verdict"]
        return [line for line in verdict if line.startswith("west: ")]

    assert complaints(30.0 + period_s) == []
    assert len(complaints(31.0 + period_s)) == 1


def test_no_records_at_all_are_a_document() -> None:
    """A run that recorded nothing still has a result, in valid JSON."""
    facts = replace(FACTS, sim_s=0.0, failures=("sim: died",))
    result = document(RunRecords(), facts)
    assert result["verdict"] == ["sim: died"]
    assert result["agents"]["east"]["messages_sent"] is None
    assert json.loads(json.dumps(result, allow_nan=False)) == result


def test_the_last_connection_lasts_to_the_end() -> None:
    """Repeated states don't split an interval, and the last one holds until the end."""
    seen = [
        Connectivity(0, (), False),
        Connectivity(10, ((0, 1),), True),
        Connectivity(20, ((0, 1),), True),
        Connectivity(30, (), False),
        Connectivity(40, ((0, 1),), True),
    ]
    assert connected_intervals(seen, 70) == [(10, 30), (40, 70)]
