"""Tests of ``tlcomm_tools.verification.findings``: fresh brains against what was recorded."""

import math
from dataclasses import replace
from pathlib import Path

import pytest

from support.gate import gate
from support.measuring_corridor import measuring_corridor
from support.recorded_simulation import record
from tlcomm_core.agent.actions import Drive, TaskEvent, TaskEventKind
from tlcomm_core.method import Method
from tlcomm_core.mission import Mission
from tlcomm_core.protocol.messages import PlanOffer
from tlcomm_core.records import TaskRecord
from tlcomm_core.scenario.loader import load_scenario
from tlcomm_core.scenario.model import Radio, Scenario
from tlcomm_core.scenario.site import Site
from tlcomm_core.units import nanoseconds, seconds
from tlcomm_tools.verification.findings import verify
from tlcomm_tools.verification.recording import Recording

CORRIDOR = load_scenario(Path(__file__).parents[4] / "scenarios" / "corridor.yaml")
BAD = Radio(loss=0.1, loss_at_range=0.4, jitter_s=0.05, duplication=0.1, bandwidth_bps=200_000.0)


@pytest.mark.parametrize(
    ("scenario", "rounds", "method"),
    [
        (gate(), 2, Method.TEAM),
        (gate().model_copy(update={"radio": BAD}), 1, Method.TEAM),
        (measuring_corridor(), 1, Method.TEAM),
        (CORRIDOR, 2, Method.PAIRWISE),
        (gate(), 1, Method.ALL_TIME),
        (gate(), 1, Method.NONE),
    ],
    ids=["gate", "radio", "field", "pairs", "turns", "none"],
)
def test_fresh_brains_do_what_was_recorded(scenario: Scenario, rounds: int, method: Method) -> None:
    """Told what the agents were told, they say, command and report the same, all of it."""
    recording = record(Mission(Site.from_scenario(scenario), 3, rounds, None, method=method))
    found = verify(recording)
    assert found.difference is None
    records = recording.run.records
    done = [recording.said, recording.commanded, records.tasks, records.strategies]
    done += [records.estimates, records.heard]
    assert sum(own.outputs for own in found.agents) == sum(map(len, done))
    assert found.document()["verdict"] == "ok"
    assert found.sim_s == seconds(recording.end_ns)


def test_what_was_heard_otherwise_is_named(recording: Recording) -> None:
    """A message that an agent's radio let through and isn't recorded is a difference."""
    heard = recording.run.records.heard
    lost = heard.pop(len(heard) // 2)
    found = verify(recording).difference
    assert found is not None
    assert (found.agent, found.time_ns, found.topic) == (lost.agent, lost.stamp_ns, "hearing")


@pytest.mark.parametrize("until_s", [None, 40.0])
def test_what_was_heard_may_be_unrecorded(recording: Recording, until_s: float | None) -> None:
    """As in bags from before it was, or after the last that was told of it: nothing differs."""
    records = recording.run.records
    until_ns = -1 if until_s is None else nanoseconds(until_s)
    names = records.heard_until_ns if until_s is not None else ()
    assert any(own.stamp_ns > until_ns for own in records.heard)
    records.heard = [own for own in records.heard if own.stamp_ns <= until_ns]
    records.heard_until_ns = dict.fromkeys(names, until_ns)
    recording.topics = frozenset(name for name in recording.topics if "hearing" not in name)
    assert verify(recording).difference is None


def test_a_changed_message_is_named(recording: Recording) -> None:
    """By who said it, when, and which part of it comes out otherwise."""
    index, said = next(
        (index, said)
        for index, said in enumerate(recording.said)
        if isinstance(said.message, PlanOffer) and said.stamp_ns > nanoseconds(20.0)
    )
    assert isinstance(said.message, PlanOffer)
    first, *others = said.message.offers
    offers = (replace(first, arrival_s=1.5), *others)
    recording.said[index] = replace(said, message=replace(said.message, offers=offers))
    found = verify(recording).difference
    assert found is not None
    assert (found.agent, found.time_ns) == (said.agent, said.stamp_ns)
    assert (found.topic, found.where) == ("plan_offer", "offers[0].arrival_s")
    assert (found.recorded, found.came_out) == ("1.5", repr(first.arrival_s))
    assert str(found).endswith(
        f"plan_offer offers[0].arrival_s: recorded 1.5, came out {first.arrival_s!r}"
    )


def test_a_changed_event_is_named(recording: Recording) -> None:
    """By agent, time and the part of it that comes out otherwise."""
    tasks = recording.run.records.tasks
    index = next(i for i, own in enumerate(tasks) if own.event.action)
    task = tasks[index]
    tasks[index] = replace(task, event=replace(task.event, region="elsewhere"))
    found = verify(recording).difference
    assert found is not None
    assert (found.agent, found.time_ns, found.topic) == (task.agent, task.stamp_ns, "task_event")
    shown = found.where, found.recorded, found.came_out
    assert shown == ("region", "'elsewhere'", repr(task.event.region))


def test_the_first_difference_of_all_is_named(recording: Recording) -> None:
    """Not that of the first agent: of two changed commands the earlier one."""
    late, early = [
        next(
            index
            for index, own in enumerate(recording.commanded)
            if own.agent == name and own.stamp_ns > nanoseconds(after_s)
        )
        for name, after_s in (("one", 15.0), ("two", 8.0))
    ]
    for index in (late, early):
        changed = replace(recording.commanded[index], drive=Drive(0.25, 0.0))
        recording.commanded[index] = changed
    found = verify(recording).difference
    assert found is not None
    assert (found.agent, found.time_ns) == ("two", recording.commanded[early].stamp_ns)
    assert (found.topic, found.where) == ("cmd_vel", "linear_mps")


def test_a_missing_event_is_named(recording: Recording) -> None:
    """What comes out and wasn't recorded is a difference."""
    task = recording.run.records.tasks.pop(2)
    found = verify(recording).difference
    assert found is not None
    assert (found.agent, found.time_ns, found.where) == (task.agent, task.stamp_ns, "")
    assert (found.recorded, found.came_out) == ("nothing", str(task.event))


@pytest.mark.parametrize("time_ns", [1_234_567_891, 10**12])
def test_an_invented_event_is_named(recording: Recording, time_ns: int) -> None:
    """What was recorded and doesn't come out is a difference, also when the agent doesn't act."""
    event = TaskEvent(TaskEventKind.FAULT, "", "", 1, 0, "made up")
    recording.run.records.tasks.append(TaskRecord(min(time_ns, recording.end_ns + 1), "two", event))
    recording.run.records.tasks.sort(key=lambda own: own.stamp_ns)
    found = verify(recording).difference
    assert found is not None
    assert (found.agent, found.came_out) == ("two", "nothing")
    assert found.document()["recorded"] == str(event)


def test_a_lost_message_is_seen_where_it_was_said(recording: Recording) -> None:
    """It comes out again, before anybody misses it."""
    index = next(i for i, own in enumerate(recording.said) if own.stamp_ns > nanoseconds(20.0))
    lost = recording.said.pop(index)
    found = verify(recording).difference
    assert found is not None
    assert (found.agent, found.time_ns, found.recorded) == (lost.agent, lost.stamp_ns, "nothing")


def test_what_an_agent_fails_with_is_named(recording: Recording) -> None:
    """A brain that can't go on, here for an impossible pose, is a difference and no crash."""
    odometry = recording.run.records.odometry
    index = next(i for i, own in enumerate(odometry) if own.stamp_ns > nanoseconds(20.0))
    nowhere = replace(odometry[index].pose, x_m=math.nan, y_m=math.nan)
    odometry[index] = replace(odometry[index], pose=nowhere)
    found = verify(recording).difference
    assert found is not None
    assert (found.agent, found.topic, found.recorded) == (
        odometry[index].agent,
        "failure",
        "nothing",
    )


def test_a_record_may_end_within_an_instant(recording: Recording) -> None:
    """What comes out at its very end needn't have been recorded any more; earlier it must."""
    tasks = recording.run.records.tasks
    assert tasks[-1].stamp_ns == recording.end_ns
    last = tasks.pop()
    assert recording.end_ns == last.stamp_ns
    assert verify(recording).difference is None


def test_a_difference_at_the_end_is_told_with_a_reserve(recording: Recording) -> None:
    """Of the last second a killed recorder may have lost some; of earlier ones it hasn't."""
    commanded = recording.commanded
    for index, is_late in ((-1, True), (4, False)):
        kept, commanded[index] = commanded[index], replace(commanded[index], drive=Drive(9.0, 9.0))
        found = verify(recording)
        assert found.difference is not None
        shown = found.difference.time_ns, "last second" in found.note
        assert shown == (kept.stamp_ns, is_late)
        commanded[index] = kept
