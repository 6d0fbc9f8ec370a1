"""Where the team met, and how often.

``heat_map_figure``  the figure
"""

import numpy as np
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator
from numpy.typing import NDArray

from tlcomm_tools.figures.plan_view import draw_ground
from tlcomm_tools.figures.style import COLUMN_IN, new_figure
from tlcomm_tools.figures.trace import Trace

__all__ = ["heat_map_figure"]


def heat_map_figure(trace: Trace) -> Figure:
    """Draw in how many meetings each cell was an agent's place.

    Args:
        trace: a run in which somebody met.
    """
    counts = _counts(trace)
    (left_m, bottom_m), cell_m = trace.ground.origin_m, trace.ground.cell_m
    x_edges_m = left_m + cell_m * np.arange(counts.shape[1] + 1)
    y_edges_m = bottom_m + cell_m * np.arange(counts.shape[0] + 1)
    figure = new_figure(COLUMN_IN, 3.0)
    axes = figure.add_subplot()
    draw_ground(axes, trace.ground)
    shown = np.where(counts > 0, counts, np.nan)
    mesh = axes.pcolormesh(x_edges_m, y_edges_m, shown, cmap="viridis_r", vmin=0.0)
    bar = figure.colorbar(mesh, ax=axes, shrink=0.85, pad=0.02)
    bar.set_label("times an agent met there")
    bar.ax.yaxis.set_major_locator(MaxNLocator(integer=True))
    return figure


def _counts(trace: Trace) -> NDArray[np.int64]:
    """Return [rows, columns] how often each cell was an agent's place, from the lower left on."""
    ground = trace.ground
    shape = [round(size_m / ground.cell_m) for size_m in ground.size_m]
    places_m = np.array([place for own in trace.meetings for place in own.places_m.values()])
    cells = np.floor((places_m - ground.origin_m) / ground.cell_m).astype(np.int64)
    columns, rows = np.clip(cells, 0, np.array(shape) - 1).T
    counts = np.zeros(shape[::-1], dtype=np.int64)
    np.add.at(counts, (rows, columns), 1)
    return counts
