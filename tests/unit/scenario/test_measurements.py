"""The field's section: what it may say, and each thing that it may not."""

import math

import pytest

from support.good_scenario import GOOD
from tlcomm_core.errors import ScenarioError
from tlcomm_core.scenario.loader import dumps, loads
from tlcomm_core.scenario.measurements import stations_of

FIELD = """\
field:
  action: pick
  profile: [[0, 40.0], [100, 70.0]]
  drift: {amplitude: 1.0, frequency_radps: 0.001, phases_rad: {a: 0.0, b: 1.5}}
  exchange: {period_s: 0.1}
"""


def refusal(old: str, new: str) -> str:
    """Return how a good scenario is refused in which one thing is changed."""
    assert old in FIELD
    with pytest.raises(ScenarioError) as caught:
        loads(GOOD + FIELD.replace(old, new))
    return str(caught.value)


def test_a_scenario_needs_no_field() -> None:
    """Then there is none, and it isn't written out either."""
    scenario = loads(GOOD)
    assert scenario.field is None
    assert stations_of(scenario) == {}
    assert "field" not in dumps(scenario)


def test_a_field_is_read_and_written_with_its_defaults() -> None:
    """It loads back to an equal one, the defaults filled in."""
    scenario = loads(GOOD + FIELD)
    assert scenario.field is not None
    assert scenario.field.profile == ((0.0, 40.0), (100.0, 70.0))
    assert scenario.field.exchange.mode == "consensus"
    assert loads(dumps(scenario)) == scenario
    assert "tolerance: 0.01" in dumps(scenario)


def test_stations_are_the_regions_that_have_phases() -> None:
    """In the order given."""
    assert stations_of(loads(GOOD + FIELD)) == {"a": 0.0, "b": 1.5}


def test_without_phases_every_region_is_a_station() -> None:
    """With phases spread evenly, if the action is possible everywhere."""
    text = GOOD + FIELD.replace(", phases_rad: {a: 0.0, b: 1.5}", "")
    assert stations_of(loads(text)) == {"a": 0.0, "b": math.pi}


def test_without_phases_stations_are_where_the_action_is_possible() -> None:
    """For any of the agents."""
    text = GOOD.replace("{pick: 4.0}", "{pick: {duration_s: 4.0, at: [a]}}")
    text = text.replace("{pick: 1.0, drop: 2}", "{drop: 2}")
    field = FIELD.replace(", phases_rad: {a: 0.0, b: 1.5}", "")
    assert stations_of(loads(text + field)) == {"a": 0.0}


@pytest.mark.parametrize(
    ("old", "new", "line"),
    [
        ("pick", "pik", "field.action: unknown action 'pik'; did you mean 'pick'?"),
        ("a: 0.0", "c: 0.0", "phases_rad.c: unknown region 'c'; expected one of a, b"),
        ("{a: 0.0, b: 1.5}", "{}", "field.drift.phases_rad: found {}; expected at least 1 items"),
        ("[100, 70.0]", "[0, 70.0]", "field.profile[1]: 0.0 s isn't later than the breakpoint"),
        ("[[0, 40.0], [100, 70.0]]", "[]", "field.profile: found []; expected at least 1 items"),
        ("[0, 40.0]", "[-1, 40.0]", "field.profile[0][0]: found -1; expected greater than or"),
        ("[100, 70.0]", "[100, .nan]", "field.profile[1][1]: found '.nan'; expected a finite"),
        ("amplitude: 1.0", "amplitude: -1.0", "field.drift.amplitude: found -1.0; expected great"),
        ("amplitude", "amplitud", "field.drift.amplitud: unknown field; did you mean 'amplitude'?"),
        ("period_s: 0.1", "period_s: 0.005", "period_s: 0.005 isn't between hop_latency_s (0.005)"),
        ("period_s: 0.1", "period_s: 5", "period_s: 5.0 isn't between hop_latency_s (0.005) and"),
        ("period_s: 0.1", "step: 1.0", "field.exchange.step: 1.0 isn't below 1/1: an agent may"),
        ("period_s: 0.1", "step: 0", "field.exchange.step: found 0; expected greater than 0"),
        ("period_s: 0.1", "mode: mean", "found 'mean'; expected 'consensus' or 'exact'"),
        ("period_s: 0.1", "tolerance: -1", "field.exchange.tolerance: found -1; expected greater"),
    ],
)
def test_what_is_wrong_is_said_in_one_line(old: str, new: str, line: str) -> None:
    """Which names the place, what was found and what was expected."""
    refused = refusal(old, new)
    assert line in refused
    assert "\n" not in refused


def test_a_step_below_the_bound_is_taken() -> None:
    """Of two agents each has one neighbour at most."""
    scenario = loads(GOOD + FIELD.replace("period_s: 0.1", "step: 0.99"))
    assert scenario.field is not None
    assert scenario.field.exchange.step == 0.99
