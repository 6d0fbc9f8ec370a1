"""Repetitions from perturbed starts."""

import math
from pathlib import Path

import numpy as np
import pytest

from tlcomm_core.errors import PlanningError
from tlcomm_core.scenario.loader import dumps, load_scenario, loads
from tlcomm_core.scenario.measurements import stations_of
from tlcomm_core.scenario.model import Drift, Noise, Radio, Scenario
from tlcomm_core.scenario.site import Site
from tlcomm_core.workspace.sight import sightlines
from tlcomm_core.world.radio import is_connected, links
from tlcomm_tools.comparison.perturbation import DEFAULT_NOISE, perturbed

SCENARIOS = Path(__file__).parents[4] / "scenarios"
PLANT = load_scenario(SCENARIOS / "plant.yaml")
CORRIDOR = load_scenario(SCENARIOS / "corridor.yaml")


def starts_m(scenario: Scenario) -> np.ndarray:
    """Return where agents start."""
    return np.array([agent.start[:2] for agent in scenario.agents.values()])


def test_seed_0_is_the_scenario_as_given() -> None:
    """Whatever it says, noise included."""
    assert perturbed(PLANT, 0) is PLANT


@pytest.mark.parametrize("scenario", [PLANT, CORRIDOR], ids=lambda own: own.name)
@pytest.mark.parametrize("seed", range(1, 8))
def test_a_perturbed_scenario_is_valid_and_nearly_the_same(scenario: Scenario, seed: int) -> None:
    """It loads; the team is connected by the planned range; starts are apart, free and near."""
    other = loads(dumps(perturbed(scenario, seed)))
    assert other == perturbed(scenario, seed)
    points_m = starts_m(other)
    assert is_connected(len(points_m), links(points_m, Site.from_scenario(other).planned_range_m))
    assert len({tuple(point) for point in points_m.tolist()}) == len(points_m)
    moved_m = np.hypot(*(points_m - starts_m(scenario)).T)
    assert moved_m.max() <= 3.0 * scenario.workspace.cell_m
    assert other.communication == scenario.communication
    assert other.workspace == scenario.workspace


def test_seeds_differ_and_each_is_always_the_same() -> None:
    """A repetition follows from scenario and seed."""
    texts = [dumps(perturbed(PLANT, seed)) for seed in range(5)]
    assert len(set(texts)) == 5
    assert texts == [dumps(perturbed(PLANT, seed)) for seed in range(5)]


def test_most_agents_start_elsewhere() -> None:
    """As far as the team stays together."""
    for seed in range(1, 8):
        moved_m = np.hypot(*(starts_m(perturbed(PLANT, seed)) - starts_m(PLANT)).T)
        assert (moved_m > 0.0).sum() >= 4


def test_noise_is_that_of_the_scenario_or_a_little() -> None:
    """A scenario without noise gets the default."""
    noisy = PLANT.model_copy(update={"noise": Noise(linear=0.1)})
    assert perturbed(noisy, 1).noise == noisy.noise
    assert perturbed(PLANT, 1).noise == DEFAULT_NOISE


def test_nobody_starts_where_its_task_forbids() -> None:
    """Neither in a region that is forbidden for ever nor in one in which it didn't start."""
    text = (SCENARIOS / "corridor.yaml").read_text("utf-8")
    text = (
        text.replace("regions:", "regions:\n    wet: {at_m: [4.75, 1.75], radius_m: 0.6}", 1)
        .replace("start: [4.75,", "start: [6.25,")
        .replace("start: [4.25,", "start: [5.75,")
    )
    text = text.replace("start: [3.75,", "start: [5.25,").replace("radius_m: 0.6", "radius_m: 0.2")
    scenario = loads(text)
    for agent in ("west", "carrier", "east"):
        own = scenario.agents[agent]
        changed = own.model_copy(update={"task": None, "tasks": (own.task, "!wet")})
        scenario = scenario.model_copy(update={"agents": {**scenario.agents, agent: changed}})
    wet = Site.from_scenario(scenario).grid.locations_within(4.75, 1.75, 0.2)
    assert len(wet) == 1
    for seed in range(1, 30):
        site = Site.from_scenario(perturbed(scenario, seed))
        homes = [site.grid.location_at(*point) for point in starts_m(site.scenario).tolist()]
        assert wet[0] not in homes


def test_a_start_that_is_forbidden_from_the_first_is_refused() -> None:
    """As it is when such a scenario is run."""
    agents = dict(CORRIDOR.agents)
    agents["west"] = agents["west"].model_copy(update={"start": (1.75, 0.75, 0.0)})
    agents["carrier"] = agents["carrier"].model_copy(update={"start": (2.25, 0.75, 0.0)})
    agents["east"] = agents["east"].model_copy(
        update={"start": (2.75, 0.75, 0.0), "task": "G !west_bench & G F (east_bench & inspect)"}
    )
    agents["west"] = agents["west"].model_copy(update={"task": "G !west_bench"})
    with pytest.raises(PlanningError, match="west_bench"):
        perturbed(CORRIDOR.model_copy(update={"agents": agents}), 1)


def test_in_line_of_sight_the_team_sees_each_other() -> None:
    """Where radios don't pass obstacles, connection is by those who see each other."""
    communication = CORRIDOR.communication.model_copy(update={"range_m": 2.0})
    radio = Radio(line_of_sight=True)
    scenario = CORRIDOR.model_copy(update={"communication": communication, "radio": radio})
    for seed in range(1, 20):
        other = perturbed(scenario, seed)
        site, points_m = Site.from_scenario(other), starts_m(other)
        linked = [
            (i, j)
            for i, j in links(points_m, site.planned_range_m)
            if sightlines(site.grid, points_m[i], points_m[j])
        ]
        assert is_connected(len(points_m), linked)


def test_the_fields_drifts_are_ahead_together() -> None:
    """All by the same angle, another one with each seed; also where phases aren't given."""
    assert PLANT.field is not None
    silent = PLANT.field.model_copy(update={"drift": Drift(amplitude=1.0)})
    shifts_rad = set()
    for scenario in (PLANT, PLANT.model_copy(update={"field": silent})):
        before = stations_of(scenario)
        for seed in (1, 2):
            after = stations_of(perturbed(scenario, seed))
            assert after.keys() == before.keys()
            ahead_rad = {after[name] - before[name] for name in before}
            assert max(ahead_rad) - min(ahead_rad) < 1e-9
            assert 0.0 <= max(ahead_rad) < math.tau
            shifts_rad.add(round(max(ahead_rad), 6))
    assert len(shifts_rad) == 2
