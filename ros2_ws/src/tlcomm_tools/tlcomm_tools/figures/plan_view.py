"""The workspace as seen from above, on which other figures draw.

``draw_ground``    obstacles, regions and axes
``width_in``       how wide a figure must be for names and numbers to have room
``height_in``      how high the workspace is at a width
"""

from collections.abc import Iterator
from typing import Final

from matplotlib.axes import Axes
from matplotlib.patches import Circle, Rectangle
from matplotlib.patheffects import withStroke
from matplotlib.ticker import MaxNLocator

from tlcomm_tools.figures.elements import Ground
from tlcomm_tools.figures.style import COLUMN_IN, HATCH_GREY, OBSTACLE_GREY, PAGE_IN

__all__ = ["draw_ground", "height_in", "width_in"]

_MOST_IN_COLUMN: Final = 12
_NAME_PT: Final = 7.0
# Width of a letter and height of a line, as shares of the size of type.
_LETTER: Final = 0.62
_LINE: Final = 1.25
_POINTS_PER_INCH: Final = 72.0

_Box = tuple[float, float, float, float]


def width_in(ground: Ground, count: int) -> float:
    """Return the width of a figure of the workspace with so many things to be told apart."""
    is_small = max(count, len(ground.regions_m)) <= _MOST_IN_COLUMN
    return COLUMN_IN if is_small else PAGE_IN


def height_in(ground: Ground, wide_in: float) -> float:
    """Return how high the workspace is if it is so wide."""
    return wide_in * ground.size_m[1] / ground.size_m[0]


def draw_ground(axes: Axes, ground: Ground, named_in: float | None = None) -> None:
    """Draw obstacles and regions, and set the axes to the workspace in metres.

    Args:
        axes: where.
        ground: what.
        named_in: how wide the axes will be, for regions to bear their names; ``None`` without.
    """
    for x_min, y_min, x_max, y_max in ground.obstacles_m:
        box = (x_min, y_min), x_max - x_min, y_max - y_min
        # Hatched, since in grey a plain face might be taken for a colour.
        axes.add_patch(
            Rectangle(
                *box,
                facecolor=OBSTACLE_GREY,
                edgecolor=HATCH_GREY,
                hatch="/////",
                linewidth=0.0,
                zorder=1.0,
            )
        )
    for x_m, y_m, radius_m in ground.regions_m.values():
        ring = Circle((x_m, y_m), radius_m, facecolor="none", edgecolor="#707070", zorder=1.5)
        axes.add_patch(ring)
    if named_in is not None:
        _name_regions(axes, ground, named_in)
    (left_m, bottom_m), (wide_m, high_m) = ground.origin_m, ground.size_m
    axes.set_xlim(left_m, left_m + wide_m)
    axes.set_ylim(bottom_m, bottom_m + high_m)
    axes.set_aspect("equal")
    for axis in (axes.xaxis, axes.yaxis):
        axis.set_major_locator(MaxNLocator(5, steps=[1, 2, 5, 10]))
    axes.spines[["top", "right"]].set_visible(True)
    axes.set_xlabel("x (m)")
    axes.set_ylabel("y (m)")


def _name_regions(axes: Axes, ground: Ground, wide_in: float) -> None:
    """Write each name beside its region, where it is inside and covers no other name."""
    point_m = ground.size_m[0] / (wide_in * _POINTS_PER_INCH)
    high_m = _LINE * _NAME_PT * point_m
    taken: list[_Box] = []
    for name, disc in ground.regions_m.items():
        wide_m = _LETTER * _NAME_PT * point_m * len(name)
        boxes = list(_beside(disc, wide_m, high_m))
        free = (box for box in boxes if _is_inside(box, ground) and not _meets(box, taken))
        box = next(free, boxes[0])
        taken.append(box)
        axes.text(
            (box[0] + box[2]) / 2.0,
            (box[1] + box[3]) / 2.0,
            name,
            ha="center",
            va="center",
            fontsize=_NAME_PT,
            color="#303030",
            path_effects=[withStroke(linewidth=2.0, foreground="white", alpha=0.8)],
            zorder=2.5,
        )


def _beside(disc: tuple[float, float, float], wide_m: float, high_m: float) -> Iterator[_Box]:
    """Yield the boxes above, below, right and left of a disc."""
    x_m, y_m, radius_m = disc
    aside_m, apart_m = radius_m + wide_m / 2.0, radius_m + high_m / 2.0
    for middle_x_m, middle_y_m in (
        (x_m, y_m + apart_m),
        (x_m, y_m - apart_m),
        (x_m + aside_m, y_m),
        (x_m - aside_m, y_m),
    ):
        yield (
            middle_x_m - wide_m / 2.0,
            middle_y_m - high_m / 2.0,
            middle_x_m + wide_m / 2.0,
            middle_y_m + high_m / 2.0,
        )


def _is_inside(box: _Box, ground: Ground) -> bool:
    (left_m, bottom_m), (wide_m, high_m) = ground.origin_m, ground.size_m
    inside_x = left_m <= box[0] and box[2] <= left_m + wide_m
    return inside_x and bottom_m <= box[1] and box[3] <= bottom_m + high_m


def _meets(box: _Box, others: list[_Box]) -> bool:
    return any(
        box[0] < other[2] and other[0] < box[2] and box[1] < other[3] and other[1] < box[3]
        for other in others
    )
