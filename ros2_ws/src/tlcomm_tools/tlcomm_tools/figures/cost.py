"""How the cost of a team strategy comes down, move by move.

``cost_figure``  the figure
"""

from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from tlcomm_tools.figures.style import COLUMN_IN, agent_line, new_figure
from tlcomm_tools.figures.trace import Trace

__all__ = ["cost_figure"]


def cost_figure(trace: Trace) -> Figure:
    """Draw Φ against the iteration of Algorithm 1, and where the run's solver ended, by round.

    Args:
        trace: a run with at least one course.
    """
    figure = new_figure(COLUMN_IN, 2.5)
    axes = figure.add_subplot()
    agreed_s = {own.round: own.agreed_s for own in trace.agreements}
    last = max(len(own.potentials_s) for own in trace.courses)
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
        axes.plot(
            last, agreed_s[course.round], line.marker, color="white", markeredgecolor=line.colour
        )
    axes.set_ylim(bottom=0.0)
    axes.xaxis.set_major_locator(MaxNLocator(integer=True))
    axes.grid(visible=True, axis="y")
    axes.set_xlabel("iteration k")
    axes.set_ylabel("potential Φ (s)")
    figure.legend(loc="outside upper center", ncols=4)
    return figure
