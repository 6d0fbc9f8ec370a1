"""Tests of ``tlcomm_tools.figures.schedule``."""

from matplotlib.patches import Rectangle

from tlcomm_tools.figures.schedule import schedule_figure
from tlcomm_tools.figures.trace import Trace


def test_each_span_of_the_stretch_is_a_bar(trace: Trace) -> None:
    """At its time, in its agent's row."""
    (axes,) = schedule_figure(trace, (0, 0)).axes
    bars = [own for own in axes.patches if isinstance(own, Rectangle)]
    shown = [own for spans in trace.spans.values() for own in spans if own.start_s < trace.period_s]
    assert len(bars) == len(shown)
    assert sorted(own.get_x() for own in bars) == sorted(own.start_s for own in shown)
    assert axes.get_xlim() == (0.0, trace.period_s)
    assert (axes.get_xlabel(), axes.get_ylabel()) == ("time (s)", "agent")
    assert [own.get_text() for own in axes.get_yticklabels()] == list("12345678")


def test_the_legend_says_what_bars_are(trace: Trace) -> None:
    """Actions by name, and no two look alike in grey: they differ in brightness or in hatching."""
    (legend,) = schedule_figure(trace).legends
    labels = [own.get_text() for own in legend.get_texts()]
    assert labels == ["collect", "unload", "measure", "wait", "meeting", "task satisfied"]
    patches = legend.get_patches()
    looks = {(own.get_hatch(), round(sum(own.get_facecolor()[:3]), 1)) for own in patches}
    assert len(looks) == len(patches)


def test_windows_are_marked_up_to_the_end(trace: Trace) -> None:
    """A window that was missed says so."""
    missed = trace.model_copy(update={"missed_rounds": (1,)})
    (axes,) = schedule_figure(missed).axes
    assert [own.get_text() for own in axes.texts] == ["window 0", "window 1 missed", "window 2"]
    assert axes.get_xlim() == (0.0, trace.end_s)


def test_who_does_not_promise_windows_misses_none(trace: Trace) -> None:
    """Pairs don't meet as a team."""
    pairs = trace.model_copy(update={"missed_rounds": (1,), "method": "pairwise"})
    (axes,) = schedule_figure(pairs).axes
    assert [own.get_text() for own in axes.texts] == ["window 0", "window 1", "window 2"]


def test_of_many_agents_the_first_are_shown(trace: Trace) -> None:
    """As many as a page has room for."""
    many = {f"agent_{n}": trace.spans["agent_1"] for n in range(1, 101)}
    crowded = trace.model_copy(update={"spans": many, "satisfied_s": dict.fromkeys(many, ())})
    (axes,) = schedule_figure(crowded).axes
    labels = [own.get_text() for own in axes.get_yticklabels()]
    assert labels == [str(number) for number in range(1, 25)]
