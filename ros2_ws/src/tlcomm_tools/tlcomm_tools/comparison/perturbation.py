"""What differs from one repetition of a comparison to the next.

``perturbed``      a scenario as a seed has it
``DEFAULT_NOISE``  what speeds are off by, where the scenario doesn't say
"""

import math
from typing import Final

import numpy as np
from numpy.typing import NDArray

from tlcomm_core.agent.avoidance import avoided_regions
from tlcomm_core.scenario.loader import verify
from tlcomm_core.scenario.measurements import stations_of
from tlcomm_core.scenario.model import Agent, MeasuredField, Noise, Scenario
from tlcomm_core.scenario.site import Site
from tlcomm_core.scenario.task import hard_formula
from tlcomm_core.workspace.atlas import Atlas
from tlcomm_core.workspace.lattice import HEADINGS_RAD
from tlcomm_core.workspace.sight import sightlines
from tlcomm_core.world.radio import distances_m, edges, is_connected, pair_indices

__all__ = ["DEFAULT_NOISE", "perturbed"]

DEFAULT_NOISE: Final = Noise(linear=0.02, angular=0.02)

_REACH_CELLS: Final = 3.0
# An agent's move may wait for another's to make room or to hold the team together.
_SWEEPS: Final = 2


def perturbed(scenario: Scenario, seed: int) -> Scenario:
    """Return the scenario of one repetition, the same for every method.

    Seed 0 is the scenario as given. In any other, each agent starts in a free cell drawn from those
    within three cells of its own, turned to a drawn lattice heading: nobody starts where another
    does, in a region in which it didn't, or where its task forbids it to be, and the team stays
    connected. Speeds are off as the scenario's ``noise`` says, or by ``DEFAULT_NOISE``. The drifts
    of the field's stations are all ahead by the same drawn angle, so that how they differ from each
    other stays as given.

    Args:
        scenario: that passed its checks.
        seed: of the repetition, from 0 on.

    Raises:
        PlanningError: an agent starts where its task forbids it to be for ever.

    Cost: O(N³), and N³ · boxes where sight counts.
    """
    if seed == 0:
        return scenario
    rng = np.random.default_rng(seed)
    agents = _moved(scenario, rng)
    noise = scenario.noise if scenario.noise != Noise() else DEFAULT_NOISE
    field = None if scenario.field is None else _shifted(scenario, scenario.field, rng)
    return verify(scenario.model_copy(update={"agents": agents, "noise": noise, "field": field}))


def _shifted(scenario: Scenario, field: MeasuredField, rng: np.random.Generator) -> MeasuredField:
    """Return the field with its stations' drifts ahead."""
    shift_rad = float(rng.uniform(0.0, math.tau))
    phases_rad = {name: phase + shift_rad for name, phase in stations_of(scenario).items()}
    drift = field.drift.model_copy(update={"phases_rad": phases_rad})
    return field.model_copy(update={"drift": drift})


def _moved(scenario: Scenario, rng: np.random.Generator) -> dict[str, Agent]:
    """Return the agents, each started elsewhere: a walk over starts of a connected team."""
    site = Site.from_scenario(scenario)
    names = list(scenario.agents)
    points_m = np.array([scenario.agents[name].start[:2] for name in names])
    options = [_options(site, name) for name in names]
    team = _Team(site, points_m)
    for _ in range(_SWEEPS):
        for index in rng.permutation(len(names)).tolist():
            team.move(index, site.grid.locations_m[options[index]], rng)
    return {
        name: scenario.agents[name].model_copy(
            update={"start": (*point_m, float(rng.choice(HEADINGS_RAD)))}
        )
        for name, point_m in zip(names, map(tuple, team.points_m.tolist()), strict=True)
    }


def _options(site: Site, name: str) -> NDArray[np.intp]:
    """Return the locations that an agent may start at, its own among them."""
    start = site.start_of(name)
    task = hard_formula(site.scenario.agents[name])
    avoided = avoided_regions(name, site, task, start)
    grid = Atlas(site.grid, site.region_discs).grid_avoiding(avoided)
    home = grid.location_at(start.x_m, start.y_m)
    assert home is not None, "a checked scenario starts in free cells"
    near = grid.locations_within(start.x_m, start.y_m, _REACH_CELLS * grid.cell_m)
    regions = site.regions_at(home)
    return np.array(
        [
            location
            for location in near.tolist()
            if grid.components[location] == grid.components[home]
            and site.regions_at(location) <= regions
        ],
        dtype=np.intp,
    )


class _Team:
    """Where everybody starts, connected at all times."""

    def __init__(self, site: Site, points_m: NDArray[np.float64]) -> None:
        communication = site.scenario.communication
        self.points_m = points_m
        self._grid = site.grid
        self._gap_m = max(communication.separation_m, site.grid.cell_m / 2.0)
        self._range_m = site.planned_range_m
        self._clearance_m = site.planned_clearance_m
        if not self._is_connected(points_m):
            # As given it starts within range, but closer to its end than meetings are planned.
            self._range_m = communication.range_m
            self._clearance_m = 0.0 if site.scenario.radio.line_of_sight else None

    def move(self, index: int, options_m: NDArray[np.float64], rng: np.random.Generator) -> None:
        """Put an agent on one of some points, float[M, 2], that leave room and the team whole."""
        points_m = [point_m for point_m in options_m if self._admits(index, point_m)]
        if points_m:
            self.points_m = self._with(index, points_m[rng.integers(len(points_m))])

    def _admits(self, index: int, point_m: NDArray[np.float64]) -> bool:
        others_m = np.delete(self.points_m, index, axis=0)
        has_room = bool((np.hypot(*(others_m - point_m).T) >= self._gap_m).all())
        return has_room and self._is_connected(self._with(index, point_m))

    def _with(self, index: int, point_m: NDArray[np.float64]) -> NDArray[np.float64]:
        points_m = self.points_m.copy()
        points_m[index] = point_m
        return points_m

    def _is_connected(self, points_m: NDArray[np.float64]) -> bool:
        linked = distances_m(points_m) <= self._range_m
        if self._clearance_m is not None:
            first, second = (points_m[indices] for indices in pair_indices(len(points_m)))
            linked &= sightlines(self._grid, first, second, self._clearance_m)
        return is_connected(len(points_m), edges(len(points_m), linked))
