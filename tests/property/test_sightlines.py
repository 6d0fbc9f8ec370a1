"""Sight against the separating axis theorem in whole numbers."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from tlcomm_core.workspace.grid import Grid
from tlcomm_core.workspace.sight import sightlines

Point = tuple[int, int]
Corners = tuple[int, int, int, int]

SIZE = 12
points = st.tuples(st.integers(0, SIZE), st.integers(0, SIZE))


@st.composite
def boxes(draw: st.DrawFn) -> Corners:
    """Draw a box with an inside."""
    x, y = draw(st.integers(0, SIZE - 1)), draw(st.integers(0, SIZE - 1))
    return x, y, draw(st.integers(x + 1, SIZE)), draw(st.integers(y + 1, SIZE))


@given(points, points, st.lists(boxes(), max_size=4))
def test_sight_agrees_with_whole_numbers(one: Point, other: Point, walls: list[Corners]) -> None:
    """A straight is hidden if and only if nothing separates it from some box's inside."""
    grid = Grid((float(SIZE), float(SIZE)), 1.0, np.array(walls, dtype=np.float64))
    seen = bool(sightlines(grid, np.array(one, dtype=float), np.array(other, dtype=float)))
    assert seen is not any(enters(one, other, wall) for wall in walls)


def enters(one: Point, other: Point, wall: Corners) -> bool:
    """Tell whether a straight enters an open box: no axis, nor its own direction, parts them."""
    x_min, y_min, x_max, y_max = wall
    (x, y), (u, v) = one, other
    if max(x, u) <= x_min or min(x, u) >= x_max or max(y, v) <= y_min or min(y, v) >= y_max:
        return False
    sides = [
        (u - x) * (corner_y - y) - (v - y) * (corner_x - x)
        for corner_x in (x_min, x_max)
        for corner_y in (y_min, y_max)
    ]
    return one == other or min(sides) < 0 < max(sides)
