"""Whole teams that measure a field: who gets readings, and what becomes of them."""

from functools import cache
from itertools import pairwise

import numpy as np
import pytest

from support.measuring_corridor import measuring_corridor
from tlcomm_core.agent.actions import TaskEventKind
from tlcomm_core.field.field import Field
from tlcomm_core.method import Method
from tlcomm_core.mission import Mission
from tlcomm_core.protocol.messages import EstimateExchange
from tlcomm_core.records import EstimateRecord, RunRecords, TaskRecord, event_log
from tlcomm_core.scenario.model import Radio, Scenario
from tlcomm_core.scenario.site import Site
from tlcomm_core.simulation import simulate
from tlcomm_core.units import seconds

ROUNDS = 4


@cache
def run(mode: str = "consensus", method: Method = Method.TEAM) -> RunRecords:
    """Return what some rounds in the corridor leave, without noise."""
    return simulate(mission(measuring_corridor(noise=0.0, mode=mode), method)).records


def mission(scenario: Scenario, method: Method = Method.TEAM, seed: int = 0) -> Mission:
    """Return a mission of some rounds, or as long as these take."""
    until_s = (ROUNDS + 1) * scenario.communication.period_s
    return Mission(Site.from_scenario(scenario), seed, ROUNDS, until_s, method=method)


def measurements(records: RunRecords) -> list[EstimateRecord]:
    """Return the estimates with which a new measurement is reported."""
    last: dict[str, float] = {}
    found = []
    for own in records.estimates:
        if own.has_measurement and last.get(own.agent) != own.last_measurement:
            found.append(own)
            last[own.agent] = own.last_measurement
    return found


def placed(records: RunRecords) -> list[TaskRecord]:
    """Return the ends of the action that reads the field."""
    ends = [own for own in records.tasks if own.event.kind is TaskEventKind.ACTION_FINISHED]
    return [own for own in ends if own.event.action == "place"]


@pytest.mark.parametrize("method", [Method.TEAM, Method.NONE])
def test_each_measurement_gives_the_reading_of_its_station(method: Method) -> None:
    """At the instant at which the action ends, to who has ended it, and no other readings."""
    field = Field.of(measuring_corridor(noise=0.0))
    assert field is not None
    records = run(method=method)
    expected = [
        (own.stamp_ns, own.agent, field.reading(own.event.region, seconds(own.stamp_ns)))
        for own in placed(records)
    ]
    assert len(expected) > ROUNDS
    found = [(own.stamp_ns, own.agent, own.last_measurement) for own in measurements(records)]
    assert sorted(found) == sorted(expected)


def test_a_reading_shifts_the_estimate_by_what_it_differs_from_the_last() -> None:
    """The first is the estimate, in a team that seeks consensus."""
    estimates = run().estimates
    first = {own.agent: own for own in reversed(measurements(run()))}
    assert all(own.value == own.last_measurement for own in first.values())
    for name in first:
        own = [estimate for estimate in estimates if estimate.agent == name]
        for before, after in pairwise(own[own.index(first[name]) :]):
            if after.last_measurement != before.last_measurement:
                shift = after.last_measurement - before.last_measurement
                assert after.value == pytest.approx(before.value + shift, abs=1e-9)


@pytest.mark.parametrize("mode", ["consensus", "exact"])
def test_a_meeting_brings_estimates_together(mode: str) -> None:
    """When it ends, all have nearly the same; exactly the same if they flood measurements."""
    records = run(mode)
    ends = [own for own in records.tasks if own.event.kind is TaskEventKind.MEETING_ENDED]
    last_ns = {own.event.round: own.stamp_ns for own in ends}
    first_placed = max(
        min(own.stamp_ns for own in placed(records) if own.agent == name)
        for name in ("west", "carrier", "east")
    )
    spreads = []
    for end_ns in last_ns.values():
        held = {own.agent: own.value for own in records.estimates if own.stamp_ns <= end_ns}
        if end_ns > first_placed:
            spreads.append(np.ptp(list(held.values())))
    assert len(spreads) >= ROUNDS - 1
    assert max(spreads) <= (0.02 if mode == "consensus" else 0.0)


def test_the_same_run_leaves_the_same_estimates() -> None:
    """With noise too; another seed leaves others."""
    scenario = measuring_corridor()
    first, second, other = (
        simulate(mission(scenario, seed=seed)).records.estimates for seed in (3, 3, 4)
    )
    assert first == second
    assert first[0].stamp_ns == other[0].stamp_ns
    assert first[0].value != other[0].value


def test_measuring_changes_nothing_of_what_the_team_does() -> None:
    """Tasks and meetings are the same with and without a field."""
    without = measuring_corridor().model_copy(update={"field": None})
    records = simulate(mission(without)).records
    assert records.estimates == []
    assert list(event_log(records)) == list(event_log(run()))


def test_who_meets_nobody_exchanges_nothing() -> None:
    """Each has what it measured last."""
    records = run(method=Method.NONE)
    assert all(own.value == own.last_measurement for own in records.estimates)
    assert sum(records.messages_sent.values()) == 0


def test_over_a_bad_radio_estimates_still_come_together() -> None:
    """What is lost is repeated; nothing goes on for ever."""
    radio = Radio(loss=0.2, jitter_s=0.03, duplication=0.1)
    scenario = measuring_corridor(noise=0.0).model_copy(update={"radio": radio})
    said: list[EstimateExchange] = []

    def note(message: object) -> None:
        if isinstance(message, EstimateExchange):
            said.append(message)

    records = simulate(mission(scenario), on_message=note).records
    last = {own.agent: own.value for own in records.estimates}
    field = Field.of(scenario)
    assert field is not None
    assert len(last) == 3
    assert max(abs(value - 52.0) for value in last.values()) < 2.0
    assert len(said) < 1000
