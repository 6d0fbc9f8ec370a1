"""ν(t) and what stations read."""

import math

import numpy as np

from support.good_scenario import GOOD
from tlcomm_core.field.field import Field
from tlcomm_core.scenario.loader import loads

PROFILE = ((100.0, 40.0), (200.0, 60.0), (300.0, 50.0))


def test_the_field_is_linear_between_breakpoints() -> None:
    """And constant before the first and after the last."""
    field = Field(PROFILE, {})
    assert [field.value(time_s) for time_s in (0.0, 100.0, 150.0, 250.0, 300.0, 1e6)] == [
        40.0,
        40.0,
        50.0,
        55.0,
        50.0,
        50.0,
    ]


def test_many_times_give_the_same_values_as_each() -> None:
    """Of the field and of a station, to the bit."""
    field = Field(PROFILE, {"m": 0.5}, 2.0, 0.01)
    times_s = np.linspace(0.0, 400.0, 57)
    assert field.value(times_s).tolist() == [field.value(t) for t in times_s.tolist()]
    readings = field.reading("m", times_s).tolist()
    assert readings == [field.reading("m", t) for t in times_s.tolist()]


def test_a_station_reads_the_field_and_its_own_drift() -> None:
    """A · sin(ω t + φ) beside ν(t)."""
    field = Field(PROFILE, {"m1": 0.0, "m2": math.pi / 2.0}, 2.0, math.pi / 6000.0)
    assert field.reading("m1", 0.0) == 40.0
    assert field.reading("m2", 0.0) == 42.0
    assert math.isclose(field.reading("m1", 3000.0), 52.0)
    assert math.isclose(field.reading("m2", 3000.0), 50.0, abs_tol=1e-9)


def test_a_scenario_without_a_field_has_none() -> None:
    """The section is what makes it."""
    assert Field.of(loads(GOOD)) is None


def test_a_scenario_s_field_is_as_its_section_says() -> None:
    """Profile, drift and stations."""
    section = """\
field:
  action: pick
  profile: [[0, 40.0], [100, 70.0]]
  drift: {amplitude: 3.0, frequency_radps: 0.5, phases_rad: {b: 1.5}}
"""
    field = Field.of(loads(GOOD + section))
    assert field is not None
    assert field.value(50.0) == 55.0
    assert dict(field.stations) == {"b": 1.5}
    assert field.reading("b", 10.0) == 43.0 + 3.0 * math.sin(6.5)
