"""Tests of ``tlcomm_core.windows``."""

import pytest

from tlcomm_core.windows import Window, judge_windows

S = 1_000_000_000


def judge(*intervals_s: tuple[float, float], end_s: float) -> list[tuple[int, float, bool]]:
    """Judge windows of 10 s in which 2 s are wanted."""
    windows = judge_windows(
        [(round(a * S), round(b * S)) for a, b in intervals_s], 10.0, 2.0, round(end_s * S)
    )
    return [(own.round, own.longest_ns / S, own.satisfied) for own in windows]


def test_enough_connection_inside_satisfies() -> None:
    """D_c of connection inside a window satisfies it; the longest counts, not the sum."""
    assert judge((1.0, 2.5), (4.0, 6.0), end_s=10.0) == [(0, 2.0, True)]
    assert judge((1.0, 2.5), (4.0, 5.5), end_s=10.0) == [(0, 1.5, False)]


def test_a_connection_may_run_over_the_windows_end() -> None:
    """It must begin in the window; D_c may end after it."""
    assert judge((9.5, 11.5), end_s=20.0) == [(0, 2.0, True), (1, 1.5, False)]


def test_only_the_part_from_the_windows_begin_counts() -> None:
    """What came before the window isn't the window's."""
    assert judge((5.0, 11.0), end_s=20.0) == [(0, 6.0, True), (1, 1.0, False)]


def test_an_open_window_is_not_judged() -> None:
    """A window that isn't over counts only when it is satisfied already."""
    assert judge((0.0, 3.0), end_s=15.0) == [(0, 3.0, True)]
    assert judge((0.0, 3.0), (12.0, 14.0), end_s=15.0) == [(0, 3.0, True), (1, 2.0, True)]


def test_a_connection_that_goes_on_is_not_judged() -> None:
    """A window whose connection is cut by the end of the run alone is undecided."""
    assert judge((9.5, 10.5), end_s=10.5) == []


def test_the_end_at_a_boundary_opens_no_window() -> None:
    """A run that ends when a window opens says nothing about that window."""
    assert judge((0.0, 3.0), end_s=10.0) == [(0, 3.0, True)]


@pytest.mark.parametrize(("short_ns", "satisfied"), [(1_000, True), (1_001, False)])
def test_a_microsecond_is_forgiven(short_ns: int, satisfied: bool) -> None:
    """Rounding may cost a microsecond of D_c and no more."""
    windows = judge_windows([(0, 2 * S - short_ns)], 10.0, 2.0, 10 * S)
    assert windows == (Window(0, 2 * S - short_ns, satisfied),)
