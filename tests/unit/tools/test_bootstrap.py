"""Means and their intervals."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from tlcomm_tools.bootstrap import Estimate, estimate_mean


def test_the_interval_of_normal_values_is_that_of_theory() -> None:
    """Of many values it is the mean ± 1.96 σ/√n, as the central limit theorem has it."""
    values = np.random.default_rng(0).normal(10.0, 2.0, 400)
    estimate = estimate_mean(values.tolist())
    assert estimate is not None
    assert estimate.low is not None
    assert estimate.high is not None
    half = 1.96 * values.std(ddof=1) / math.sqrt(400)
    assert estimate.mean == pytest.approx(values.mean())
    assert estimate.low == pytest.approx(values.mean() - half, abs=0.1 * half)
    assert estimate.high == pytest.approx(values.mean() + half, abs=0.1 * half)


def test_it_holds_the_true_mean_nearly_as_often_as_it_says() -> None:
    """In 95 % of cases but for few values, where it is known to be a little too narrow."""
    rng = np.random.default_rng(0)
    hits = 0
    for _ in range(100):
        estimate = estimate_mean(rng.normal(3.0, 1.0, 12).tolist())
        assert estimate is not None
        assert estimate.low is not None
        assert estimate.high is not None
        hits += estimate.low <= 3.0 <= estimate.high
    assert 84 <= hits <= 99


def test_a_single_value_has_no_interval_and_none_no_mean() -> None:
    """What isn't known isn't made up."""
    assert estimate_mean([3.0]) == Estimate(3.0, None, None, 1)
    assert estimate_mean([]) is None


def test_equal_values_leave_no_doubt() -> None:
    """Their interval is a point."""
    assert estimate_mean([2.0] * 5) == Estimate(2.0, 2.0, 2.0, 5)


@given(st.lists(st.floats(-1e6, 1e6), min_size=2, max_size=6))
def test_the_interval_is_within_the_values(values: list[float]) -> None:
    """Whatever they are; and the same values have the same interval."""
    estimate = estimate_mean(values)
    assert estimate is not None
    assert estimate.low is not None
    assert estimate.high is not None
    rounding = 1e-9 * (max(values) - min(values)) + 1e-15 * abs(estimate.mean)
    assert min(values) - rounding <= estimate.low <= estimate.high <= max(values) + rounding
    assert estimate == estimate_mean(values)
