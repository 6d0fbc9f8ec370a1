"""Tests of ``tlcomm_tools.mirror.diagnostics``."""

from dataclasses import replace
from typing import Any

from support.hand_made_run import hand_made_records, task
from support.mirroring import mirror_run
from tlcomm_core.agent.actions import TaskEventKind
from tlcomm_core.records import RunRecords
from tlcomm_core.units import nanoseconds
from tlcomm_core.world.observation import Connectivity
from tlcomm_tools.mirror.diagnostics import Level


def statuses(time_s: float, records: RunRecords | None = None) -> dict[str, Any]:
    """Return the statuses at a time, by name."""
    array = mirror_run(time_s, records)["/diagnostics", time_s]
    return {own.name.removeprefix("tlcomm: "): own for own in array.status}


def values(status: Any) -> dict[str, str]:  # noqa: ANN401 - a decoder's class
    """Return a status's figures."""
    return {pair.key: pair.value for pair in status.values}


def test_all_is_well_in_a_run_that_goes_well() -> None:
    """With links told of: planner, game, radio, window and both agents are OK."""
    records = hand_made_records()
    records.connectivity.append(Connectivity(nanoseconds(6.0), (), connected=False))
    records.odometry.sort(key=lambda own: own.stamp_ns)
    found = statuses(6.0, records)
    assert {name: own.level for name, own in found.items()} == dict.fromkeys(
        ("planner", "game", "radio", "window", "east", "west"), Level.OK
    )
    assert found["east"].hardware_id == "east"


def test_what_is_not_heard_of_is_stale() -> None:
    """Before the first agreement the game, and links long after the last word of them."""
    assert statuses(0.0)["game"].level == Level.STALE
    assert statuses(7.0)["radio"].level == Level.STALE
    records = RunRecords()
    assert {own.level for name, own in statuses(0.0, records).items() if name != "window"} == {
        Level.STALE
    }


def test_the_game_knows_whether_all_agree() -> None:
    """OK with Φ if all hold one strategy; WARN if one has none, ERROR if they differ."""
    assert values(statuses(1.0)["game"])["potential_s"] == "6.000"
    records = hand_made_records()
    first = records.strategies[0]
    records.strategies = records.strategies[1:]
    assert statuses(1.0, records)["game"].level == Level.WARN
    other = replace(first, strategy=replace(first.strategy, potential_s=99.0))
    records.strategies.insert(0, other)
    assert statuses(1.0, records)["game"].level == Level.ERROR


def test_a_fault_is_a_warning_for_a_while() -> None:
    """What was coped with warns, of the planner and its agent, and then no more."""
    records = hand_made_records()
    fault = task(2.0, "east", TaskEventKind.FAULT, detail="action=pick attempt=1")
    records.tasks.append(fault)
    found = statuses(3.0, records)
    assert (found["planner"].level, found["east"].level) == (Level.WARN, Level.WARN)
    assert found["planner"].message == "east: action=pick attempt=1"
    assert statuses(13.0, records)["planner"].level == Level.OK


def test_a_plan_that_is_not_there_is_an_error() -> None:
    """Who is blocked can't cope."""
    records = hand_made_records()
    records.tasks.append(task(2.0, "east", TaskEventKind.FAULT, detail="blocked=no way"))
    assert statuses(3.0, records)["planner"].level == Level.ERROR


def test_a_meeting_out_of_range_is_an_error() -> None:
    """All have reached their places, and the team isn't connected."""
    records = hand_made_records()
    records.connectivity = [Connectivity(nanoseconds(9.0), (), connected=False)]
    assert statuses(9.0, records)["radio"].level == Level.ERROR


def test_slack_counts_from_the_agreed_meeting() -> None:
    """While that is to come; once it should have begun, from now."""
    records = hand_made_records()
    for number, held in enumerate(records.strategies):
        late = replace(held.strategy, communication_s=14.0)
        if late.round == 1:
            records.strategies[number] = replace(held, strategy=late)
    assert values(statuses(10.0, records)["window"])["slack_s"] == "6.000"
    assert values(statuses(15.0, hand_made_records())["window"])["slack_s"] == "5.000"


def test_slack_runs_out_as_the_window_does() -> None:
    """A window that is over without a meeting is an error; one that was kept isn't."""
    records = hand_made_records()
    records.connectivity = [Connectivity(nanoseconds(0.0), (), connected=False)]
    assert values(statuses(4.0, records)["window"])["slack_s"] == "6.000"
    assert values(statuses(10.0, records)["window"])["slack_s"] == "10.000"
    missed = statuses(10.0, records)["window"]
    assert (missed.level, values(missed)["missed"]) == (Level.ERROR, "1")
    assert statuses(9.0, records)["window"].level == Level.OK
    assert values(statuses(3.0)["window"])["kept"] == "1"
