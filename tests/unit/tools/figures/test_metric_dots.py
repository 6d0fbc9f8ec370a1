"""Tests of ``tlcomm_tools.figures.metric_dots`` and ``metric_values``."""

from tlcomm_tools.figures.metric_dots import metric_dots_figure
from tlcomm_tools.figures.metric_values import MAIN_METRICS, Row

FIRST, SECOND = list(MAIN_METRICS)[:2]
ROWS: list[Row] = [
    {"method": "team", "seed": 0, FIRST: 1.0, SECOND: 10.0, "unknown": 1.0},
    {"method": "team", "seed": 1, FIRST: 3.0, SECOND: None, "unknown": 1.0},
    {"method": "none", "seed": 0, FIRST: None, SECOND: 20.0, "unknown": 1.0},
]


def test_each_main_metric_that_is_known_has_a_panel() -> None:
    """With its name and unit; methods are named at the left."""
    figure = metric_dots_figure(ROWS)
    panels = [axes for axes in figure.axes if axes.axison]
    assert [axes.get_xlabel() for axes in panels] == [MAIN_METRICS[FIRST], MAIN_METRICS[SECOND]]
    assert [own.get_text() for own in panels[0].get_yticklabels()] == ["team", "none"]


def test_a_dot_is_the_mean_over_seeds_and_a_bar_its_interval() -> None:
    """A method without the metric has neither; runs without it don't count."""
    figure = metric_dots_figure(ROWS)
    first, second = figure.axes[:2]
    (mean, *caps) = first.lines
    assert mean.get_xydata().tolist() == [[2.0, 0.0]]
    assert [cap.get_xdata()[0] for cap in caps] == [1.0, 3.0]
    assert [line.get_xydata().tolist()[0] for line in second.lines[::3]] == [[10.0, 0], [20.0, 1]]
