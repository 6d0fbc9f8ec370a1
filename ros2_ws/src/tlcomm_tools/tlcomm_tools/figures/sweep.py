"""The measures of several methods against what is varied.

``sweep_figure``  the figure
"""

import math
from collections.abc import Sequence
from typing import Final

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from tlcomm_tools.figures.measured import Mark, Measured
from tlcomm_tools.figures.style import PAGE_IN, method_line, new_figure, show_large_numbers

__all__ = ["sweep_figure"]

_COLUMNS: Final = 3


def sweep_figure(measures: Sequence[Measured], label: str) -> Figure:
    """Draw a panel for each measure: a line per method through its means, with 95 % intervals.

    Args:
        measures: at least one, of runs in which something is varied.
        label: of what is varied, with its unit.
    """
    lines = math.ceil(len(measures) / _COLUMNS)
    figure = new_figure(PAGE_IN, 0.5 + 1.6 * lines)
    panels = figure.subplots(lines, _COLUMNS, sharex=True, squeeze=False).flat
    for axes, measure in zip(panels, measures, strict=False):
        _draw_measure(axes, measure)
    for axes in figure.axes[len(measures) :]:
        axes.set_axis_off()
    # What is lowest in its column, also above an empty place.
    for axes in figure.axes[max(len(measures) - _COLUMNS, 0) : len(measures)]:
        axes.tick_params(axis="x", labelbottom=True)
    figure.supxlabel(label, fontsize=8.0)
    _add_legend(figure, tuple(measures[0].marks))
    return figure


def _draw_measure(axes: Axes, measure: Measured) -> None:
    for method, marks in measure.marks.items():
        if marks:
            _draw_method(axes, method, marks)
    # Above the axis, where it has room to be read.
    axes.set_title(measure.label, loc="left", fontsize=8.0)
    show_large_numbers(axes.yaxis)
    axes.grid(visible=True, axis="y")


def _draw_method(axes: Axes, method: str, marks: Sequence[Mark]) -> None:
    line = method_line(method)
    axes.errorbar(
        np.array([mark.value for mark in marks], dtype=np.float64),
        [mark.mean for mark in marks],
        yerr=[[mark.below for mark in marks], [mark.above for mark in marks]],
        color=line.colour,
        linestyle=line.dashes,
        marker=line.marker,
        capsize=2.0,
        label=method,
    )


def _add_legend(figure: Figure, methods: Sequence[str]) -> None:
    """Name each line once, whichever panels it is in."""
    found = {
        name: handle
        for axes in figure.axes
        for handle, name in zip(*axes.get_legend_handles_labels(), strict=True)
    }
    handles = [found[method] for method in methods if method in found]
    figure.legend(handles=handles, loc="outside upper center", ncols=len(handles))
