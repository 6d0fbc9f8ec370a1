"""Tests of ``tlcomm_tools.figures.elements``."""

import numpy as np
import pytest
from pydantic import ValidationError

from tlcomm_tools.figures.elements import AdditionalTime, Path, Profile, Series


def test_a_way_is_straight_between_samples() -> None:
    """Both ends of the stretch are interpolated, samples inside it are kept."""
    path = Path(times_s=(0.0, 2.0, 4.0), x_m=(0.0, 2.0, 2.0), y_m=(0.0, 0.0, 2.0))
    expected = [[1.0, 0.0], [2.0, 0.0], [2.0, 1.0]]
    np.testing.assert_allclose(path.between(1.0, 3.0), expected)


def test_a_series_holds_its_value_until_the_next() -> None:
    """There is none before the first."""
    series = Series(times_s=(1.0, 3.0), values=(5.0, 7.0))
    values = series.at(np.array([0.5, 1.0, 2.9, 3.0, 9.0]))
    np.testing.assert_array_equal(values, [np.nan, 5.0, 5.0, 7.0, 7.0])


def test_a_profile_is_straight_between_its_bends() -> None:
    """It is constant outside them."""
    profile = Profile(times_s=(0.0, 10.0), values=(1.0, 3.0))
    np.testing.assert_allclose(profile.at(np.array([-1.0, 5.0, 11.0])), [1.0, 2.0, 3.0])


@pytest.mark.parametrize(
    ("times_s", "values", "flaw"),
    [
        ((0.0, 1.0), (1.0,), "differ in length"),
        ((1.0, 0.0), (1.0, 2.0), "isn't ascending"),
        ((0.0,), (float("nan"),), "finite number"),
    ],
)
def test_a_flawed_series_is_refused(
    times_s: tuple[float, ...], values: tuple[float, ...], flaw: str
) -> None:
    """The complaint says what is wrong."""
    with pytest.raises(ValidationError, match=flaw):
        Series(times_s=times_s, values=values)


def test_a_way_has_as_many_places_as_times() -> None:
    """The complaint says that it hasn't."""
    with pytest.raises(ValidationError, match="differ in length"):
        Path(times_s=(0.0, 1.0), x_m=(0.0, 1.0), y_m=(0.0,))


def test_additional_time_has_a_mean_over_agents() -> None:
    """Of those that it is known of."""
    assert AdditionalTime(round=1, by_agent_s={"a": 1.0, "b": 4.0}).mean_s == 2.5
