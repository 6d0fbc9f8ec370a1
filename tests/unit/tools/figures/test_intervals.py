"""Tests of ``tlcomm_tools.figures.intervals``."""

import numpy as np

from tlcomm_tools.figures.intervals import Interval, mean_interval


def test_an_interval_is_about_two_standard_errors_wide_each_way() -> None:
    """For many values whose mean is nearly normal."""
    values = np.random.default_rng(1).normal(5.0, 2.0, 400).tolist()
    interval = mean_interval(values)
    error = np.std(values) / 20.0
    assert interval.mean == np.mean(values)
    assert abs(interval.high - interval.mean - 1.96 * error) < 0.15 * error
    assert abs(interval.mean - interval.low - 1.96 * error) < 0.15 * error


def test_one_value_has_no_width() -> None:
    """Nothing is known of others."""
    assert mean_interval([3.0]) == Interval(3.0, 3.0, 3.0)


def test_an_interval_is_the_same_each_time() -> None:
    """Chance is seeded."""
    assert mean_interval([1.0, 2.0, 5.0]) == mean_interval([1.0, 2.0, 5.0])
