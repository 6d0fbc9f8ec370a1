"""Tests of ``tlcomm_tools.figures.additional_time``."""

from tlcomm_tools.figures.additional_time import additional_time_figure
from tlcomm_tools.figures.trace import Trace


def test_each_method_that_meets_has_a_line(trace: Trace) -> None:
    """Round by round; the legend says its mean."""
    lone = trace.model_copy(update={"method": "none", "additional_times": ()})
    figure = additional_time_figure([trace, lone])
    (axes,) = figure.axes
    (line,) = axes.lines
    means_s = [own.mean_s for own in trace.additional_times]
    assert line.get_xydata().tolist() == [[1.0, means_s[0]], [2.0, means_s[1]]]
    (legend,) = figure.legends
    assert [own.get_text() for own in legend.get_texts()] == [
        f"team (mean {sum(means_s) / 2.0:.2f} s)"
    ]
    assert axes.get_xlabel() == "round"
    assert axes.get_ylabel() == "additional time per agent (s)"
    assert axes.get_ylim()[0] == 0.0
