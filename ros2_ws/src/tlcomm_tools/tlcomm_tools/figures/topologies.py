"""Who was linked to whom, and where, in some rounds.

``topologies_figure``  the figure
``PAPER_ROUNDS``       the rounds that the paper shows
"""

from collections import Counter
from collections.abc import Sequence
from typing import Final

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from tlcomm_tools.figures.elements import Meeting
from tlcomm_tools.figures.plan_view import draw_ground, height_in
from tlcomm_tools.figures.style import PAGE_IN, new_figure
from tlcomm_tools.figures.trace import Trace

__all__ = ["PAPER_ROUNDS", "topologies_figure"]

PAPER_ROUNDS: Final = (1, 8, 23, 58)

# What beside the panels is taken by labels.
_BESIDE_IN: Final = (0.4, 0.55)


def topologies_figure(trace: Trace, rounds: Sequence[int] = PAPER_ROUNDS) -> Figure:
    """Draw the places and links of the meetings of some rounds, those of them that took place.

    Where parts of the team met, all of a round that share nobody are drawn together. A place of
    several agents says of how many.

    Args:
        trace: a run in which somebody met.
        rounds: one panel each.
    """
    shown = [found for number in rounds if (found := _apart(trace, number))]
    panel_in = (PAGE_IN - _BESIDE_IN[0]) / max(len(PAPER_ROUNDS), len(shown))
    figure = new_figure(
        _BESIDE_IN[0] + panel_in * len(shown), _BESIDE_IN[1] + height_in(trace.ground, panel_in)
    )
    panels = figure.subplots(1, len(shown), sharey=True, squeeze=False)[0]
    for axes, found in zip(panels, shown, strict=True):
        draw_ground(axes, trace.ground)
        for meeting in found:
            _draw_meeting(axes, meeting)
        axes.set_title(f"r = {found[0].round} at {found[0].start_s:.0f} s", fontsize=8.0)
    for axes in panels[1:]:
        axes.set_ylabel("")
    return figure


def _apart(trace: Trace, number: int) -> list[Meeting]:
    """Return the meetings of a round, of each agent the first."""
    found: list[Meeting] = []
    present: set[str] = set()
    for meeting in trace.meetings:
        if meeting.round == number and present.isdisjoint(meeting.places_m):
            found.append(meeting)
            present |= meeting.places_m.keys()
    return found


def _draw_meeting(axes: Axes, meeting: Meeting) -> None:
    for one, other in meeting.links:
        ends_m = np.array([meeting.places_m[one], meeting.places_m[other]])
        axes.plot(*ends_m.T, color="black", linewidth=0.9, zorder=2.0)
    counts = Counter(meeting.places_m.values())
    axes.plot(
        *np.array(list(counts)).T,
        "o",
        color="#56b4e9",
        markeredgecolor="black",
        markeredgewidth=0.6,
        markersize=4.5,
        zorder=2.5,
    )
    for place_m, count in counts.items():
        if count > 1:
            axes.annotate(
                f"×{count}", place_m, xytext=(3.0, 2.0), textcoords="offset points", fontsize=6.5
            )
