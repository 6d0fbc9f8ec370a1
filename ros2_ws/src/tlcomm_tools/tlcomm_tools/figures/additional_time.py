"""What meetings cost, round by round, with each method.

``additional_time_figure``  the figure
"""

from collections.abc import Sequence
from statistics import fmean

from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from tlcomm_tools.figures.style import COLUMN_IN, method_line, new_figure
from tlcomm_tools.figures.trace import Trace

__all__ = ["additional_time_figure"]


def additional_time_figure(traces: Sequence[Trace]) -> Figure:
    """Draw the additional time per agent of each round, and say its mean over rounds.

    Args:
        traces: one for each method; those without any such time aren't drawn.
    """
    figure = new_figure(COLUMN_IN, 2.4)
    axes = figure.add_subplot()
    for trace in traces:
        if not trace.additional_times:
            continue
        rounds = [own.round for own in trace.additional_times]
        means_s = [own.mean_s for own in trace.additional_times]
        line = method_line(trace.method)
        axes.plot(
            rounds,
            means_s,
            color=line.colour,
            linestyle=line.dashes,
            marker=line.marker,
            markevery=max(len(rounds) // 8, 1),
            linewidth=1.0,
            label=f"{trace.method} (mean {fmean(means_s):.2f} s)",
        )
    axes.set_ylim(bottom=0.0)
    axes.xaxis.set_major_locator(MaxNLocator(integer=True, steps=[1, 2, 5, 10]))
    axes.grid(visible=True, axis="y")
    axes.set_xlabel("round")
    axes.set_ylabel("additional time per agent (s)")
    figure.legend(loc="outside upper center", ncols=2)
    return figure
