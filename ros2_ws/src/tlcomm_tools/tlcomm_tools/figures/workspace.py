"""The workspace with ways of some agents.

``workspace_figure``  the figure
"""

from itertools import islice
from typing import Final

import numpy as np
from matplotlib.figure import Figure

from tlcomm_tools.figures.plan_view import draw_ground
from tlcomm_tools.figures.style import COLUMN_IN, agent_labels, agent_line, new_figure
from tlcomm_tools.figures.trace import Trace

__all__ = ["workspace_figure"]

# More ways than these can't be told apart; they are of every second agent, as in the paper.
_MOST_WAYS: Final = 4
# By how much the ways are shifted against each other, so that they lie side by side where they lead
# through the same cells: along none of the directions that most ways have.
_SHIFT_M: Final = np.array([0.13, 0.055])


def workspace_figure(trace: Trace) -> Figure:
    """Draw where agents start, and the ways of some until their tasks are first satisfied.

    The ways are those that were driven, with the meetings on them, each shifted a little so that
    none hides another. A marker is where a task was satisfied.
    """
    figure = new_figure(COLUMN_IN, 3.75)
    axes = figure.add_subplot()
    draw_ground(axes, trace.ground)
    labels = agent_labels(tuple(trace.paths))
    shown = tuple(islice(trace.paths, 0, 2 * _MOST_WAYS, 2))
    middle = (len(shown) - 1) / 2.0
    for rank, name in enumerate(shown):
        end_s = next(iter(trace.satisfied_s[name]), trace.end_s)
        x_m, y_m = (trace.paths[name].between(0.0, end_s) + _SHIFT_M * (rank - middle)).T
        line = agent_line(rank)
        axes.plot(
            x_m,
            y_m,
            color=line.colour,
            linestyle=line.dashes,
            marker=line.marker,
            markevery=[-1],
            label=f"agent {labels[name]}",
        )
    starts_m = np.array([(own.x_m[0], own.y_m[0]) for own in trace.paths.values()])
    axes.plot(
        *starts_m.T,
        "o",
        color="white",
        markeredgecolor="black",
        markeredgewidth=0.6,
        markersize=8.5,
        zorder=3.0,
    )
    for name, (x_m, y_m) in zip(trace.paths, starts_m.tolist(), strict=True):
        axes.text(x_m, y_m, labels[name], ha="center", va="center_baseline", fontsize=6, zorder=3.5)
    figure.legend(loc="outside upper center", ncols=_MOST_WAYS, columnspacing=1.2)
    return figure
