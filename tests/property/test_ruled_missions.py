"""Whole runs of teams that may not share places, or must be able to lose an agent."""

from collections.abc import Iterable
from itertools import combinations
from pathlib import Path

import networkx as nx
import numpy as np
import pytest

from tlcomm_core.game.solver import BEST_RESPONSE, DEFAULT, Solver
from tlcomm_core.game.strategy import Strategy, TeamStrategy
from tlcomm_core.metrics.connection import connected_intervals
from tlcomm_core.mission import Mission
from tlcomm_core.records import RunRecords
from tlcomm_core.scenario.generator import random_scenario
from tlcomm_core.scenario.loader import load_scenario
from tlcomm_core.scenario.model import DriveOverride, Noise, Radio, Scenario
from tlcomm_core.scenario.site import Site
from tlcomm_core.simulation import simulate
from tlcomm_core.windows import judge_windows

PLANT = Path(__file__).parents[2] / "scenarios" / "plant.yaml"
ROUNDS = 3
DEMANDS = {
    "apart": {"separation_m": 0.5},
    "resilient": {"resilience": 1},
    "far apart": {"separation_m": 0.7},
    "all": {"separation_m": 0.5, "resilience": 1, "margin_s": 12.0},
}


def demanding(scenario: Scenario, name: str) -> Scenario:
    """Return a scenario with demands on its meetings."""
    communication = scenario.communication.model_copy(update=DEMANDS[name])
    return scenario.model_copy(update={"communication": communication})


def random_team(seed: int) -> Scenario:
    """Return a random scenario of four or five agents, the first half as fast as the others."""
    scenario = random_scenario(np.random.default_rng(seed), agents=4 + seed % 2)
    name, slow = next(iter(scenario.agents.items()))
    slower = slow.model_copy(update={"motion": DriveOverride(linear_mps=0.5)})
    longer = {"period_s": 2.0 * scenario.communication.period_s}
    return scenario.model_copy(
        update={
            "agents": scenario.agents | {name: slower},
            "communication": scenario.communication.model_copy(update=longer),
        }
    )


def run(scenario: Scenario, solver: Solver = DEFAULT) -> tuple[RunRecords, int]:
    """Return the records of a run and its end."""
    limit_s = (ROUNDS + 2) * scenario.communication.period_s
    simulated = simulate(Mission(Site.from_scenario(scenario), 1, ROUNDS, limit_s, solver))
    return simulated.records, simulated.sim_ns


def graph(strategies: Iterable[Strategy], range_m: float) -> nx.Graph:
    """Return who is linked to whom at the places of a meeting."""
    linked = nx.Graph()
    linked.add_nodes_from(own.agent for own in strategies)
    linked.add_edges_from(
        (one.agent, other.agent)
        for one, other in combinations(strategies, 2)
        if distance_m(one, other) <= range_m + 1e-9
    )
    return linked


def distance_m(one: Strategy, other: Strategy) -> float:
    """Return how far two places are from each other."""
    return float(np.hypot(one.x_m - other.x_m, one.y_m - other.y_m))


def is_as_demanded(strategy: TeamStrategy, scenario: Scenario) -> bool:
    """Tell whether a meeting is as the scenario demands."""
    demands = scenario.communication
    linked = graph(strategy.strategies, demands.range_m - 2.0 * scenario.position_tolerance_m)
    losses = [{name} for name in linked] if demands.resilience else []
    ends_s = (strategy.round + 1) * demands.period_s
    return (
        all(
            distance_m(one, other) >= demands.separation_m - 1e-9
            for one, other in combinations(strategy.strategies, 2)
        )
        and all(nx.is_connected(linked.subgraph(set(linked) - lost)) for lost in [set(), *losses])
        and strategy.communication_s <= ends_s - demands.margin_s
    )


def assert_kept(scenario: Scenario) -> None:
    """Assert that all meetings of a run are as demanded, and that all of them take place."""
    records, end_ns = run(scenario)
    assert {own.strategy.round for own in records.strategies} == set(range(1, ROUNDS + 2))
    assert all(is_as_demanded(own.strategy, scenario) for own in records.strategies)
    communication = scenario.communication
    windows = judge_windows(
        connected_intervals(records.connectivity, end_ns),
        communication.period_s,
        communication.duration_s,
        end_ns,
    )
    assert [window.satisfied for window in windows[: ROUNDS + 1]] == [True] * (ROUNDS + 1)


@pytest.mark.parametrize("name", DEMANDS)
@pytest.mark.parametrize("seed", range(2))
def test_random_teams_meet_as_demanded(name: str, seed: int) -> None:
    """Whoever is slower, in every round."""
    assert_kept(demanding(random_team(seed), name))


def test_the_plant_meets_as_demanded() -> None:
    """Eight agents, all demands at once."""
    assert_kept(demanding(load_scenario(PLANT), "all"))


def test_without_demands_places_are_shared_and_hang_on_single_agents() -> None:
    """The same plant without them breaks them: what the other tests see isn't there anyway."""
    scenario = load_scenario(PLANT)
    records, _ = run(scenario, BEST_RESPONSE)
    for name in ("apart", "resilient"):
        asked = demanding(scenario, name)
        assert not all(is_as_demanded(own.strategy, asked) for own in records.strategies)


def blind_team(seed: int) -> Scenario:
    """Return a random scenario whose radios reach far, but not past obstacles."""
    scenario = random_team(seed)
    reach = {"range_m": 2.0}
    return scenario.model_copy(
        update={
            "communication": scenario.communication.model_copy(update=reach),
            "radio": Radio(line_of_sight=True),
        }
    )


@pytest.mark.parametrize("seed", range(3))
def test_teams_that_have_to_see_each_other_keep_their_windows(seed: int) -> None:
    """In every round, past all obstacles, off their places as they are."""
    scenario = blind_team(seed)
    assert_kept(scenario.model_copy(update={"noise": Noise(linear=0.05, angular=0.05)}))


def test_meetings_planned_without_sight_would_be_missed(monkeypatch: pytest.MonkeyPatch) -> None:
    """The same teams, planning as if obstacles were no hindrance, lose windows by them."""
    monkeypatch.setattr(Site, "planned_clearance_m", None)
    with pytest.raises(AssertionError):
        keep_all(blind_team(seed) for seed in range(3))


def keep_all(scenarios: Iterable[Scenario]) -> None:
    """Assert that all runs keep their windows."""
    for scenario in scenarios:
        assert_kept(scenario)
