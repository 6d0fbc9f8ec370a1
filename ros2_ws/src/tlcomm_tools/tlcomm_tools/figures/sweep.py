"""The main metrics against what is varied, for each method.

``sweep_figure``  the figure
"""

import math
from collections.abc import Sequence
from typing import Final

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from tlcomm_tools.figures.metric_values import (
    MAIN_METRICS,
    Row,
    interval_of,
    methods_of,
    shown_metrics,
)
from tlcomm_tools.figures.style import PAGE_IN, method_line, new_figure

__all__ = ["sweep_figure"]

_COLUMNS: Final = 3


def sweep_figure(rows: Sequence[Row], swept: str, label: str) -> Figure:
    """Draw a panel for each metric: a line per method through its means, with 95 % intervals.

    Args:
        rows: a run each; at least one has a metric.
        swept: column of what is varied.
        label: of its axis, with the unit.
    """
    metrics = shown_metrics(rows)
    lines = math.ceil(len(metrics) / _COLUMNS)
    figure = new_figure(PAGE_IN, 0.35 + 1.65 * lines)
    panels = figure.subplots(lines, _COLUMNS, sharex=True, squeeze=False)
    for axes, metric in zip(panels.flat, metrics, strict=False):
        for method in methods_of(rows):
            own = [row for row in rows if row["method"] == method]
            _draw_method(axes, own, metric, swept)
        axes.set_ylabel(MAIN_METRICS[metric])
        axes.grid(visible=True, axis="y")
    for axes in panels.flat[len(metrics) :]:
        axes.set_axis_off()
    figure.align_ylabels()
    figure.supxlabel(label, fontsize=8.0)
    _add_legend(figure)
    return figure


def _add_legend(figure: Figure) -> None:
    """Name each line once, whichever panels it is in."""
    named = [
        pair for axes in figure.axes for pair in zip(*axes.get_legend_handles_labels(), strict=True)
    ]
    handles = {name: handle for handle, name in named}
    figure.legend(handles=list(handles.values()), loc="outside upper center", ncols=len(handles))


def _draw_method(axes: Axes, rows: Sequence[Row], metric: str, swept: str) -> None:
    values = sorted({value for row in rows if isinstance(value := row[swept], int | float)})
    points = [
        (value, interval_of([row for row in rows if row[swept] == value], metric))
        for value in values
    ]
    found = [(value, interval) for value, interval in points if interval is not None]
    if not found:
        return
    line = method_line(str(rows[0]["method"]))
    axes.errorbar(
        [value for value, _ in found],
        [interval.mean for _, interval in found],
        yerr=[
            [interval.mean - interval.low for _, interval in found],
            [interval.high - interval.mean for _, interval in found],
        ],
        color=line.colour,
        linestyle=line.dashes,
        marker=line.marker,
        capsize=2.0,
        label=str(rows[0]["method"]),
    )
