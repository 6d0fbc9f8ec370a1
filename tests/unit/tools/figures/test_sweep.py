"""Tests of ``tlcomm_tools.figures.sweep``."""

from tlcomm_tools.figures.metric_values import MAIN_METRICS, Row
from tlcomm_tools.figures.sweep import sweep_figure

FIRST, SECOND = list(MAIN_METRICS)[:2]
ROWS: list[Row] = [
    {"method": method, "seed": seed, "range": range_m, metric: range_m * (seed + 1)}
    for method, metric in (("team", FIRST), ("none", SECOND))
    for seed in (0, 1)
    for range_m in (2.0, 1.0)
]


def test_a_line_goes_through_the_means_in_order_of_what_is_varied() -> None:
    """A panel for each metric, a line for each method that has it."""
    figure = sweep_figure(ROWS, "range", "radio range R (m)")
    first, second = figure.axes[:2]
    assert first.lines[0].get_xydata().tolist() == [[1.0, 1.5], [2.0, 3.0]]
    assert (first.get_ylabel(), second.get_ylabel()) == (MAIN_METRICS[FIRST], MAIN_METRICS[SECOND])
    assert [len(axes.containers) for axes in (first, second)] == [1, 1]
    assert figure.get_supxlabel() == "radio range R (m)"


def test_the_legend_names_every_method_once() -> None:
    """Also one that the first panel lacks."""
    (legend,) = sweep_figure(ROWS, "range", "R").legends
    assert [own.get_text() for own in legend.get_texts()] == ["team", "none"]
