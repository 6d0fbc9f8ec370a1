"""A team that takes turns is connected at every instant, whatever the scenario."""

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from tlcomm_core.agent.actions import TaskEventKind
from tlcomm_core.agent.member import check_start
from tlcomm_core.errors import PlanningError
from tlcomm_core.method import Method
from tlcomm_core.mission import Mission
from tlcomm_core.scenario.generator import random_scenario
from tlcomm_core.scenario.model import DriveOverride, Faults, Noise, Radio, Scenario
from tlcomm_core.scenario.site import Site
from tlcomm_core.simulation import Simulated, simulate
from tlcomm_tools.audit.findings import audit_run

WINDOWS = 3
_LEAST_MPS = 0.3


def mixed_scenario(seed: int, agents: int, share: float) -> Scenario:
    """Return a random scenario of agents with speeds, headings and places off the grid's own."""
    rng = np.random.default_rng(seed)
    scenario = random_scenario(rng, agents, (6.0, 6.0), obstacle_share=share)
    fleet = {}
    for name, agent in scenario.agents.items():
        x_m, y_m, _ = agent.start
        off_x_m, off_y_m = rng.uniform(-0.1, 0.1, size=2).tolist()
        start = (x_m + off_x_m, y_m + off_y_m, float(rng.uniform(-np.pi, np.pi)))
        motion = DriveOverride(
            linear_mps=float(rng.uniform(_LEAST_MPS, 1.5)),
            angular_radps=float(rng.uniform(0.5, 3.0)),
        )
        fleet[name] = agent.model_copy(update={"start": start, "motion": motion})
    return scenario.model_copy(update={"agents": fleet})


def run(scenario: Scenario, seed: int = 0) -> Simulated:
    """Return a run by turns."""
    mission = Mission(Site.from_scenario(scenario), seed, WINDOWS, None, method=Method.ALL_TIME)
    return simulate(mission)


def assert_together(scenario: Scenario, left: Simulated) -> None:
    """Check by the drives as recorded, apart from the world's own account, that nothing is amiss.

    That is the connection at every instant, whose turn each step is, and that no two act at once.
    """
    audit = audit_run(scenario, Method.ALL_TIME, left.records, left.sim_ns)
    assert audit.violations == ()
    assert all(seen.connected for seen in left.records.connectivity)
    assert any(own.event.kind is TaskEventKind.ACTION_FINISHED for own in left.records.tasks)


@settings(max_examples=12, deadline=None)
@given(st.integers(0, 2**32 - 1), st.integers(1, 8), st.sampled_from([0.0, 0.12, 0.3]))
@example(322083, 2, 0.12)  # The first corner is nearer to the start than a controller's tolerance.
def test_it_is_connected_at_every_instant(seed: int, agents: int, share: float) -> None:
    """With any speeds, headings, places and obstacles; and nobody is later than foreseen, but for
    what who is within the tolerance of a place spares.
    """
    scenario = mixed_scenario(seed, agents, share)
    left = run(scenario)
    assert_together(scenario, left)
    for own in left.records.tasks:
        if own.event.detail.startswith("predicted_s="):
            late_s = float(own.event.detail.rpartition("=")[2])
            assert abs(late_s) < 0.02 / _LEAST_MPS


@settings(max_examples=6, deadline=None)
@given(st.integers(0, 2**32 - 1), st.integers(2, 6))
def test_walls_and_failures_dont_part_it(seed: int, agents: int) -> None:
    """Where agents hear only whom they see, and while some leader begins its action anew."""
    hardships = {"radio": Radio(line_of_sight=True), "faults": Faults(action_failure=0.3)}
    scenario = mixed_scenario(seed, agents, 0.12).model_copy(update=hardships)
    try:
        check_start(Site.from_scenario(scenario), Method.ALL_TIME)
    except PlanningError:
        return
    assert_together(scenario, run(scenario, seed))


@pytest.mark.parametrize("seed", range(3))
def test_neither_do_a_bad_radio_or_slipping_wheels(seed: int) -> None:
    """Loss, delays and doubled messages make turns longer; noise moves agents by centimetres."""
    hardships = {
        "radio": Radio(loss=0.3, jitter_s=0.02, duplication=0.1),
        "noise": Noise(linear=0.02, angular=0.02),
    }
    scenario = mixed_scenario(seed, 4, 0.12).model_copy(update=hardships)
    assert_together(scenario, run(scenario, seed))
