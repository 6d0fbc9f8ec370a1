"""What agents took the field for, and by how much they were off.

``estimates_figure``  the figure
"""

from collections.abc import Sequence
from typing import Final

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray

from tlcomm_tools.figures.elements import Profile
from tlcomm_tools.figures.style import COLUMN_IN, method_line, new_figure
from tlcomm_tools.figures.trace import Trace

__all__ = ["estimates_figure"]

# More than there are dots across a column.
_SAMPLES: Final = 1000


def estimates_figure(traces: Sequence[Trace]) -> Figure:
    """Draw the agents' estimates against ν(t), and below it by how much they are off.

    A line is the mean over the agents that have an estimate; the band around it reaches from the
    lowest to the highest.

    Args:
        traces: one for each method, all of the same field; at least one has a field.
    """
    figure = new_figure(COLUMN_IN, 4.0)
    above, below = figure.subplots(2, 1, sharex=True)
    field = next(own.field for own in traces if own.field is not None)
    times_s = np.linspace(0.0, max(own.end_s for own in traces), _SAMPLES)
    for trace in traces:
        if trace.estimates:
            _draw_method(above, below, trace, field, times_s)
    above.plot(
        times_s, field.at(times_s), color="black", linestyle=":", linewidth=1.6, label="true ν(t)"
    )
    below.axhline(0.0, color="black", linestyle=":", linewidth=1.6)
    above.set_ylabel("estimate of ν (–)")
    below.set_ylabel("deviation from ν (–)")
    below.set_xlabel("time (s)")
    below.set_xlim(0.0, times_s[-1])
    figure.legend(loc="outside upper center", ncols=3)
    return figure


def _draw_method(
    above: Axes, below: Axes, trace: Trace, field: Profile, times_s: NDArray[np.float64]
) -> None:
    values = np.array([own.at(times_s) for own in trace.estimates.values()])
    is_known = ~np.isnan(values).all(axis=0) & (times_s <= trace.end_s)
    known_s, values = times_s[is_known], values[:, is_known]
    line = method_line(trace.method)
    for axes, truth in ((above, 0.0), (below, field.at(known_s))):
        axes.fill_between(
            known_s,
            np.nanmin(values - truth, axis=0),
            np.nanmax(values - truth, axis=0),
            color=line.colour,
            alpha=0.18,
            linewidth=0.0,
        )
        axes.plot(
            known_s,
            np.nanmean(values - truth, axis=0),
            color=line.colour,
            linestyle=line.dashes,
            label=trace.method if axes is above else None,
        )
