"""Lost time on whole runs against the paper's additional time, summed over the meetings."""

from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest

from support.gate import gate
from support.hall import hall
from tlcomm_core.game.solver import BEST_RESPONSE, DEFAULT, Solver
from tlcomm_core.method import Method
from tlcomm_core.metrics.lost_time import LostTime, lost_time
from tlcomm_core.metrics.meeting import meetings
from tlcomm_core.mission import Mission
from tlcomm_core.records import RunRecords
from tlcomm_core.scenario.generator import random_scenario
from tlcomm_core.scenario.loader import load_scenario
from tlcomm_core.scenario.model import Faults, Noise, Scenario
from tlcomm_core.scenario.site import Site
from tlcomm_core.simulation import simulate

SCENARIOS = Path(__file__).parents[2] / "scenarios"
# What each of some hundred times of events is off by, rounded to nanoseconds on the way.
SLACK_S = 1e-5


def records_of(scenario: Scenario, rounds: int, solver: Solver = DEFAULT) -> RunRecords:
    """Return the records of a run with meetings."""
    return simulate(Mission(Site.from_scenario(scenario), 1, rounds, None, solver)).records


def visiting(scenario: Scenario) -> Scenario:
    """Return a scenario whose agents only visit places, and stay at one for a moment."""
    agents = {
        name: agent.model_copy(update={"task": "G F (a & F (b & X b))"})
        for name, agent in scenario.agents.items()
    }
    return scenario.model_copy(update={"agents": agents})


def summed_s(name: str, lost: LostTime, scenario: Scenario, records: RunRecords) -> Iterator[float]:
    """Yield, for each step, D_c for each meeting before it, with additional time but at t = 0."""
    duration_s = scenario.communication.duration_s
    costs_s = {duration_s: duration_s}
    for meeting in meetings(scenario, records):
        if meeting.starts_s is not None:
            costs_s[meeting.starts_s + duration_s] = meeting.additional_s[name] + duration_s
    for finished_s in lost.finished_s:
        yield sum(cost_s for over_s, cost_s in costs_s.items() if over_s <= finished_s)


@pytest.mark.parametrize(
    ("scenario", "rounds", "solver"),
    [
        (load_scenario(SCENARIOS / "corridor.yaml"), 12, DEFAULT),
        (load_scenario(SCENARIOS / "plant.yaml"), 5, DEFAULT),
        (load_scenario(SCENARIOS / "plant.yaml"), 2, BEST_RESPONSE),
        (visiting(hall(3).scenario), 6, DEFAULT),
        *((random_scenario(np.random.default_rng(seed), 4), 6, DEFAULT) for seed in range(4)),
    ],
    ids=["corridor", "plant", "plain", "visits", *map(str, range(4))],
)
def test_what_is_lost_is_detour_wait_and_duration(
    scenario: Scenario, rounds: int, solver: Solver
) -> None:
    """After each step, by each agent: the identity of ``lost_time``."""
    records = records_of(scenario, rounds, solver)
    found = lost_time(scenario, records)
    assert found.keys() == scenario.agents.keys()
    for name, lost in found.items():
        assert len(lost.finished_s) > rounds
        assert lost.lost_s == pytest.approx(
            list(summed_s(name, lost, scenario, records)), abs=SLACK_S
        )


@pytest.mark.parametrize("name", ["corridor", "plant"])
def test_alone_nothing_is_lost(name: str) -> None:
    """Without meetings each step takes what it takes alone, but for rounding."""
    scenario = load_scenario(SCENARIOS / f"{name}.yaml")
    site = Site.from_scenario(scenario)
    alone = Mission(site, 1, None, 300.0, BEST_RESPONSE, Method.NONE)
    found = lost_time(scenario, simulate(alone).records)
    assert found.keys() == scenario.agents.keys()
    assert {lost_s for lost in found.values() for lost_s in lost.lost_s} == {0.0}


def test_noise_adds_little_and_is_lost() -> None:
    """Speeds off by a fiftieth: by the end the sum is about as large, though not the same."""
    plant = load_scenario(SCENARIOS / "plant.yaml")
    noisy = plant.model_copy(update={"noise": Noise(linear=0.02, angular=0.02)})
    records = records_of(noisy, 5)
    for name, lost in lost_time(noisy, records).items():
        *_, expected_s = summed_s(name, lost, noisy, records)
        assert lost.lost_s[-1] != pytest.approx(expected_s, abs=SLACK_S)
        assert lost.lost_s[-1] == pytest.approx(expected_s, abs=0.02 * lost.finished_s[-1])


def test_failed_actions_are_lost_on_top() -> None:
    """Each attempt that fails costs its agent no less than its time."""
    corridor = load_scenario(SCENARIOS / "corridor.yaml")
    failing = corridor.model_copy(update={"faults": Faults(action_failure=0.3)})
    records = records_of(failing, 12)
    shortest_s = 2.0
    for name, lost in lost_time(failing, records).items():
        failures = [
            record.stamp_ns * 1e-9
            for record in records.tasks
            if record.agent == name and record.event.is_failed_attempt
        ]
        *_, expected_s = summed_s(name, lost, failing, records)
        before = sum(time_s < lost.finished_s[-1] for time_s in failures)
        assert before > 0
        assert lost.lost_s[-1] >= expected_s + before * shortest_s - SLACK_S


def test_where_the_map_changes_the_way_is_one_that_was_open() -> None:
    """Steps behind a door that has closed since are known; nobody wins time by a meeting."""
    records = records_of(gate(), 9, BEST_RESPONSE)
    found = lost_time(gate(), records)
    assert found.keys() == gate().agents.keys()
    for lost in found.values():
        assert np.diff(lost.lost_s).min() > -SLACK_S
        assert lost.lost_s[-1] > 0.0
