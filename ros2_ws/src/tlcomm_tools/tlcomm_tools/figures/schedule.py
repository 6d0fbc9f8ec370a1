"""What agents did when, against the windows of communication.

``schedule_figure``  the figure
"""

from typing import Final

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Patch

from tlcomm_core.method import parse_method
from tlcomm_tools.figures.elements import Activity, Span
from tlcomm_tools.figures.style import PAGE_IN, agent_labels, new_figure
from tlcomm_tools.figures.trace import Trace

__all__ = ["schedule_figure"]

_ROUNDS: Final = (0, 5)
_MOST_AGENTS: Final = 24
_HEIGHT: Final = 0.72
# Face and hatch of an action, in the order in which they first occur; then of the rest.
_ACTIONS: Final = (
    ("#56b4e9", ""),
    ("#f0e442", "////"),
    ("#009e73", "...."),
    ("#cc79a7", "xxxx"),
    ("#e69f00", "\\\\\\\\"),
    ("#ffffff", "||||"),
    ("#0072b2", "----"),
)
_MEETING: Final = ("#303030", "")
_WAIT: Final = ("white", "")
_Look = tuple[str, str]


def schedule_figure(trace: Trace, rounds: tuple[int, int] = _ROUNDS) -> Figure:
    """Draw actions, waits and meetings of each agent, or of the first, in a stretch of rounds.

    Args:
        trace: a run.
        rounds: the first and the last window to be drawn.
    """
    first_s = rounds[0] * trace.period_s
    last_s = min((rounds[1] + 1) * trace.period_s, trace.end_s)
    names = tuple(trace.spans)[:_MOST_AGENTS]
    figure = new_figure(PAGE_IN, 0.9 + 0.2 * len(names))
    axes = figure.add_subplot()
    looks = _looks(trace)
    for row, name in enumerate(names):
        for span in trace.spans[name]:
            if span.start_s < last_s and span.end_s > first_s:
                _draw_span(axes, row, span, looks[_kind(span)])
        times_s = [time_s for time_s in trace.satisfied_s[name] if first_s <= time_s <= last_s]
        axes.plot(times_s, [row - 0.36] * len(times_s), "v", color="black", markersize=3.0)
    _draw_windows(axes, trace, rounds)
    axes.set_xlim(first_s, last_s)
    axes.set_ylim(len(names) - 0.4, -0.7)
    labels = agent_labels(tuple(trace.spans))
    axes.set_yticks(range(len(names)), [labels[name] for name in names])
    axes.set_xlabel("time (s)")
    axes.set_ylabel("agent")
    _add_legend(figure, axes, looks)
    return figure


def _kind(span: Span) -> str:
    return span.action if span.activity is Activity.ACTION else span.activity.value


def _looks(trace: Trace) -> dict[str, _Look]:
    actions = dict.fromkeys(
        span.action
        for own in trace.spans.values()
        for span in own
        if span.activity is Activity.ACTION
    )
    looks = {name: _ACTIONS[rank % len(_ACTIONS)] for rank, name in enumerate(actions)}
    return looks | {Activity.WAIT.value: _WAIT, Activity.MEETING.value: _MEETING}


def _draw_span(axes: Axes, row: int, span: Span, look: _Look) -> None:
    face, hatch = look
    height = 0.3 if span.activity is Activity.WAIT else _HEIGHT
    axes.barh(
        row,
        span.end_s - span.start_s,
        left=span.start_s,
        height=height,
        facecolor=face,
        edgecolor="#303030",
        linewidth=0.4,
        hatch=hatch,
    )


def _draw_windows(axes: Axes, trace: Trace, rounds: tuple[int, int]) -> None:
    """Draw where windows begin, and which ones were missed by a method that keeps them."""
    missed = trace.missed_rounds if parse_method(trace.method).keeps_windows else ()
    for number in range(rounds[0], rounds[1] + 1):
        opens_s = number * trace.period_s
        if opens_s < trace.end_s:
            axes.axvline(opens_s, color="#909090", linewidth=0.6, linestyle="--", zorder=0.5)
            flaw = " missed" if number in missed else ""
            axes.annotate(
                f"window {number}{flaw}",
                (opens_s, 1.0),
                xycoords=("data", "axes fraction"),
                xytext=(2.0, 1.0),
                textcoords="offset points",
                fontsize=6.5,
            )


def _add_legend(figure: Figure, axes: Axes, looks: dict[str, _Look]) -> None:
    handles = [
        Patch(facecolor=face, edgecolor="#303030", hatch=hatch, linewidth=0.4, label=name)
        for name, (face, hatch) in looks.items()
    ]
    done = axes.plot([], [], "v", color="black", markersize=3.0, label="task satisfied")
    figure.legend(handles=[*handles, *done], loc="outside lower center", ncols=len(handles) + 1)
