"""Tests of ``tlcomm_core.metrics.satisfaction``."""

import pytest

from support.hand_made_run import hand_made_records
from tlcomm_core.metrics.satisfaction import makespan_s, mean_cycle_s, satisfied_ns, tasks_per_hour

# After 10 s, 25 s and 31 s.
MOMENTS_NS = [10_000_000_000, 25_000_000_000, 31_000_000_000]


def test_satisfactions_are_an_agents_own() -> None:
    """East picks for a second at 4.5 s, and again at 14.5 s."""
    assert satisfied_ns("east", hand_made_records()) == [5_500_000_000, 15_500_000_000]
    assert satisfied_ns("nobody", hand_made_records()) == []


def test_the_makespan_is_the_longest_gap() -> None:
    """Gaps of 15 s and 6 s; the time before the first satisfaction is none."""
    assert makespan_s(MOMENTS_NS) == 15.0


def test_the_mean_cycle_is_the_mean_gap() -> None:
    """21 s in two passes."""
    assert mean_cycle_s(MOMENTS_NS) == 10.5


@pytest.mark.parametrize("count", [0, 1])
def test_a_gap_needs_two_satisfactions(count: int) -> None:
    """With fewer there is neither a makespan nor a cycle."""
    assert makespan_s(MOMENTS_NS[:count]) is None
    assert mean_cycle_s(MOMENTS_NS[:count]) is None


def test_tasks_per_hour_count_to_the_end() -> None:
    """Three in 40 s are 270 in an hour; a run of no length has no rate."""
    assert tasks_per_hour(3, 40.0) == pytest.approx(270.0)
    assert tasks_per_hour(0, 40.0) == 0.0
    assert tasks_per_hour(0, 0.0) is None
