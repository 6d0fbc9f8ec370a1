"""What agents took the field for, and by how much they were off.

``estimates_figure``  the figure
"""

from collections.abc import Sequence
from typing import Final

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator
from numpy.typing import NDArray

from tlcomm_tools.figures.elements import Profile
from tlcomm_tools.figures.style import PAGE_IN, LineStyle, method_line, new_figure
from tlcomm_tools.figures.trace import Trace

__all__ = ["estimates_figure"]

# Of each window; what an estimate does in between lasts less than a second or two.
_SAMPLES: Final = 60


def estimates_figure(traces: Sequence[Trace]) -> Figure:
    """Draw the agents' estimates against ν(t), and below it by how much they are off.

    Window by window, over all agents and times in it: the mean, the middle half, and the band from
    the lowest estimate to the highest.

    Args:
        traces: of each method one, all of the same field; those without estimates aren't drawn.
    """
    shown = [trace for trace in traces if trace.estimates]
    figure = new_figure(PAGE_IN, 3.0)
    panels = figure.subplots(2, len(shown), sharex=True, sharey="row", squeeze=False)
    for trace, above, below in zip(shown, *panels, strict=True):
        assert trace.field is not None
        _draw_method(above, below, trace, trace.field)
        above.set_title(trace.method, fontsize=8.0)
        below.set_xlabel("time (s)")
        below.set_xlim(0.0, trace.end_s)
        below.xaxis.set_major_locator(MaxNLocator(4, steps=[1, 2, 5, 10]))
    panels[0, 0].set_ylabel("estimate of ν (–)")
    panels[1, 0].set_ylabel("deviation from ν (–)")
    figure.align_ylabels()
    _add_legend(figure, panels[0, 0])
    return figure


def _draw_method(above: Axes, below: Axes, trace: Trace, field: Profile) -> None:
    bounds_s = np.arange(0.0, trace.end_s, trace.period_s)
    times_s = bounds_s[:, None] + trace.period_s * (np.arange(_SAMPLES) + 0.5) / _SAMPLES
    truth = field.at(times_s)
    values = np.array([own.at(times_s) for own in trace.estimates.values()])
    values[:, times_s > trace.end_s] = np.nan
    line = method_line(trace.method)
    bounds_s = np.append(bounds_s, trace.end_s)
    _draw_band(above, bounds_s, values, line)
    _draw_band(below, bounds_s, values - truth, line)
    knots_s = np.array(field.times_s)
    above.plot(knots_s, field.at(knots_s), color="black", linestyle=":")
    below.axhline(0.0, color="black", linestyle=":")


def _draw_band(
    axes: Axes, bounds_s: NDArray[np.float64], values: NDArray[np.float64], line: LineStyle
) -> None:
    """Draw what values [agents, windows, samples] are between, their middle half and mean."""
    is_known = ~np.isnan(values).all(axis=(0, 2))
    known = values[:, is_known]
    low, lower, upper, high, mean = np.full((5, len(is_known)), np.nan)
    quantiles = np.nanquantile(known, (0.0, 0.25, 0.75, 1.0), axis=(0, 2))
    low[is_known], lower[is_known], upper[is_known], high[is_known] = quantiles
    mean[is_known] = np.nanmean(known, axis=(0, 2))
    axes.stairs(high, bounds_s, baseline=low, fill=True, color=line.colour, alpha=0.25)
    axes.stairs(upper, bounds_s, baseline=lower, fill=True, color=line.colour, alpha=0.5)
    axes.stairs(mean, bounds_s, baseline=None, color="black", linewidth=0.9)


def _add_legend(figure: Figure, axes: Axes) -> None:
    band, half, mean = axes.patches
    (truth,) = axes.lines
    handles = {
        "true ν(t)": truth,
        "mean": mean,
        "middle half": half,
        "lowest to highest": band,
    }
    figure.legend(handles.values(), handles.keys(), loc="outside lower center", ncols=4)
