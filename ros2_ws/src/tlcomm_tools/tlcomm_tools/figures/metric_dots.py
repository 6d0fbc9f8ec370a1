"""The main metrics of several methods side by side, with what repetitions make sure.

``metric_dots_figure``  the figure
"""

import math
from collections.abc import Sequence
from typing import Final

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from tlcomm_tools.figures.metric_values import (
    MAIN_METRICS,
    Row,
    interval_of,
    methods_of,
    shown_metrics,
)
from tlcomm_tools.figures.style import PAGE_IN, method_line, new_figure

__all__ = ["metric_dots_figure"]

_COLUMNS: Final = 3


def metric_dots_figure(rows: Sequence[Row]) -> Figure:
    """Draw a panel for each metric: a dot per method at the mean, a bar for its 95 % interval.

    Args:
        rows: a run each; at least one has a metric.
    """
    metrics, methods = shown_metrics(rows), methods_of(rows)
    lines = math.ceil(len(metrics) / _COLUMNS)
    figure = new_figure(PAGE_IN, lines * (0.62 + 0.17 * len(methods)))
    panels = figure.subplots(lines, _COLUMNS, sharey=True, squeeze=False).flat
    for axes, metric in zip(panels, metrics, strict=False):
        _draw_metric(axes, rows, metric, methods)
    for axes in list(figure.axes)[len(metrics) :]:
        axes.set_axis_off()
    return figure


def _draw_metric(axes: Axes, rows: Sequence[Row], metric: str, methods: Sequence[str]) -> None:
    for rank, method in enumerate(methods):
        interval = interval_of([row for row in rows if row["method"] == method], metric)
        if interval is None:
            continue
        line = method_line(method)
        axes.errorbar(
            interval.mean,
            rank,
            xerr=[[interval.mean - interval.low], [interval.high - interval.mean]],
            color=line.colour,
            marker=line.marker,
            markeredgecolor="black",
            markeredgewidth=0.4,
            capsize=2.5,
            linewidth=1.2,
        )
    axes.set_yticks(range(len(methods)), methods)
    axes.set_ylim(len(methods) - 0.5, -0.5)
    axes.xaxis.set_major_locator(MaxNLocator(5))
    axes.margins(x=0.1)
    axes.grid(visible=True, axis="y")
    axes.tick_params(axis="y", length=0.0)
    axes.set_xlabel(MAIN_METRICS[metric])
