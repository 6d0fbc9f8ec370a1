"""Random scenarios that can be run: seeded, for tests and benchmarks.

``random_scenario``  obstacles, regions, ordered tasks, a connected start
"""

import math
from collections import deque
from typing import Final

import numpy as np
from numpy.typing import NDArray

from tlcomm_core.errors import LocalMisuseError
from tlcomm_core.scenario.loader import verify
from tlcomm_core.scenario.model import Agent, Communication, Drive, Region, Scenario, Workspace
from tlcomm_core.workspace.grid import Box, Grid
from tlcomm_core.workspace.lattice import HEADINGS_RAD
from tlcomm_core.workspace.travel import Motion, TravelTimes

__all__ = ["random_scenario"]

_DRIVE: Final = Drive(linear_mps=1.0, angular_radps=1.5)
_ACTIONS: Final = {"collect": 4.0, "measure": 4.0, "unload": 4.0}
_SHORTEST_PERIOD_S: Final = 60.0
_DURATION_S: Final = 5.0
_LONGEST_SIDE_CELLS: Final = 4
_SUBTASKS: Final = (2, 4)


def random_scenario(
    rng: np.random.Generator,
    agents: int,
    size_m: tuple[float, float] = (10.0, 10.0),
    cell_m: float = 0.5,
    obstacle_share: float = 0.12,
    regions: int | None = None,
) -> Scenario:
    """Return a scenario in which every task can be done and every round has a meeting.

    All agents start side by side and each visits two to four regions in order, again and again.
    The period T_c leaves time to cross the workspace twice, and is at least 60 s.

    Args:
        rng: the only source of chance.
        agents: number of agents.
        size_m: extent along x and y.
        cell_m: edge length of a cell; a radio reaches two.
        obstacle_share: share of the area to cover with obstacles, in [0, 0.4].
        regions: number of regions, at least 4; by default one per agent, at least 6.

    Raises:
        LocalMisuseError: the workspace has too few connected free cells for all of them.
    """
    count = max(6, agents) if regions is None else regions
    boxes = _random_boxes(rng, size_m, cell_m, obstacle_share)
    grid = Grid(size_m, cell_m, boxes)
    hall = np.flatnonzero(grid.components == np.bincount(grid.components).argmax())
    if len(hall) < max(agents, count) or count < _SUBTASKS[1]:
        raise LocalMisuseError(
            f"{agents!r} agents and {count!r} regions don't fit {len(hall)!r} free cells"
        )
    chosen = rng.choice(hall, size=count, replace=False)
    names = [f"place_{number}" for number in range(1, count + 1)]
    starts = _adjacent(grid, int(rng.choice(hall)), agents)
    fleet = {
        f"agent_{number}": Agent(
            start=(*_point(grid, start), float(rng.choice(HEADINGS_RAD))),
            task=_random_task(rng, names),
        )
        for number, start in enumerate(starts, start=1)
    }
    scenario = Scenario(
        name=f"random_{agents}",
        workspace=Workspace(
            size_m=size_m,
            cell_m=cell_m,
            obstacles_m=tuple(boxes),
            regions={
                name: Region(at_m=_point(grid, int(location)), radius_m=cell_m)
                for name, location in zip(names, chosen, strict=True)
            },
        ),
        communication=Communication(
            range_m=2.0 * cell_m, period_s=_period_s(grid, chosen), duration_s=_DURATION_S
        ),
        motion=_DRIVE,
        actions=dict(_ACTIONS),
        agents=fleet,
    )
    return verify(scenario)


def _random_boxes(
    rng: np.random.Generator, size_m: tuple[float, float], cell_m: float, share: float
) -> list[Box]:
    """Return boxes along cell edges that cover at least a share of the area; they may overlap."""
    columns, rows = (math.floor(length_m / cell_m + 1e-6) for length_m in size_m)
    closed = np.zeros((rows, columns), dtype=np.bool_)
    boxes: list[Box] = []
    while closed.mean() < share:
        width, height = rng.integers(1, _LONGEST_SIDE_CELLS + 1, size=2).tolist()
        left = int(rng.integers(max(columns - width, 0) + 1))
        low = int(rng.integers(max(rows - height, 0) + 1))
        closed[low : low + height, left : left + width] = True
        right, high = min(left + width, columns), min(low + height, rows)
        boxes.append((left * cell_m, low * cell_m, right * cell_m, high * cell_m))
    return boxes


def _adjacent(grid: Grid, first: int, count: int) -> list[int]:
    """Return locations around one, each a move away from an earlier one."""
    found = {first: None}
    queue = deque([first])
    while queue and len(found) < count:
        for neighbour in grid.moves[queue.popleft()].tolist():
            if neighbour >= 0 and neighbour not in found and len(found) < count:
                found[neighbour] = None
                queue.append(neighbour)
    return list(found)


def _random_task(rng: np.random.Generator, regions: list[str]) -> str:
    """Return □◇ of two to four actions in order, each in a region of its own."""
    length = int(rng.integers(_SUBTASKS[0], _SUBTASKS[1] + 1))
    places = rng.choice(len(regions), size=length, replace=False).tolist()
    actions = rng.choice(sorted(_ACTIONS), size=length).tolist()
    task = ""
    for place, action in zip(places, actions, strict=True):
        task = f"({regions[place]} & {action}){f' & F ({task})' if task else ''}"
    return f"G F ({task})"


def _period_s(grid: Grid, regions: NDArray[np.intp]) -> float:
    """Return a period with time to act, to go anywhere and to come back, whatever was before."""
    travel = TravelTimes(grid, Motion(_DRIVE.linear_mps, _DRIVE.angular_radps))
    longest_s = 0.0
    for region in regions.tolist():
        times_s = travel.time_to(region)
        longest_s = max(longest_s, float(times_s[np.isfinite(times_s)].max()))
    # Leaving a region may need half a turn more than the same way into it.
    crossing_s = longest_s + math.pi / _DRIVE.angular_radps
    return max(
        _SHORTEST_PERIOD_S,
        math.ceil(2.0 * crossing_s + max(_ACTIONS.values()) + _DURATION_S),
    )


def _point(grid: Grid, location: int) -> tuple[float, float]:
    x_m, y_m = grid.locations_m[location].tolist()
    return x_m, y_m
