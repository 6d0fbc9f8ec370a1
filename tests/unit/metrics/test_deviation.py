"""Tests of ``tlcomm_core.metrics.deviation``: by hand, and against dense sampling."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from support.hall import hall
from tlcomm_core.field.field import Field
from tlcomm_core.metrics.deviation import Deviation, deviation_of_team, deviations
from tlcomm_core.records import EstimateRecord
from tlcomm_core.scenario.model import MeasuredField, Scenario
from tlcomm_core.units import nanoseconds

RISE = ((0.0, 2.0), (10.0, 7.0), (20.0, 7.0))


def scenario(*profile: tuple[float, float]) -> Scenario:
    """Return a scenario of agents one and two with a field."""
    field = MeasuredField(action="pick", profile=profile)
    return hall(2).scenario.model_copy(update={"field": field})


def estimates(agent: str, *held: tuple[float, float]) -> list[EstimateRecord]:
    """Return an agent's estimates: time (s) and value."""
    return [
        EstimateRecord(nanoseconds(t), agent, value, last_measurement=0.0, has_measurement=False)
        for t, value in held
    ]


def test_a_held_estimate_falls_behind() -> None:
    """The field rises from 2 to 7 in 10 s, and the estimate stays 2: 2.5 on average, then 5."""
    found = deviations(scenario(*RISE), estimates("one", (0.0, 2.0)), nanoseconds(20.0))
    assert found == {"one": Deviation(mean=3.75, most=5.0, span_s=20.0)}


def test_above_and_below_don_t_make_up_for_each_other() -> None:
    """From 1 above to 4 below within 10 s: it is right after 2 s; triangles of 1 s and 16 s."""
    found = deviations(scenario(*RISE), estimates("one", (0.0, 3.0)), nanoseconds(10.0))
    assert found["one"].mean == pytest.approx((0.5 * 2.0 * 1.0 + 0.5 * 8.0 * 4.0) / 10.0)
    assert found["one"].most == pytest.approx(4.0)


def test_it_begins_with_the_first_estimate() -> None:
    """What was before isn't known; an agent that never had one has no deviation."""
    held = estimates("two", (10.0, 6.0), (15.0, 9.0))
    found = deviations(scenario(*RISE), held, nanoseconds(20.0))
    assert found == {"two": Deviation(mean=1.5, most=2.0, span_s=10.0)}


def test_what_was_before_a_beginning_does_not_count() -> None:
    """From 5 s on the field rises from 4.5 to 7 in 5 s; the estimate is 2 until 10 s, then 7."""
    held = estimates("one", (0.0, 2.0), (10.0, 7.0))
    found = deviations(scenario(*RISE), held, nanoseconds(20.0), nanoseconds(5.0))
    assert found == {"one": Deviation(mean=0.5 * (2.5 + 5.0) * 5.0 / 15.0, most=5.0, span_s=15.0)}
    late = deviations(scenario(*RISE), held, nanoseconds(20.0), nanoseconds(12.0))
    assert late == {"one": Deviation(mean=0.0, most=0.0, span_s=8.0)}
    assert deviations(scenario(*RISE), held, nanoseconds(20.0), nanoseconds(20.0)) == {}


def test_of_several_at_one_time_the_last_counts() -> None:
    """And none that came when the run was over."""
    held = estimates("one", (10.0, 0.0), (10.0, 6.0), (20.0, 50.0))
    found = deviations(scenario(*RISE), held, nanoseconds(20.0))
    assert found["one"] == Deviation(mean=1.0, most=1.0, span_s=10.0)


def test_without_a_field_or_estimates_there_is_none() -> None:
    """Nobody is in the answer, and the team has none."""
    assert deviations(hall(2).scenario, estimates("one", (0.0, 1.0)), 10) == {}
    assert deviations(scenario(*RISE), [], 10) == {}
    assert deviation_of_team({}) is None


def test_the_teams_mean_is_over_time_and_agents() -> None:
    """Who has had an estimate for longer counts for more."""
    agents = {"one": Deviation(1.0, 4.0, 30.0), "two": Deviation(3.0, 3.5, 10.0)}
    assert deviation_of_team(agents) == Deviation(1.5, 4.0, 40.0)


VALUES = st.floats(-5.0, 5.0)
PROFILES = st.dictionaries(st.integers(0, 40).map(float), VALUES, min_size=1, max_size=6)
HISTORIES = st.lists(st.tuples(st.integers(0, 39).map(float), VALUES), min_size=1, max_size=8)


@given(profile=PROFILES, held=HISTORIES)
@settings(max_examples=100, deadline=None)
def test_it_is_what_dense_sampling_finds(
    profile: dict[float, float], held: list[tuple[float, float]]
) -> None:
    """A hundred samples a second find the same mean and the same maximum, about."""
    end_s = 40.0
    held.sort(key=lambda own: own[0])
    world = scenario(*sorted(profile.items()))
    field = Field.of(world)
    assert field is not None
    found = deviations(world, estimates("one", *held), nanoseconds(end_s))["one"]
    times_s = np.arange(held[0][0], end_s, 0.01) + 0.005
    last = np.searchsorted([time_s for time_s, _ in held], times_s, side="right") - 1
    sizes = np.abs(np.array([value for _, value in held])[last] - field.value(times_s))
    assert found.mean == pytest.approx(float(sizes.mean()), abs=1e-3)
    assert found.most == pytest.approx(float(sizes.max()), abs=0.06)
