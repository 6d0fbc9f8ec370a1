"""The measures of several methods side by side, with what repetitions make sure.

``metric_dots_figure``  the figure
"""

import math
from collections.abc import Sequence
from typing import Final

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from tlcomm_tools.figures.measured import Measured
from tlcomm_tools.figures.style import PAGE_IN, method_line, new_figure, show_large_numbers

__all__ = ["metric_dots_figure"]

_COLUMNS: Final = 3


def metric_dots_figure(measures: Sequence[Measured]) -> Figure:
    """Draw a panel for each measure: a dot per method at the mean, a bar for its 95 % interval.

    Args:
        measures: at least one, of runs in which nothing is varied.
    """
    methods = tuple(measures[0].marks)
    lines = math.ceil(len(measures) / _COLUMNS)
    figure = new_figure(PAGE_IN, lines * (0.62 + 0.17 * len(methods)))
    panels = figure.subplots(lines, _COLUMNS, sharey=True, squeeze=False)
    for axes, measure in zip(panels.flat, measures, strict=False):
        _draw_measure(axes, measure)
    for axes in panels.flat[len(measures) :]:
        axes.set_axis_off()
    return figure


def _draw_measure(axes: Axes, measure: Measured) -> None:
    for rank, (method, marks) in enumerate(measure.marks.items()):
        line = method_line(method)
        for mark in marks:
            axes.errorbar(
                mark.mean,
                rank,
                xerr=[[mark.below], [mark.above]],
                color=line.colour,
                marker=line.marker,
                markeredgecolor="black",
                markeredgewidth=0.4,
                capsize=2.5,
                linewidth=1.2,
            )
    methods = tuple(measure.marks)
    axes.set_yticks(range(len(methods)), methods)
    axes.set_ylim(len(methods) - 0.5, -0.5)
    axes.xaxis.set_major_locator(MaxNLocator(4, steps=[1, 2, 5, 10]))
    axes.margins(x=0.1)
    show_large_numbers(axes.xaxis)
    axes.grid(visible=True, axis="y")
    axes.tick_params(axis="y", length=0.0)
    axes.set_xlabel(measure.label)
