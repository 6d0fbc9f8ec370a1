"""How all figures look: for a printed column, in grey, and for the colour-blind.

``COLUMN_IN``   width of a column
``PAGE_IN``     width of a page
``OBSTACLE_GREY``  face of obstacles
``HATCH_GREY``  their hatching
``LineStyle``   how a line is told from others
``method_line`` a method's
``in_order``    methods as figures show them
``agent_line``  an agent's
``agent_labels``  short names of agents
``styled``      the style, while figures are made and saved
``new_figure``  an empty figure
``show_large_numbers``  thousands and millions by their letters
``save``        a figure as SVG and PNG
"""

import re
from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Final

from matplotlib import rc_context, rcdefaults, rcParams
from matplotlib.axis import Axis
from matplotlib.figure import Figure
from matplotlib.ticker import EngFormatter

__all__ = [
    "COLUMN_IN",
    "HATCH_GREY",
    "OBSTACLE_GREY",
    "PAGE_IN",
    "LineStyle",
    "agent_labels",
    "agent_line",
    "in_order",
    "method_line",
    "new_figure",
    "save",
    "show_large_numbers",
    "styled",
]

COLUMN_IN: Final = 3.5
PAGE_IN: Final = 7.16
OBSTACLE_GREY: Final = "#e6e6e6"
HATCH_GREY: Final = "#a8a8a8"

_DOTS_PER_INCH: Final = 220
_LARGE: Final = 10_000.0
_RC: Final[dict[Any, Any]] = {
    "font.family": "DejaVu Sans",
    "font.size": 8.0,
    "axes.labelsize": 8.0,
    "xtick.labelsize": 7.0,
    "ytick.labelsize": 7.0,
    "legend.fontsize": 7.0,
    "legend.frameon": False,
    "legend.handlelength": 2.8,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.linewidth": 0.6,
    "axes.axisbelow": True,
    "axes.grid": False,
    "grid.color": "#dddddd",
    "grid.linewidth": 0.5,
    "xtick.major.width": 0.6,
    "ytick.major.width": 0.6,
    "lines.linewidth": 1.3,
    "lines.markersize": 4.0,
    "patch.linewidth": 0.6,
    "hatch.linewidth": 0.5,
    "hatch.color": "#404040",
    "savefig.dpi": _DOTS_PER_INCH,
    # The same figure is the same file: ids would otherwise be made from a random salt.
    "svg.hashsalt": "tlcomm",
    "svg.fonttype": "path",
}


@dataclass(frozen=True, slots=True)
class LineStyle:
    """How a line is told from others, by more than its colour.

    Attributes:
        colour: of Okabe and Ito's palette.
        dashes: matplotlib's line style.
        marker: matplotlib's marker.
    """

    colour: str
    dashes: str | tuple[float, tuple[float, ...]]
    marker: str


# Okabe and Ito's palette: told apart with any colour vision.
_BLACK, _ORANGE, _SKY, _GREEN = "#000000", "#e69f00", "#56b4e9", "#009e73"
_BLUE, _VERMILION, _PURPLE, _GREY = "#0072b2", "#d55e00", "#cc79a7", "#7f7f7f"

_METHODS: Final = {
    "team": LineStyle(_BLUE, "-", "o"),
    "static": LineStyle(_ORANGE, (0, (5, 1.5)), "s"),
    "pairwise": LineStyle(_GREEN, (0, (6, 1.5, 1, 1.5)), "^"),
    "all-time": LineStyle(_VERMILION, (0, (1, 1)), "D"),
    "none": LineStyle(_PURPLE, (0, (3, 1, 1, 1, 1, 1)), "X"),
    "oracle": LineStyle(_SKY, (0, (9, 2)), "P"),
}
_AGENTS: Final = (
    LineStyle(_BLUE, "-", "o"),
    LineStyle(_VERMILION, (0, (4, 1.2)), "s"),
    LineStyle(_GREEN, (0, (1, 1)), "D"),
    LineStyle(_ORANGE, (0, (6, 1.2, 1, 1.2)), "^"),
    LineStyle(_PURPLE, "-", "v"),
    LineStyle(_SKY, (0, (4, 1.2)), "P"),
    LineStyle(_BLACK, (0, (1, 1)), "X"),
    LineStyle(_GREY, (0, (6, 1.2, 1, 1.2)), "h"),
)


def method_line(method: str) -> LineStyle:
    """Return how a method's line looks: the same in all figures."""
    return _METHODS[method]


def in_order(methods: Iterable[str]) -> list[str]:
    """Return methods in the order in which figures show them, the team's way first."""
    return sorted(methods, key=list(_METHODS).index)


def agent_line(index: int) -> LineStyle:
    """Return how the line of the agent with this index in the team looks."""
    return _AGENTS[index % len(_AGENTS)]


def agent_labels(agents: Sequence[str]) -> dict[str, str]:
    """Return what agents are called where room is scarce: their numbers, if that is unambiguous."""
    numbers = {name: number[0] for name in agents if (number := re.findall(r"\d+$", name))}
    is_clear = len(set(numbers.values())) == len(agents)
    return numbers if is_clear else {name: name for name in agents}


@contextmanager
def styled() -> Iterator[None]:
    """Let figures that are made and saved inside have this style, whatever the user's is.

    Outside, it is as it was.
    """
    with rc_context():
        rcdefaults()
        rcParams.update(_RC)
        yield


def new_figure(width_in: float, height_in: float) -> Figure:
    """Return an empty figure that leaves each label the room that it needs, without a display."""
    return Figure(figsize=(width_in, height_in), layout="constrained")


def show_large_numbers(axis: Axis) -> None:
    """Write the numbers of an axis that reaches 10,000 in k and M; for when all is drawn."""
    if max(map(abs, axis.get_view_interval())) >= _LARGE:
        axis.set_major_formatter(EngFormatter(sep=""))


def save(figure: Figure, folder: Path, name: str) -> tuple[Path, Path]:
    """Write a figure as SVG and PNG, in the style; the same figure makes the same files.

    Raises:
        OSError: a file can't be written.
    """
    vector, raster = folder / f"{name}.svg", folder / f"{name}.png"
    # Finding out what room labels need takes most of the time, and is the same for both.
    figure.draw_without_rendering()
    figure.set_layout_engine("none")
    figure.savefig(vector, metadata={"Date": None})
    figure.savefig(raster, metadata={"Software": None})
    return vector, raster
