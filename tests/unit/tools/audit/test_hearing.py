"""Tests of ``tlcomm_tools.audit.hearing`` and ``proximity``: who can have heard what."""

from dataclasses import replace

import numpy as np
import pytest

from tlcomm_core.geometry import Pose
from tlcomm_core.pace import Pace
from tlcomm_core.records import HeardRecord, RunRecords, SaidRecord
from tlcomm_core.scenario.loader import loads
from tlcomm_core.scenario.model import Radio, Scenario
from tlcomm_core.units import nanoseconds
from tlcomm_core.world.observation import Odometry
from tlcomm_tools.audit.evidence import Evidence
from tlcomm_tools.audit.hearing import audit_hearing, unheard
from tlcomm_tools.audit.proximity import Proximity

LOCK_STEP, REAL_TIME = Pace(None), Pace(1.0)
END_S = 10.0

# South stands; north comes at 1 m/s from 3 m away, is in range, 1 m, from 2 s to 4 s, and drives on
# past it. From 3.2 s on a wall stands north of south.
SCENARIO = loads("""
name: pass
workspace:
  size_m: [8.0, 2.0]
  cell_m: 0.5
  regions:
    west: {at_m: [0.25, 0.25], radius_m: 0.3}
  changes:
    - {at_s: 3.2, obstacles_m: [[3.0, 0.5, 4.5, 1.0]]}
communication: {range_m: 1.0, period_s: 20.0, duration_s: 2.0, hop_latency_s: 0.1}
motion: {linear_mps: 1.0, angular_radps: 1.5}
actions: {pick: 1.0}
agents:
  north: {start: [3.25, 1.25, 0.0], task: "F (west & pick)"}
  south: {start: [3.25, 0.25, 0.0], task: "F (west & pick)"}
""")
SEEING = SCENARIO.model_copy(update={"radio": Radio(line_of_sight=True)})


def evidence(*heard: HeardRecord, scenario: Scenario = SCENARIO, y_m: float = 0.25) -> Evidence:
    """Return a run in which all that was heard was said; ``y_m``: on which line north drives."""
    odometry = [
        own
        for step in range(11)
        for own in (
            Odometry(nanoseconds(step), "north", Pose(0.25 + step, y_m, 0.0), 1.0, 0.0),
            Odometry(nanoseconds(step), "south", Pose(3.25, 0.25, 0.0), 0.0, 0.0),
        )
    ]
    records = RunRecords(
        odometry=odometry,
        said=[SaidRecord(own.said_ns, own.sender, own.topic) for own in set(heard)],
        heard=list(heard),
        heard_until_ns=dict.fromkeys(scenario.agents, nanoseconds(END_S)),
    )
    return Evidence.gather(scenario, records, END_S)


def heard(said_s: float, heard_s: float | None = None) -> HeardRecord:
    """Return that south hears north, by default when it arrives."""
    stamp_ns = nanoseconds(said_s + 0.1 if heard_s is None else heard_s)
    return HeardRecord(stamp_ns, "south", "north", "plan_offer", nanoseconds(said_s))


@pytest.mark.parametrize(
    ("said_s", "away"),
    [(1.899, "1.001 m"), (1.9, ""), (2.5, ""), (3.9, ""), (3.901, "1.001 m")],
)
def test_in_lock_step_the_range_counts_when_a_message_arrives(said_s: float, away: str) -> None:
    """A hop's latency after it was said, at that very instant, whenever it is acted upon."""
    for late_s in (0.1, 0.7):
        lines = list(audit_hearing(evidence(heard(said_s, said_s + late_s)), LOCK_STEP))
        assert [line.split("from ")[1] for line in lines] == (
            [f"{away} away, out of range"] if away else []
        )


@pytest.mark.parametrize(
    ("said_s", "is_fine"), [(1.9, False), (2.0, True), (4.0, True), (4.99, True), (5.01, False)]
)
def test_running_freely_it_counts_in_the_second_before(said_s: float, is_fine: bool) -> None:
    """As late as agents may learn that they have parted, and no later."""
    lines = list(audit_hearing(evidence(heard(said_s)), REAL_TIME))
    assert not lines if is_fine else len(lines) == 1


def test_who_must_see_hears_nobody_behind_what_stands_there_then() -> None:
    """By the obstacles of that time; nobody is hidden before, nor where sight doesn't matter."""
    told = [heard(2.6), heard(3.0), heard(3.1), heard(3.3)]
    found = evidence(*told, scenario=SEEING, y_m=1.15)
    (line,) = audit_hearing(found, LOCK_STEP)
    assert line == (
        "south: 3.200 s: heard 'plan_offer' of north, said at 3.100 s, from 0.922 m away, "
        "out of sight; 2 messages in all"
    )
    assert list(audit_hearing(evidence(*told, y_m=1.15), LOCK_STEP)) == []


def test_running_freely_sight_counts_in_the_second_before_as_well() -> None:
    """Until what hides them has stood for a second."""
    for said_s, count in ((3.7, 0), (4.19, 0), (4.21, 1)):
        found = evidence(heard(said_s), scenario=SEEING, y_m=1.15)
        assert len(list(audit_hearing(found, REAL_TIME))) == count


@pytest.mark.parametrize(
    ("heard_s", "pace", "how"),
    [
        (2.4, LOCK_STEP, "before it was said"),
        (2.55, LOCK_STEP, "sooner than 0.1 s after"),
        (2.6, LOCK_STEP, ""),
        (2.5, REAL_TIME, ""),
        (1.6, REAL_TIME, ""),
        (1.4, REAL_TIME, "before it was said"),
    ],
)
def test_nothing_is_heard_before_it_can_arrive(heard_s: float, pace: Pace, how: str) -> None:
    """Running freely, clocks may be a second apart."""
    lines = list(audit_hearing(evidence(heard(2.5, heard_s)), pace))
    assert [line.rpartition("2.500 s, ")[2] for line in lines] == ([how] if how else [])


def test_what_is_doubled_on_its_way_is_heard_twice_at_most() -> None:
    """And only where the scenario lets that happen."""
    doubling = SCENARIO.model_copy(update={"radio": Radio(duplication=0.5)})
    for scenario, times, count in ((SCENARIO, 2, 1), (doubling, 2, 0), (doubling, 3, 1)):
        found = evidence(*[heard(2.5)] * times, scenario=scenario)
        lines = list(audit_hearing(found, LOCK_STEP))
        assert [line.rpartition(", ")[2] for line in lines] == (
            ["more often than it was said"] * count
        )


def test_without_a_pace_or_a_record_nothing_is_available() -> None:
    """Of all, of one, or after some time; then nothing is called right."""
    whole = evidence(heard(5.0))
    assert (unheard(whole, LOCK_STEP), unheard(whole, REAL_TIME)) == ((), ())
    assert unheard(whole, None)[0].startswith("the bag doesn't say its run's pace")
    assert list(audit_hearing(whole, None)) == []
    records = replace(whole.records, heard_until_ns={"south": nanoseconds(8.5)})
    assert unheard(replace(whole, records=records), LOCK_STEP) == (
        "north: nothing recorded of what it heard",
        "south: nothing recorded of what it heard after 8.500 s",
    )
    records = replace(whole.records, heard_until_ns={})
    assert unheard(replace(whole, records=records), LOCK_STEP) == (
        "nothing recorded of what agents heard",
    )


def test_links_at_instants_are_those_of_the_intervals() -> None:
    """Whichever way they are found, past a wall that comes: at random times."""
    found = Proximity.of(evidence(scenario=SEEING, y_m=1.15), "north", "south")
    times_s = np.random.default_rng(1).uniform(0.0, END_S, 2000)
    at, within = found.linked_at(times_s), found.linked_within(times_s, times_s)
    assert at.tolist() == within.tolist()
    assert 0 < at.sum() < len(times_s)


def test_nobody_hears_itself() -> None:
    """Whatever it said, and though it is as near as can be."""
    own = replace(heard(2.5), sender="south")
    (line,) = audit_hearing(evidence(own), LOCK_STEP)
    assert line.endswith("heard 'plan_offer' of south, said at 2.500 s, which is its own")
