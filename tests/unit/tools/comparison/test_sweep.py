"""What can be varied."""

from pathlib import Path

import pytest

from tlcomm_core.errors import InputError
from tlcomm_core.scenario.loader import load_scenario
from tlcomm_tools.comparison.sweep import Sweep, parse_sweep, shown

PLANT = load_scenario(Path(__file__).parents[4] / "scenarios" / "plant.yaml")


def test_values_ascend_and_count_once() -> None:
    """In whatever order they are given."""
    assert parse_sweep("range=1.5,1,1.50,2") == Sweep("range", (1.0, 1.5, 2.0))


@pytest.mark.parametrize(
    ("text", "complaint"),
    [
        ("speed", "NAME=V1,V2,…"),
        ("colour=1", "'colour=1'"),
        ("range=", "a number from 0 on, not ''"),
        ("range=1,,2", "not ''"),
        ("range=x", "not 'x'"),
        ("range=nan", "not 'nan'"),
        ("range=-1", "not '-1'"),
        ("agents=2.5", "a whole number from 1 on, not '2.5'"),
        ("agents=0", "a whole number from 1 on, not '0'"),
    ],
)
def test_what_is_no_sweep_is_refused(text: str, complaint: str) -> None:
    """With the offending part."""
    with pytest.raises(InputError, match=complaint.replace("(", r"\(")):
        parse_sweep(text)


@pytest.mark.parametrize(
    ("name", "value", "place"),
    [
        ("range", 1.5, ("communication", "range_m")),
        ("period", 90.0, ("communication", "period_s")),
        ("duration", 4.0, ("communication", "duration_s")),
        ("speed", 0.5, ("motion", "linear_mps")),
        ("loss", 0.25, ("radio", "loss")),
    ],
)
def test_a_value_changes_one_field(name: str, value: float, place: tuple[str, str]) -> None:
    """And nothing else."""
    changed = Sweep(name, (value,)).scenario(PLANT, value).model_dump()
    section, field = place
    assert changed[section].pop(field) == value
    expected = PLANT.model_dump()
    expected[section].pop(field)
    assert changed == expected


def test_a_number_of_agents_is_that_of_the_first() -> None:
    """In the order of the scenario."""
    smaller = Sweep("agents", (3.0,)).scenario(PLANT, 3.0)
    assert list(smaller.agents) == ["agent_1", "agent_2", "agent_3"]


@pytest.mark.parametrize(
    ("name", "value", "complaint"),
    [
        ("agents", 9.0, "agents=9: scenario 'plant' has no more than 8"),
        ("range", 0.3, "range=0.3: plant: agents"),
        ("range", 0.0, "range=0: it should be greater than 0"),
        ("duration", 60.0, "duration=60: plant: communication.duration_s"),
        ("loss", 1.5, "loss=1.5: it should be less than or equal to 1"),
    ],
)
def test_a_value_that_makes_no_scenario_is_refused(name: str, value: float, complaint: str) -> None:
    """With the value and why."""
    with pytest.raises(InputError, match=f"--sweep: {complaint}"):
        Sweep(name, (value,)).scenario(PLANT, value)


def test_values_are_shown_as_given() -> None:
    """Whole numbers without a point, others in full."""
    assert [shown(8.0), shown(0.1), shown(1.0000001)] == ["8", "0.1", "1.0000001"]
