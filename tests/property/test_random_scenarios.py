"""What holds for every generated scenario."""

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from tlcomm_core.scenario.generator import random_scenario
from tlcomm_core.scenario.loader import dumps, loads
from tlcomm_core.scenario.site import Site
from tlcomm_core.workspace.travel import TravelTimes


@settings(max_examples=25, deadline=None)
@given(
    st.integers(0, 2**32 - 1),
    st.integers(1, 20),
    st.sampled_from([(6.0, 6.0), (10.0, 10.0), (20.0, 5.0)]),
    st.sampled_from([0.0, 0.12, 0.3]),
)
def test_generated_scenarios_pass_all_checks_and_leave_time_to_meet(
    seed: int, agents: int, size_m: tuple[float, float], share: float
) -> None:
    """Each loads from its own text, and a period suffices to act and to reach any meeting place."""
    scenario = random_scenario(np.random.default_rng(seed), agents, size_m, obstacle_share=share)
    assert loads(dumps(scenario)) == scenario
    assert len(scenario.agents) == agents
    site = Site.from_scenario(scenario)
    communication = scenario.communication
    for agent in list(scenario.agents)[:3]:
        travel = TravelTimes(site.grid, site.motion_of(agent))
        act_s = max(site.action_durations(agent).values()) + communication.duration_s
        for name, location in site.region_location.items():
            assert name in scenario.workspace.regions
            leg = travel.leg_to(site.start_of(agent), location)
            onward_s = travel.reach(leg.arrival).time_s
            slowest_s = onward_s[np.isfinite(onward_s)].max()
            assert leg.duration_s + act_s + slowest_s <= communication.period_s
