"""Tests of ``tlcomm_core.result`` on a run made by hand."""

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
from tlcomm_core.method import Method
from tlcomm_core.metrics.run import run_metrics
from tlcomm_core.records import RunRecords
from tlcomm_core.result import RunFacts, result_document
from tlcomm_core.units import nanoseconds
from tlcomm_core.world.observation import Connectivity

FACTS = RunFacts(Method.TEAM, "best-response", 3, "lockstep", END_S, 5.0)


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
    assert own["members"] == ["east", "west"]
    assert own["detour"] == pytest.approx({"east": 0.5, "west": 0.5})
    assert own["wait"] == pytest.approx({"east": 2.0, "west": 3.0})
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
    nobodys = {"east": None, "west": None}
    assert (own["t_c"], own["wait"], own["additional_time"]) == (None, nobodys, nobodys)


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


def test_no_records_at_all_are_a_document() -> None:
    """A run that recorded nothing still has a result, in valid JSON."""
    facts = replace(FACTS, sim_s=0.0, failures=("sim: died",))
    result = document(RunRecords(), facts)
    assert result["verdict"] == ["sim: died"]
    assert result["agents"]["east"]["messages_sent"] is None
    assert json.loads(json.dumps(result, allow_nan=False)) == result


def test_the_metrics_are_in_the_document() -> None:
    """All of them, as ``metrics.run`` gives them; the agents' figures are among them."""
    records = hand_made_records()
    result = document(records)
    end_ns = nanoseconds(END_S)
    assert (
        result["metrics"]
        == run_metrics(hand_made_scenario(), records, Method.TEAM, end_ns).document()
    )
    assert (
        result["metrics"]["agents"]["west"]["distance_m"] == result["agents"]["west"]["distance_m"]
    )


def test_turns_are_no_rounds() -> None:
    """A method without meetings has no rounds, but windows."""
    result = document(hand_made_records(), replace(FACTS, method=Method.ALL_TIME))
    assert result["rounds"] == []
    assert result["communication"]["satisfied"] == 3


def test_a_round_counts_once_it_has_begun() -> None:
    """All were there at 8 s, but the run was over before the window opened."""
    assert document(hand_made_records(), replace(FACTS, sim_s=9.0))["rounds"] == []
