"""Runs of random teams, with all that makes rounds hard: the audit looks, and finds no flaw."""

import numpy as np
import pytest

from support.changing_hall import changing_hall
from tlcomm_core.game.solver import BEST_RESPONSE, SOLVERS
from tlcomm_core.method import Method
from tlcomm_core.mission import Mission
from tlcomm_core.scenario.generator import random_scenario
from tlcomm_core.scenario.loader import loads
from tlcomm_core.scenario.model import DriveOverride, Noise, Radio, Scenario
from tlcomm_core.scenario.site import Site
from tlcomm_core.simulation import simulate
from tlcomm_tools.audit.findings import audit_run

PRESS = """
name: press
workspace:
  size_m: [4.0, 2.0]
  cell_m: 0.5
  regions:
    west: {at_m: [0.25, 0.25], radius_m: 0.2}
    press: {at_m: [3.75, 0.25], radius_m: 0.2}
communication: {range_m: 1.0, period_s: 30.0, duration_s: 3.0, on_infeasible: skip}
motion: {linear_mps: 1.0, angular_radps: 1.5}
actions: {look: 2.0, form: 70.0}
agents:
  short: {start: [1.75, 0.25, 0.3], task: "G F (west & look)"}
  long: {start: [2.25, 0.25, 0.0], task: "G F (press & form)"}
"""
NOISE = Noise(linear=0.05, angular=0.05)
DEMANDS = {
    "plain": {},
    "apart": {"separation_m": 0.5},
    "resilient": {"resilience": 1},
    "both": {"separation_m": 0.5, "resilience": 1, "margin_s": 9.0},
}


def random_team(seed: int, demands: dict[str, object]) -> Scenario:
    """Return a random team in a small workspace, off its speeds, with one slow agent."""
    scenario = random_scenario(np.random.default_rng(seed), 3 + seed % 3, size_m=(7.0, 6.0))
    name, slow = next(iter(scenario.agents.items()))
    slower = slow.model_copy(update={"motion": DriveOverride(linear_mps=0.6)})
    period_s = 1.5 * scenario.communication.period_s
    communication = scenario.communication.model_copy(update={"period_s": period_s, **demands})
    return scenario.model_copy(
        update={
            "agents": scenario.agents | {name: slower},
            "communication": communication,
            "noise": NOISE,
        }
    )


def assert_equilibria(scenario: Scenario, method: Method, solver: str, windows: int = 3) -> None:
    """Assert that each strategy of a run is judged, and none is found wanting."""
    until_s = (windows + 0.5) * scenario.communication.period_s
    chosen = method.solver(SOLVERS[solver])
    site = Site.from_scenario(scenario)
    left = simulate(Mission(site, 1, None, until_s, chosen, method))
    found = audit_run(scenario, method, left.records, left.sim_ns)
    assert found.equilibria is not None
    assert (found.equilibria.lacking, found.equilibria.violations) == ((), ())
    assert found.equilibria.judged == found.equilibria.strategies > 1


@pytest.mark.parametrize(("seed", "solver"), [(0, "coalition"), (1, "best-response")])
@pytest.mark.parametrize("name", DEMANDS)
def test_random_teams(seed: int, name: str, solver: str) -> None:
    """With demands on places, by either kind of solver."""
    assert_equilibria(random_team(seed, DEMANDS[name]), Method.TEAM, solver)


def test_random_teams_that_must_see() -> None:
    """Past obstacles, with a longer reach."""
    scenario = random_team(0, {"range_m": 2.0})
    seeing = scenario.model_copy(update={"radio": Radio(line_of_sight=True, loss=0.1)})
    assert_equilibria(seeing, Method.TEAM, "coalition", windows=2)


@pytest.mark.parametrize("method", [Method.STATIC, Method.PAIRWISE, Method.ORACLE])
def test_other_methods(method: Method) -> None:
    """All whose agents choose when to meet."""
    scenario = random_team(1, {"separation_m": 0.5} if method is Method.PAIRWISE else {})
    assert_equilibria(scenario, method, "best-response", windows=5)


@pytest.mark.parametrize("seed", range(2))
def test_maps_that_change(seed: int) -> None:
    """And hide agents from each other."""
    scenario = changing_hall(seed).model_copy(
        update={"noise": NOISE, "radio": Radio(line_of_sight=bool(seed % 2))}
    )
    assert_equilibria(scenario, Method.TEAM, "coalition")


def test_a_team_that_skips_windows() -> None:
    """One action takes longer than two: what is agreed on is for the window after that planned."""
    scenario = loads(PRESS)
    left = simulate(Mission(Site.from_scenario(scenario), 1, None, 200.0))
    offered = {own.round for own in left.records.offers}
    assert {own.strategy.round for own in left.records.strategies} - offered
    assert_equilibria(scenario, Method.TEAM, "coalition", windows=6)


def test_who_keeps_its_place_would_gain_by_another() -> None:
    """Which is no flaw of a static team, but would be of one that chooses places."""
    scenario = random_team(1, {})
    until_s = 3.5 * scenario.communication.period_s
    site = Site.from_scenario(scenario)
    left = simulate(Mission(site, 1, None, until_s, BEST_RESPONSE, Method.STATIC))
    found = [
        audit_run(scenario, method, left.records, left.sim_ns).checks["equilibria"]
        for method in (Method.STATIC, Method.TEAM)
    ]
    assert (found[0], len(found[1]) > 0) == ((), True)
