"""Travel times against an independent search in plain Python."""

import heapq
import math

import numpy as np
import pytest

from tlcomm_core.geometry import Pose
from tlcomm_core.workspace.grid import Grid
from tlcomm_core.workspace.travel import HEADINGS_RAD, Motion, TravelTimes

Cell = tuple[int, int]
State = tuple[Cell, int]
STEPS = [(1, 0), (1, 1), (0, 1), (-1, 1), (-1, 0), (-1, -1), (0, -1), (1, -1)]
CELL_M = 0.5
MOTION = Motion(linear_mps=1.0, angular_radps=1.5)


def random_closed(seed: int) -> tuple[int, int, set[Cell]]:
    """Columns, rows and closed cells."""
    rng = np.random.default_rng(seed)
    columns, rows = rng.integers(2, 13, size=2).tolist()
    closed = {
        (x, y)
        for x in range(columns)
        for y in range(rows)
        if rng.random() < 0.2 and (x, y) != (0, 0)
    }
    return columns, rows, closed


def grid_of(columns: int, rows: int, closed: set[Cell]) -> Grid:
    """The same workspace as the code under test sees it."""
    boxes = [(x * CELL_M, y * CELL_M, (x + 1) * CELL_M, (y + 1) * CELL_M) for x, y in closed]
    return Grid((columns * CELL_M, rows * CELL_M), CELL_M, boxes)


def search(columns: int, rows: int, closed: set[Cell], start: State) -> dict[State, float]:
    """Plain Dijkstra over cells and headings; turns of any size in one step."""

    def is_free(x: int, y: int) -> bool:
        return 0 <= x < columns and 0 <= y < rows and (x, y) not in closed

    done: dict[State, float] = {}
    queue = [(0.0, start)]
    while queue:
        time_s, state = heapq.heappop(queue)
        if state in done:
            continue
        done[state] = time_s
        (x, y), k = state
        for other in range(8):
            steps = min((other - k) % 8, (k - other) % 8)
            heapq.heappush(
                queue,
                (time_s + steps * math.pi / 4 / MOTION.angular_radps, ((x, y), other)),
            )
        dx, dy = STEPS[k]
        if is_free(x + dx, y + dy) and is_free(x + dx, y) and is_free(x, y + dy):
            length_m = CELL_M * math.sqrt(dx * dx + dy * dy)
            heapq.heappush(queue, (time_s + length_m / MOTION.linear_mps, ((x + dx, y + dy), k)))
    return done


@pytest.mark.parametrize("seed", range(30))
def test_times_equal_a_plain_search(seed: int) -> None:
    """From a random state, both tables agree with the oracle at every location."""
    columns, rows, closed = random_closed(seed)
    grid = grid_of(columns, rows, closed)
    travel = TravelTimes(grid, MOTION)
    rng = np.random.default_rng(seed)
    source, heading = int(rng.integers(len(grid))), int(rng.integers(8))
    x_m, y_m = grid.locations_m[source].tolist()
    found = search(columns, rows, closed, ((int(x_m / CELL_M), int(y_m / CELL_M)), heading))
    reach = travel.reach(Pose(x_m, y_m, HEADINGS_RAD[heading]))
    for target, (tx_m, ty_m) in enumerate(grid.locations_m.tolist()):
        cell = (int(tx_m / CELL_M), int(ty_m / CELL_M))
        by_heading = [found.get((cell, k), math.inf) for k in range(8)]
        assert reach.time_s[target] == pytest.approx(min(by_heading), abs=1e-9)
        assert travel.time_to(target)[source, heading] == pytest.approx(min(by_heading), abs=1e-9)
        if target != source and math.isfinite(min(by_heading)):
            first = next(k for k in range(8) if by_heading[k] <= min(by_heading) + 1e-9)
            assert reach.heading[target] == first
