"""The workspace with ways of some agents.

``workspace_figure``  the figure
"""

import math
from itertools import combinations, islice, starmap
from typing import Final

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from tlcomm_tools.figures.plan_view import draw_ground, height_in, width_in
from tlcomm_tools.figures.style import agent_labels, agent_line, new_figure
from tlcomm_tools.figures.trace import Trace

__all__ = ["workspace_figure"]

# More ways than these can't be told apart; they are of every second agent, as in the paper.
_MOST_WAYS: Final = 4
# By how much the ways are shifted against each other, as a share of a cell, so that they lie side
# by side where they lead through the same cells: along none of the directions that most have.
_SHIFT: Final = np.array([0.26, 0.11])
# What a number takes in a circle, and what beside the axes is taken by labels and legend.
_NUMBER_PT: Final = 8.5
_BESIDE_IN: Final = (0.5, 0.8)


def workspace_figure(trace: Trace) -> Figure:
    """Draw where agents start, and the ways of some until their tasks are first satisfied.

    The ways are those that were driven, with the meetings on them, each shifted a little so that
    none hides another. A marker is where a task was satisfied.
    """
    wide_in = width_in(trace.ground, len(trace.paths))
    axes_in = wide_in - _BESIDE_IN[0]
    figure = new_figure(wide_in, height_in(trace.ground, axes_in) + _BESIDE_IN[1])
    axes = figure.add_subplot()
    draw_ground(axes, trace.ground, named_in=axes_in)
    _draw_ways(axes, trace)
    _draw_starts(axes, trace, 72.0 * axes_in / trace.ground.size_m[0])
    figure.legend(loc="outside upper center", ncols=_MOST_WAYS, columnspacing=1.2)
    return figure


def _draw_ways(axes: Axes, trace: Trace) -> None:
    labels = agent_labels(tuple(trace.paths))
    shown = tuple(islice(trace.paths, 0, 2 * _MOST_WAYS, 2))
    middle = (len(shown) - 1) / 2.0
    for rank, name in enumerate(shown):
        end_s = next(iter(trace.satisfied_s[name]), trace.end_s)
        shift_m = trace.ground.cell_m * _SHIFT * (rank - middle)
        line = agent_line(rank)
        axes.plot(
            *(trace.paths[name].between(0.0, end_s) + shift_m).T,
            color=line.colour,
            linestyle=line.dashes,
            marker=line.marker,
            markevery=[-1],
            label=f"agent {labels[name]}",
        )


def _draw_starts(axes: Axes, trace: Trace, points_per_m: float) -> None:
    """Draw numbered circles, or dots where these would lie upon each other."""
    labels = agent_labels(tuple(trace.paths))
    starts_m = np.array([(own.x_m[0], own.y_m[0]) for own in trace.paths.values()])
    apart_m = min(starmap(math.dist, combinations(starts_m.tolist(), 2)), default=math.inf)
    has_room = apart_m * points_per_m > _NUMBER_PT
    axes.plot(
        *starts_m.T,
        "o",
        color="white",
        markeredgecolor="black",
        markeredgewidth=0.6,
        markersize=_NUMBER_PT if has_room else _NUMBER_PT / 2.0,
        zorder=3.0,
    )
    if has_room:
        for name, (x_m, y_m) in zip(trace.paths, starts_m.tolist(), strict=True):
            axes.text(
                x_m, y_m, labels[name], ha="center", va="center_baseline", fontsize=6, zorder=3.5
            )
