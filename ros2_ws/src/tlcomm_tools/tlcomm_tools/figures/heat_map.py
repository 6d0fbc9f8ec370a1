"""Where the team met, and how often.

``heat_map_figure``  the figure
"""

from collections import Counter
from typing import Final

import numpy as np
from matplotlib.collections import PatchCollection
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle
from matplotlib.ticker import MaxNLocator

from tlcomm_tools.figures.plan_view import draw_ground, height_in, width_in
from tlcomm_tools.figures.style import new_figure
from tlcomm_tools.figures.trace import Trace

__all__ = ["heat_map_figure"]

# What beside the axes is taken by labels and the scale; less height than they need, so that the
# axes are as high as the scale.
_BESIDE_IN: Final = (1.0, 0.35)


def heat_map_figure(trace: Trace) -> Figure:
    """Draw how often each cell was an agent's place at a meeting.

    Args:
        trace: a run in which somebody met.
    """
    ground = trace.ground
    wide_in = width_in(ground, 0)
    axes_in = wide_in - _BESIDE_IN[0]
    figure = new_figure(wide_in, height_in(ground, axes_in) + _BESIDE_IN[1])
    axes = figure.add_subplot()
    draw_ground(axes, ground, named_in=axes_in)
    counts = _counts(trace)
    cells_m = np.array(list(counts)) * ground.cell_m + ground.origin_m
    squares = [Rectangle(tuple(at), ground.cell_m, ground.cell_m) for at in cells_m.tolist()]
    # Edges, or else seams show between neighbours.
    heat = PatchCollection(squares, cmap="viridis_r", edgecolor="face", linewidth=0.2)
    heat.set_array(list(counts.values()))
    heat.set_clim(0.0)
    axes.add_collection(heat)
    bar = figure.colorbar(heat, ax=axes, pad=0.02, aspect=25.0)
    bar.set_label("times an agent met there")
    bar.ax.yaxis.set_major_locator(MaxNLocator(integer=True, steps=[1, 2, 5, 10]))
    return figure


def _counts(trace: Trace) -> Counter[tuple[int, int]]:
    """Return how often each cell (column, row from the lower left) was an agent's place."""
    ground = trace.ground
    places_m = np.array([place for own in trace.meetings for place in own.places_m.values()])
    cells = np.floor((places_m - ground.origin_m) / ground.cell_m).astype(np.int64)
    return Counter(map(tuple, cells.tolist()))
