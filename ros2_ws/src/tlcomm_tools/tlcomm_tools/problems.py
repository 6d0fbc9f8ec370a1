"""Planning problems of any size, for measuring.

``Problem``          how to make a transition system, and a task for it
``PROBLEMS``         small to large
``neighbour_grid``   moves between the cells of a square, the shape that other planners publish
``region_plant``     a workspace with many regions, legs and all
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from typing import Final

import numpy as np

from tlcomm_core.geometry import Pose
from tlcomm_core.planning.transition_system import IDLE_S, State, TransitionSystem, build
from tlcomm_core.workspace.grid import Grid
from tlcomm_core.workspace.travel import Motion, TravelTimes

__all__ = ["PROBLEMS", "Problem", "neighbour_grid", "region_plant"]


@dataclass(frozen=True, slots=True)
class Problem:
    """A transition system, made afresh by ``make``, and a task.

    Attributes:
        name: for tables.
        task: formula.
        make: makes the system.
        published_s: the shortest and the longest time reported for P_MAS_TG on this shape of
            problem, or ``None``.
    """

    name: str
    task: str
    make: Callable[[], TransitionSystem]
    published_s: tuple[float, float] | None = None


def neighbour_grid(side: int) -> TransitionSystem:
    """Return a square of side × side cells; a, b and c are in three of its corners."""
    cells = np.arange(side * side)
    x, y = cells % side, cells // side
    # To stay, then to the neighbours.
    dx, dy = np.array([[0, 1, -1, 0, 0], [0, 0, 0, 1, -1]])
    to_x, to_y = x[:, None] + dx, y[:, None] + dy
    is_inside = (to_x >= 0) & (to_x < side) & (to_y >= 0) & (to_y < side)
    source = np.repeat(cells, is_inside.sum(axis=1))
    target = (to_x + side * to_y)[is_inside]
    names: tuple[tuple[str, ...], ...] = ((), ("a",), ("b",), ("c",))
    label = np.zeros(len(cells), dtype=np.int64)
    label[[side - 1, len(cells) - 1, len(cells) - side]] = 1, 2, 3
    moves = (source != target).astype(np.float64)
    return TransitionSystem(
        states=tuple(
            State(cell, Pose(float(cell % side), float(cell // side), 0.0))
            for cell in cells.tolist()
        ),
        regions={cell: names[label[cell]] for cell in cells.tolist()},
        actions=(None,),
        labels=tuple(map(frozenset, names)),
        initial_label=0,
        source=source,
        target=target,
        action=np.zeros_like(source),
        label=label[target],
        drive_s=moves,
        drive_m=moves,
        stay_s=IDLE_S * (1.0 - moves),
    )


def region_plant(count: int) -> TransitionSystem:
    """Return a plant of 10 m by 10 m with regions r0, r1, … spread over it, and three actions."""
    grid = Grid((10.0, 10.0), 0.5, [(3.0, 3.0, 4.0, 5.0)])
    places = np.random.default_rng(0).permutation(len(grid))[:count].tolist()
    region_location = {f"r{number}": place for number, place in enumerate(places)}
    names = {place: frozenset((name,)) for name, place in region_location.items()}
    x_m, y_m = grid.locations_m[0].tolist()
    return build(
        TravelTimes(grid, Motion(1.0, 1.5)),
        Pose(x_m, y_m, 0.0),
        region_location,
        lambda location: names.get(location, frozenset()),
        {"collect": 4.0, "unload": 4.0, "measure": 4.0},
    )


_FAIR: Final = "G F a & G F b & G F c"
_CHAIN: Final = "G F (r0 & collect & F (r1 & unload & F (r2 & measure)))"

# Reported for a product of 3,600 states, the size that the 30 × 30 grid's has.
_PUBLISHED_S: Final = {30: (23.0, 38.0)}

PROBLEMS: Final = (
    *(
        Problem(f"grid {n} × {n}", _FAIR, partial(neighbour_grid, n), _PUBLISHED_S.get(n))
        for n in (10, 20, 30, 58, 183)
    ),
    *(Problem(f"{n} regions", _CHAIN, partial(region_plant, n)) for n in (10, 30, 100)),
)
