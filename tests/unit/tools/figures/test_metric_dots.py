"""Tests of ``tlcomm_tools.figures.metric_dots``."""

from tlcomm_tools.figures.measured import Mark, Measured
from tlcomm_tools.figures.metric_dots import metric_dots_figure

MEASURES = (
    Measured("wait (s)", {"team": (Mark(None, 2.0, 0.5, 1.0),), "none": ()}),
    Measured("way (m)", {"team": (Mark(None, 10.0, 0, 0),), "none": (Mark(None, 20.0, 0, 0),)}),
)


def test_each_measure_has_a_panel() -> None:
    """With its name and unit; methods are named at the left."""
    panels = [axes for axes in metric_dots_figure(MEASURES).axes if axes.axison]
    assert [axes.get_xlabel() for axes in panels] == ["wait (s)", "way (m)"]
    assert [own.get_text() for own in panels[0].get_yticklabels()] == ["team", "none"]


def test_a_dot_is_a_mean_and_a_bar_its_interval() -> None:
    """Each method's in its own line; a method without the measure has neither."""
    first, second = metric_dots_figure(MEASURES).axes[:2]
    mean, *caps = first.lines
    assert mean.get_xydata().tolist() == [[2.0, 0.0]]
    assert [cap.get_xdata()[0] for cap in caps] == [1.5, 3.0]
    assert [line.get_xydata()[0].tolist() for line in second.lines[::3]] == [[10.0, 0], [20.0, 1]]
