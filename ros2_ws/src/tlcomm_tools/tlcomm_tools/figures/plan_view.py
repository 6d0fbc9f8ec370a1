"""The workspace as seen from above, on which other figures draw.

``draw_ground``  obstacles, regions and axes
"""

from typing import Final

from matplotlib.axes import Axes
from matplotlib.patches import Circle, Rectangle
from matplotlib.patheffects import withStroke
from matplotlib.ticker import MaxNLocator

from tlcomm_tools.figures.elements import Ground
from tlcomm_tools.figures.style import OBSTACLE_GREY

__all__ = ["draw_ground"]

# The room that a name needs beyond its region, as a share of the workspace's height.
_NAME_SHARE: Final = 0.05


def draw_ground(axes: Axes, ground: Ground, *, named: bool = True) -> None:
    """Draw obstacles and regions, and set the axes to the workspace in metres.

    Args:
        axes: where.
        ground: what.
        named: whether regions bear their names.
    """
    for x_min, y_min, x_max, y_max in ground.obstacles_m:
        box = (x_min, y_min), x_max - x_min, y_max - y_min
        axes.add_patch(Rectangle(*box, facecolor=OBSTACLE_GREY, edgecolor="none", zorder=1.0))
    (left_m, bottom_m), (width_m, height_m) = ground.origin_m, ground.size_m
    for name, (x_m, y_m, radius_m) in ground.regions_m.items():
        ring = Circle((x_m, y_m), radius_m, facecolor="none", edgecolor="#707070", zorder=1.5)
        axes.add_patch(ring)
        if named:
            room_m = bottom_m + height_m - (y_m + radius_m)
            _name(axes, name, (x_m, y_m), radius_m, above=room_m > _NAME_SHARE * height_m)
    axes.set_xlim(left_m, left_m + width_m)
    axes.set_ylim(bottom_m, bottom_m + height_m)
    axes.set_aspect("equal")
    for axis in (axes.xaxis, axes.yaxis):
        axis.set_major_locator(MaxNLocator(5, steps=[1, 2, 5, 10]))
    axes.spines[["top", "right"]].set_visible(True)
    axes.set_xlabel("x (m)")
    axes.set_ylabel("y (m)")


def _name(
    axes: Axes, name: str, at_m: tuple[float, float], radius_m: float, *, above: bool
) -> None:
    side = 1.0 if above else -1.0
    axes.annotate(
        name,
        (at_m[0], at_m[1] + side * radius_m),
        xytext=(0.0, side),
        textcoords="offset points",
        ha="center",
        va="bottom" if above else "top",
        fontsize=7.0,
        color="#303030",
        path_effects=[withStroke(linewidth=2.0, foreground="white", alpha=0.8)],
        zorder=2.5,
    )
