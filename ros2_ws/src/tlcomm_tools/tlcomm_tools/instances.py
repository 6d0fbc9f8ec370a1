"""Round problems for measuring solvers: always the same ones.

``Instances``      some problems of one kind and size
``plant_rounds``   consecutive rounds of a scenario
``random_rounds``  first rounds of random scenarios
``random_site``    such a scenario
``INSTANCES``      how many of which size the published figures are about
"""

import math
from collections.abc import Callable
from dataclasses import dataclass
from types import MappingProxyType
from typing import Final

import numpy as np

from tlcomm_core.game.problem import RoundProblem
from tlcomm_core.scenario.generator import random_scenario
from tlcomm_core.scenario.site import Site
from tlcomm_tools.rounds import pose_first_round, pose_rounds

__all__ = ["INSTANCES", "Instances", "plant_rounds", "random_rounds", "random_site"]

INSTANCES: Final = MappingProxyType({8: 30, 20: 10, 50: 10, 100: 10})
"""Random rounds by number of agents."""

# The workspace grows with the team: this much for each agent.
_AREA_M2: Final = 12.5
_CELL_M: Final = 0.5


@dataclass(frozen=True, slots=True)
class Instances:
    """Some problems of one kind and size.

    Attributes:
        name: for tables.
        agents: N.
        count: how many.
        problem: makes the one of an index, always the same.
    """

    name: str
    agents: int
    count: int
    problem: Callable[[int], RoundProblem]


def plant_rounds(site: Site, count: int) -> Instances:
    """Return the rounds 1 to ``count`` of a scenario, seed 0.

    Raises:
        InputError: the team doesn't get so far.
        PlanningError: an agent's task has no plan.
    """
    problems = pose_rounds(site, count, seed=0)
    return Instances(site.scenario.name, len(site.scenario.agents), count, problems.__getitem__)


def random_rounds(agents: int, count: int) -> Instances:
    """Return the first rounds of random scenarios, whose workspaces grow with the team.

    Args:
        agents: N.
        count: how many; the seeds are 1, 2, ….
    """

    def problem(index: int) -> RoundProblem:
        return pose_first_round(random_site(agents, index))

    return Instances("random", agents, count, problem)


def random_site(agents: int, index: int) -> Site:
    """Return a random scenario, in a workspace that grows with the team.

    Args:
        agents: N.
        index: the seed less one.
    """
    side_m = _CELL_M * round(math.sqrt(agents * _AREA_M2) / _CELL_M)
    rng = np.random.default_rng(index + 1)
    return Site.from_scenario(random_scenario(rng, agents, (side_m, side_m), _CELL_M))
