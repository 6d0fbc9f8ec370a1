"""What is run: the options that both harnesses share, and the world of a scenario.

``Mission``       a scenario with its options
``create_world``  the world of a scenario
"""

from dataclasses import dataclass

import numpy as np

from tlcomm_core.field.sensors import Sensors
from tlcomm_core.game.solver import DEFAULT, Solver
from tlcomm_core.method import Method
from tlcomm_core.scenario.site import Site, later_grids
from tlcomm_core.units import nanoseconds
from tlcomm_core.world.lockstep import StopRule
from tlcomm_core.world.world import Body, Noise, World

__all__ = ["Mission", "create_world"]


@dataclass(frozen=True, slots=True)
class Mission:
    """A run to be.

    Attributes:
        site: the scenario.
        seed: of all that is random.
        rounds: the run ends D_c after the meeting of this round, or with its window if the method
            doesn't meet in windows; or ``None``.
        until_s: the run ends at this simulated time; or ``None``.
        solver: of the rounds, as far as the method leaves the choice.
        method: of coordination.
    """

    site: Site
    seed: int
    rounds: int | None
    until_s: float | None
    solver: Solver = DEFAULT
    method: Method = Method.TEAM

    @property
    def stop(self) -> StopRule:
        """When the run is over; the meeting at t = 0 is round 0."""
        ends_s = [] if self.until_s is None else [self.until_s]
        meetings = None if self.rounds is None else self.rounds + 1
        if meetings is not None and not self.method.meets_in_windows:
            ends_s.append(meetings * self.site.scenario.communication.period_s)
            meetings = None
        return StopRule(meetings, nanoseconds(min(ends_s)) if ends_s else None)


def create_world(site: Site, seed: int) -> World:
    """Return the scenario's world at t = 0."""
    scenario = site.scenario
    bodies = []
    for name in scenario.agents:
        drive = scenario.drive_of(name)
        bodies.append(Body(name, site.start_of(name), drive.linear_mps, drive.angular_radps))
    workspace = scenario.workspace
    times_ns = [nanoseconds(change.at_s) for change in workspace.changes]
    world = World(
        bodies,
        site.grid,
        scenario.communication.range_m,
        Noise(scenario.noise.linear, scenario.noise.angular),
        np.random.default_rng(seed),
        changes=tuple(zip(times_ns, later_grids(workspace), strict=True)),
        line_of_sight=scenario.radio.line_of_sight,
    )
    sensors = Sensors.of(site, seed)
    if sensors is not None:
        world.equip(sensors)
    return world
