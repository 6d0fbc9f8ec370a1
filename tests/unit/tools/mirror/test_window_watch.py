"""Tests of ``tlcomm_tools.mirror.window_watch``."""

from tlcomm_core.units import nanoseconds
from tlcomm_core.windows import judge_windows
from tlcomm_tools.mirror.window_watch import WindowWatch


def watch(*changes_s: float, now_s: float) -> WindowWatch:
    """Return a watch of windows of 10 s, after the team was linked and parted by turns."""
    own = WindowWatch(nanoseconds(10.0), nanoseconds(2.0))
    for number, time_s in enumerate(changes_s):
        own.observe(nanoseconds(time_s), connected=number % 2 == 0)
    own.advance(nanoseconds(now_s))
    return own


def test_a_window_is_kept_once_the_connection_is_long_enough() -> None:
    """After D_c, not before."""
    assert not watch(3.0, now_s=4.9).is_kept(0)
    assert watch(3.0, now_s=5.0).is_kept(0)
    assert watch(3.0, 5.0, now_s=9.0).is_kept(0)


def test_a_window_without_a_connection_is_missed_when_it_is_over() -> None:
    """Not while it goes on, and each once."""
    assert watch(0.0, 2.0, now_s=19.9).missed == 0
    assert watch(0.0, 2.0, now_s=25.0).missed == 1
    assert watch(0.0, 2.0, now_s=35.0).missed == 2


def test_a_connection_that_began_in_time_may_outlast_its_window() -> None:
    """It counts for the window that it began in, as it does at the end of a run."""
    assert watch(9.0, now_s=10.5).missed == 0
    assert watch(9.0, 11.0, now_s=12.0).missed == 0
    assert watch(9.0, 10.5, now_s=12.0).missed == 1


def test_it_counts_as_the_run_is_judged() -> None:
    """For connections of all lengths the missed windows are those of ``judge_windows``."""
    spans_s = [(1.0, 4.0), (19.0, 21.5), (28.5, 30.0), (44.0, 63.0)]
    own = watch(*(time_s for span_s in spans_s for time_s in span_s), now_s=90.0)
    spans_ns = [(nanoseconds(begin_s), nanoseconds(end_s)) for begin_s, end_s in spans_s]
    judged = judge_windows(spans_ns, 10.0, 2.0, nanoseconds(90.0))
    assert own.missed == sum(not window.satisfied for window in judged) > 0
