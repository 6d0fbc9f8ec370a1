"""All figures of a run, of several methods, of a sweep: each as SVG and as PNG.

``draw_run``         of one run
``draw_comparison``  of runs of the same scenario by several methods
"""

from collections.abc import Sequence
from pathlib import Path

from tlcomm_tools.figures.additional_time import additional_time_figure
from tlcomm_tools.figures.cost import cost_figure
from tlcomm_tools.figures.estimates import estimates_figure
from tlcomm_tools.figures.heat_map import heat_map_figure
from tlcomm_tools.figures.schedule import schedule_figure
from tlcomm_tools.figures.style import save, styled
from tlcomm_tools.figures.topologies import topologies_figure
from tlcomm_tools.figures.trace import Trace
from tlcomm_tools.figures.workspace import workspace_figure

__all__ = ["draw_comparison", "draw_run"]


def draw_run(trace: Trace, folder: Path) -> tuple[Path, ...]:
    """Draw a run: workspace, topologies, places of meetings, schedule, additional time, cost.

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
        return tuple(
            path for name, figure in figures.items() for path in save(figure, folder, name)
        )


def draw_comparison(traces: Sequence[Trace], folder: Path) -> tuple[Path, ...]:
    """Draw runs by several methods: additional time of each round, estimates of the field.

    Args:
        traces: one for each method.
        folder: that exists.

    Returns:
        The files written.

    Raises:
        OSError: a file can't be written.
    """
    with styled():
        figures = {}
        if any(trace.additional_times for trace in traces):
            figures["additional_time"] = additional_time_figure(traces)
        if any(trace.field and trace.estimates for trace in traces):
            figures["estimates"] = estimates_figure(traces)
        return tuple(
            path for name, figure in figures.items() for path in save(figure, folder, name)
        )
