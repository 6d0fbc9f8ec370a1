"""Tests of ``tlcomm_tools.figures.sweep``."""

from tlcomm_tools.figures.measured import Mark, Measured
from tlcomm_tools.figures.sweep import sweep_figure

MEASURES = (
    Measured("wait (s)", {"team": (Mark(1.0, 5.0, 1.0, 2.0), Mark(2.0, 3.0, 0, 0)), "none": ()}),
    Measured("way (m)", {"team": (), "none": (Mark(1.0, 7.0, 0, 0), Mark(2.0, 8.0, 0, 0))}),
)


def test_a_line_goes_through_the_means() -> None:
    """A panel for each measure, a line for each method that has it, with its intervals."""
    figure = sweep_figure(MEASURES, "radio range R (m)")
    first, second = figure.axes[:2]
    line, low, high = first.lines
    assert line.get_xydata().tolist() == [[1.0, 5.0], [2.0, 3.0]]
    assert low.get_ydata().tolist() == [4.0, 3.0]
    assert high.get_ydata().tolist() == [7.0, 3.0]
    assert second.lines[0].get_xydata().tolist() == [[1.0, 7.0], [2.0, 8.0]]
    assert [axes.get_title(loc="left") for axes in figure.axes[:2]] == ["wait (s)", "way (m)"]
    assert figure.get_supxlabel() == "radio range R (m)"


def test_the_lowest_panel_of_each_column_is_numbered() -> None:
    """Also where the last row is short."""
    panels = sweep_figure([*MEASURES, *MEASURES], "R").axes
    numbered = [axes.xaxis.get_tick_params()["labelbottom"] for axes in panels[: 2 * len(MEASURES)]]
    assert numbered == [False, True, True, True]
    assert [axes.axison for axes in panels] == [True] * 4 + [False] * 2


def test_the_legend_names_every_method_once() -> None:
    """Also one that the first panel lacks."""
    (legend,) = sweep_figure(MEASURES, "R").legends
    assert [own.get_text() for own in legend.get_texts()] == ["team", "none"]
