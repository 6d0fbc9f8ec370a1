"""Tests of ``tlcomm_tools.figures.reduction``."""

from dataclasses import replace

import pytest

from support.hand_made_run import END_S, hand_made_records, hand_made_scenario, task
from tlcomm_core.agent.actions import TaskEventKind
from tlcomm_core.geometry import Pose
from tlcomm_core.records import EstimateRecord, RunRecords, StrategyRecord
from tlcomm_core.scenario.site import Site
from tlcomm_core.units import nanoseconds
from tlcomm_core.world.observation import Connectivity, Odometry
from tlcomm_tools.figures import reduction
from tlcomm_tools.figures.elements import Activity, Span


def of_east(records: RunRecords) -> list[Span]:
    """Return what one of the two agents did."""
    own = [record for record in records.tasks if record.agent == "east"]
    return list(reduction.spans(own, END_S))


def test_a_way_keeps_its_bends_only() -> None:
    """Samples on straight stretches at even speed are left out; a stop is a bend in time."""
    samples = [(0.0, 0.0, 0.0), (1.0, 1.0, 0.0), (2.0, 2.0, 0.0), (3.0, 2.0, 0.0), (4.0, 2.0, 1.0)]
    path = reduction.path(
        Odometry(nanoseconds(t), "east", Pose(x, y, 0.0), 0.0, 0.0) for t, x, y in samples
    )
    assert path.times_s == (0.0, 2.0, 3.0, 4.0)
    assert path.x_m == (0.0, 2.0, 2.0, 2.0)
    assert path.y_m == (0.0, 0.0, 0.0, 1.0)


def test_a_jump_at_one_instant_is_kept() -> None:
    """Both places are, and so is one that is too far for any rounding."""
    samples = [
        Odometry(nanoseconds(time_s), "west", Pose(x_m, 0.0, 0.0), 0.0, 0.0)
        for time_s, x_m in ((0.0, 0.0), (1.0, 0.0), (1.0, 5.0), (2.0, 1e11), (3.0, 0.0))
    ]
    path = reduction.path(samples)
    assert path is not None
    assert path.x_m == (0.0, 0.0, 5.0, 1e11, 0.0)


def test_who_never_moved_has_no_way() -> None:
    """Not even a place is known."""
    assert reduction.path([]).times_s == ()


def test_spans_are_actions_waits_and_meetings() -> None:
    """In order of time; a wait ends with the meeting at the latest."""
    records = hand_made_records()
    records.tasks.append(task(10.0, "east", TaskEventKind.MEETING_STARTED))
    records.tasks.sort(key=lambda record: record.stamp_ns)
    spans = of_east(records)
    assert [(own.activity.value, own.action, own.start_s, own.end_s) for own in spans] == [
        ("action", "pick", 4.5, 5.5),
        ("wait", "", 8.0, 10.0),
        ("meeting", "", 10.0, 12.0),
        ("action", "pick", 14.5, 15.5),
        ("wait", "", 18.0, 22.0),
    ]


def test_what_is_under_way_at_the_end_ends_there() -> None:
    """No span is left open."""
    records = RunRecords(tasks=[task(3.0, "east", TaskEventKind.ACTION_STARTED, action="pick")])
    assert of_east(records) == [
        Span(activity=Activity.ACTION, action="pick", start_s=3.0, end_s=END_S)
    ]


def test_an_action_that_fails_ends_there() -> None:
    """The next attempt is another span."""
    kinds = (TaskEventKind.ACTION_STARTED, TaskEventKind.FAULT) * 2
    events = [task(1.0 + n, "east", kind, action="pick") for n, kind in enumerate(kinds)]
    spans = of_east(RunRecords(tasks=events))
    assert [(own.start_s, own.end_s) for own in spans] == [(1.0, 2.0), (3.0, 4.0)]


def test_who_waits_in_vain_goes_on() -> None:
    """A wait ends with the next action at the latest."""
    events = [
        task(1.0, "east", TaskEventKind.MEETING_REACHED),
        task(4.0, "east", TaskEventKind.ACTION_STARTED, action="pick"),
        task(5.0, "east", TaskEventKind.ACTION_FINISHED, action="pick"),
    ]
    spans = of_east(RunRecords(tasks=events))
    assert [(own.activity.value, own.end_s) for own in spans] == [("wait", 4.0), ("action", 5.0)]


def test_meetings_have_places_and_links() -> None:
    """Each is there once, although each agent holds it; a meeting to come isn't there."""
    first, second = reduction.meetings(hand_made_scenario(), hand_made_records(), END_S)
    assert (first.round, first.start_s) == (1, 10.0)
    assert first.places_m == {"east": (3.75, 0.25), "west": (3.25, 0.25)}
    assert first.links == second.links == (("east", "west"),)


def test_links_are_those_in_the_middle_of_a_meeting() -> None:
    """By its agents' account of when it began; they may come late, and leave early."""
    records = hand_made_records()
    records.tasks = [task(10.2, "east", TaskEventKind.MEETING_STARTED, round_=1)]
    records.connectivity = [
        Connectivity(nanoseconds(time_s), edges, connected=bool(edges))
        for time_s, edges in [(0.0, ()), (11.1, ((0, 1),)), (11.3, ())]
    ]
    first, second = reduction.meetings(hand_made_scenario(), records, END_S)
    assert (first.start_s, first.links) == (10.2, (("east", "west"),))
    assert (second.start_s, second.links) == (20.0, ())


def test_a_part_of_the_team_may_meet() -> None:
    """Links are those among the members."""
    records = hand_made_records()
    records.strategies = [
        StrategyRecord(
            record.stamp_ns,
            record.agent,
            replace(record.strategy, strategies=record.strategy.strategies[:1]),
        )
        for record in records.strategies
    ]
    first, _ = reduction.meetings(hand_made_scenario(), records, END_S)
    assert list(first.places_m) == ["east"]
    assert first.links == ()


def test_agreements_are_those_of_strategies() -> None:
    """Each round's once."""
    found = reduction.agreements(hand_made_records())
    assert [(own.round, own.initial_s, own.agreed_s) for own in found] == [
        (1, 7.0, 6.0),
        (2, 7.0, 6.0),
        (3, 7.0, 6.0),
    ]


def test_nobodys_additional_time_is_left_out() -> None:
    """Where a meeting didn't take place, nothing is known; a part of the team is."""
    rounds = [
        {"round": 1, "additional_time": {"east": None, "west": None}},
        {"round": 2, "additional_time": {"east": 0.0, "west": None}},
    ]
    (known,) = reduction.additional_times(rounds)
    assert (known.round, known.by_agent_s) == (2, {"east": 0.0})


def test_meetings_of_a_round_count_together() -> None:
    """Pairs meet apart, and an agent may meet twice."""
    rounds = [
        {"round": 1, "additional_time": {"a": 1.0, "b": 2.0}},
        {"round": 1, "additional_time": {"b": 0.5, "c": 4.0}},
    ]
    (both,) = reduction.additional_times(rounds)
    assert both.by_agent_s == {"a": 1.0, "b": 2.5, "c": 4.0}


def test_estimates_of_one_exchange_are_one_step() -> None:
    """Where it led to counts; what doesn't change is no step."""
    series = reduction.estimates(
        EstimateRecord(nanoseconds(time_s), "east", value, 0.0, has_measurement=True)
        for time_s, value in [(1.0, 5.0), (10.0, 6.0), (10.1, 7.0), (20.0, 7.0), (30.0, 8.0)]
    )
    assert series.times_s == (1.0, 10.0, 30.0)
    assert series.values == (5.0, 7.0, 8.0)


def test_the_field_is_known_over_the_whole_run(plant: Site) -> None:
    """Its bends, and both ends of the run; a scenario may have none."""
    profile = reduction.field(plant.scenario, 1800.0)
    assert profile is not None
    assert profile.times_s == (0.0, 1200.0, 1800.0)
    assert profile.values == pytest.approx((52.0, 56.0, 54.5))
    assert reduction.field(hand_made_scenario(), END_S) is None
