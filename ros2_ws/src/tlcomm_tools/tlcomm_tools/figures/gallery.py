"""All figures of a run, of several methods, of a sweep: each as SVG and as PNG.

``draw_run``         of one run
``draw_comparison``  of runs of the same scenario by several methods
``draw_sweep``       of such runs with something varied
"""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from matplotlib.figure import Figure

from tlcomm_tools.figures.additional_time import additional_time_figure
from tlcomm_tools.figures.cost import cost_figure
from tlcomm_tools.figures.estimates import estimates_figure
from tlcomm_tools.figures.heat_map import heat_map_figure
from tlcomm_tools.figures.measured import measured
from tlcomm_tools.figures.metric_dots import metric_dots_figure
from tlcomm_tools.figures.schedule import schedule_figure
from tlcomm_tools.figures.style import in_order, save, styled
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
    traces: Sequence[Trace], folder: Path, found: Mapping[str, Any] | None = None
) -> tuple[Path, ...]:
    """Draw runs by several methods: additional time of each round, estimates, and the measures.

    Args:
        traces: one for each method.
        folder: that exists.
        found: the comparison's document, in which nothing is varied; ``None`` without measures.

    Returns:
        The files written.

    Raises:
        OSError: a file can't be written.
    """
    rank = in_order({trace.method for trace in traces}).index
    shown = sorted(traces, key=lambda trace: rank(trace.method))
    measures = () if found is None else measured(found)
    with styled():
        figures = {}
        if any(trace.additional_times for trace in shown):
            figures["additional_time"] = additional_time_figure(shown)
        if any(trace.estimates for trace in shown):
            figures["estimates"] = estimates_figure(shown)
        if measures:
            figures["metrics"] = metric_dots_figure(measures)
        return _written(figures, folder)


def draw_sweep(found: Mapping[str, Any], folder: Path, label: str) -> tuple[Path, ...]:
    """Draw the measures against what is varied.

    Args:
        found: the comparison's document.
        folder: that exists.
        label: of what is varied, with its unit.

    Returns:
        The files written; none if nothing was measured.

    Raises:
        OSError: a file can't be written.
    """
    measures = measured(found)
    if not measures:
        return ()
    with styled():
        figures = {f"sweep_{found['sweep']['name']}": sweep_figure(measures, label)}
        return _written(figures, folder)


def _written(figures: Mapping[str, Figure], folder: Path) -> tuple[Path, ...]:
    return tuple(path for name, figure in figures.items() for path in save(figure, folder, name))
