"""How the cost of a team strategy comes down, move by move.

``cost_figure``  the figure
"""

from typing import Final

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from tlcomm_tools.figures.style import COLUMN_IN, agent_line, new_figure
from tlcomm_tools.figures.trace import Trace

__all__ = ["cost_figure"]

_MOST_TICKS: Final = 8


def cost_figure(trace: Trace) -> Figure:
    """Draw Φ against the iteration of Algorithm 1 for each round that has a course.

    At the right is what the team agreed on: its solver may have proposed something better.

    Args:
        trace: a run with at least one course.
    """
    figure = new_figure(COLUMN_IN, 2.5)
    axes = figure.add_subplot()
    agreed_s = {own.round: own.agreed_s for own in trace.agreements}
    moves = max(len(own.potentials_s) for own in trace.courses) - 1
    for rank, course in enumerate(trace.courses):
        line = agent_line(rank)
        axes.plot(
            range(len(course.potentials_s)),
            course.potentials_s,
            color=line.colour,
            linestyle=line.dashes,
            marker=line.marker,
            label=f"r = {course.round}",
        )
        if course.round in agreed_s:
            axes.plot(
                moves + 2,
                agreed_s[course.round],
                line.marker,
                color="white",
                markeredgecolor=line.colour,
            )
    _set_ticks(axes, moves)
    axes.set_ylim(bottom=0.0)
    axes.grid(visible=True, axis="y")
    axes.set_xlabel("iteration k")
    axes.set_ylabel("potential Φ (s)")
    figure.legend(loc="outside upper center", ncols=4)
    return figure


def _set_ticks(axes: Axes, moves: int) -> None:
    """Number the iterations, and name what is beyond the last."""
    numbers = range(0, moves + 1, moves // _MOST_TICKS + 1)
    axes.set_xticks([*numbers, moves + 2], [*map(str, numbers), "agreed"])
    axes.axvline(moves + 1, color="#909090", linewidth=0.6)
