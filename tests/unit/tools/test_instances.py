"""Round problems for measuring solvers."""

import numpy as np

from support.command import CORRIDOR
from tlcomm_core.scenario.loader import load_scenario
from tlcomm_core.scenario.site import Site
from tlcomm_tools.instances import plant_rounds, random_rounds


def test_random_rounds_are_always_the_same() -> None:
    """Each index has a problem of its own, and it is made the same again."""
    instances = random_rounds(8, 2)
    assert (instances.name, instances.agents, instances.count) == ("random", 8, 2)
    first, again, second = (instances.problem(index) for index in (0, 0, 1))
    assert len(first.candidates) == 8
    assert np.array_equal(first.candidates[3].arrival_s, again.candidates[3].arrival_s)
    assert not np.array_equal(first.locations_m, second.locations_m)


def test_the_workspace_grows_with_the_team() -> None:
    """As many places for each of 16 agents as for each of 8, but for rounding and obstacles."""
    places = [len(random_rounds(agents, 1).problem(0).locations_m) for agents in (8, 16)]
    assert 1.8 < places[1] / places[0] < 2.2


def test_consecutive_rounds_of_a_scenario() -> None:
    """They are numbered from 1 on."""
    site = Site.from_scenario(load_scenario(CORRIDOR))
    instances = plant_rounds(site, 2)
    assert (instances.name, instances.agents) == ("corridor", len(site.scenario.agents))
    assert [instances.problem(index).round for index in range(instances.count)] == [1, 2]
