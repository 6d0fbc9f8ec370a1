"""Worlds with random bodies, and random commands for them."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from tlcomm_core.geometry import Pose
from tlcomm_core.workspace.grid import Box, Grid
from tlcomm_core.world.observation import Observation
from tlcomm_core.world.world import Body, Noise, World

BOXES: tuple[Box, ...] = ((2.0, 2.0, 3.0, 3.0), (3.0, 2.5, 4.5, 3.0))
PILLARS: tuple[Box, ...] = tuple(
    (x_m, y_m, x_m + 0.5, y_m + 0.5) for x_m in (1.0, 2.5, 4.0) for y_m in (1.0, 2.5, 4.0)
)
SIZE_M = 6.0
_GRID = Grid((SIZE_M, SIZE_M), 0.5, BOXES)
_PILLARED = Grid((SIZE_M, SIZE_M), 0.5, PILLARS)


@dataclass(frozen=True, slots=True)
class Command:
    """A velocity command to be given at a time."""

    time_ns: int
    agent: str
    linear_mps: float
    angular_radps: float


def random_world(seed: int, count: int, noise: Noise | None = None) -> World:
    """Return a crowded world of 6 m × 6 m, R = 1.5 m, with two obstacles."""
    return _random_world(seed, count, _GRID, 1.5, noise or Noise())


def random_pillars(seed: int, count: int) -> World:
    """Return a world of 6 m × 6 m full of pillars that hide agents from each other, R = 3 m."""
    return _random_world(seed, count, _PILLARED, 3.0, Noise(), line_of_sight=True)


def _random_world(
    seed: int, count: int, grid: Grid, range_m: float, noise: Noise, *, line_of_sight: bool = False
) -> World:
    rng = np.random.default_rng(seed)
    places = rng.choice(grid.locations_m, count, replace=False)
    bodies = [
        Body(f"agent_{index}", Pose(x_m, y_m, rng.uniform(-3.0, 3.0)), 1.0, 1.5)
        for index, (x_m, y_m) in enumerate(places.tolist())
    ]
    return World(bodies, grid, range_m, noise, rng, line_of_sight=line_of_sight)


def random_commands(
    seed: int, count: int, number: int, *, arcs: bool, mean_gap_s: float = 0.2
) -> Iterator[Command]:
    """Yield commands in order of time: turns, straights and stops, and arcs where wanted."""
    rng = np.random.default_rng(seed + 1)
    time_ns = 0
    for _ in range(number):
        time_ns += int(rng.exponential(mean_gap_s) * 1e9)
        agent = f"agent_{rng.integers(count)}"
        linear_mps, angular_radps = rng.uniform(-1.0, 1.0), rng.uniform(-1.5, 1.5)
        if not arcs or rng.random() < 0.3:
            linear_mps, angular_radps = [(1.0, 0.0), (0.0, angular_radps), (linear_mps, 0.0)][
                rng.integers(3)
            ]
        yield Command(time_ns, agent, float(linear_mps), float(angular_radps))


def played(
    world: World, commands: Sequence[Command], stops_ns: Sequence[int] = ()
) -> list[Observation]:
    """Return all observations; the world is advanced to ``stops_ns`` too, whatever they are."""
    seen: list[Observation] = []
    pauses = sorted({*stops_ns, *(command.time_ns for command in commands)})
    for pause_ns in pauses:
        while world.now_ns < pause_ns or world.next_change_ns() == pause_ns:
            seen += world.advance_to(min(world.next_change_ns(), pause_ns))
        for command in commands:
            if command.time_ns == pause_ns:
                seen += world.command(command.agent, command.linear_mps, command.angular_radps)
    return seen
