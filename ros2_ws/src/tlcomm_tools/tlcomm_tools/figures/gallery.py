"""All figures of a run, of several methods, of a sweep: each as SVG and as PNG.

``draw_run``         of one run
``draw_comparison``  of runs of the same scenario by several methods
``draw_sweep``       of such runs with something varied
"""

from collections.abc import Mapping, Sequence
from pathlib import Path

from matplotlib.figure import Figure

from tlcomm_tools.figures.additional_time import additional_time_figure
from tlcomm_tools.figures.cost import cost_figure
from tlcomm_tools.figures.estimates import estimates_figure
from tlcomm_tools.figures.heat_map import heat_map_figure
from tlcomm_tools.figures.metric_dots import metric_dots_figure
from tlcomm_tools.figures.metric_values import Row, shown_metrics
from tlcomm_tools.figures.schedule import schedule_figure
from tlcomm_tools.figures.style import save, styled
from tlcomm_tools.figures.sweep import sweep_figure
from tlcomm_tools.figures.topologies import topologies_figure
from tlcomm_tools.figures.trace import Trace
from tlcomm_tools.figures.workspace import workspace_figure

__all__ = ["draw_comparison", "draw_run", "draw_sweep"]


def draw_run(trace: Trace, folder: Path) -> tuple[Path, ...]:
    """Draw a run: workspace, schedule, topologies, places of meetings, cost.

    What the trace doesn't have isn't drawn: places if nobody met, cost without courses.

    Args:
        trace: the run.
        folder: that exists.

    Returns:
        The files written.

    Raises:
        OSError: a file can't be written.
    """
    with styled():
        figures = {"workspace": workspace_figure(trace), "schedule": schedule_figure(trace)}
        if trace.meetings:
            figures["topologies"] = topologies_figure(trace)
            figures["meeting_places"] = heat_map_figure(trace)
        if trace.courses:
            figures["cost"] = cost_figure(trace)
        return _written(figures, folder)


def draw_comparison(
    traces: Sequence[Trace], folder: Path, rows: Sequence[Row] = ()
) -> tuple[Path, ...]:
    """Draw runs by several methods: additional time of each round, estimates, and the metrics.

    Args:
        traces: one for each method.
        folder: that exists.
        rows: all runs by these methods, with their metrics; intervals are over the seeds.

    Returns:
        The files written.

    Raises:
        OSError: a file can't be written.
    """
    with styled():
        figures = {}
        if any(trace.additional_times for trace in traces):
            figures["additional_time"] = additional_time_figure(traces)
        if any(trace.field is not None and trace.estimates for trace in traces):
            figures["estimates"] = estimates_figure(traces)
        if shown_metrics(rows):
            figures["metrics"] = metric_dots_figure(rows)
        return _written(figures, folder)


def draw_sweep(rows: Sequence[Row], folder: Path, swept: str, label: str) -> tuple[Path, ...]:
    """Draw the metrics against what is varied.

    Args:
        rows: all runs, with their metrics; intervals are over the seeds.
        folder: that exists.
        swept: column of what is varied.
        label: what it is called, with its unit.

    Returns:
        The files written; none if no row has a metric.

    Raises:
        OSError: a file can't be written.
    """
    with styled():
        figures = (
            {f"sweep_{swept}": sweep_figure(rows, swept, label)} if shown_metrics(rows) else {}
        )
        return _written(figures, folder)


def _written(figures: Mapping[str, Figure], folder: Path) -> tuple[Path, ...]:
    return tuple(path for name, figure in figures.items() for path in save(figure, folder, name))
