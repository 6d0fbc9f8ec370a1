"""Maps that change at random while a team is about its tasks."""

from collections import defaultdict

import numpy as np
import pytest

from support.gate import gate
from tlcomm_core.errors import ScenarioError
from tlcomm_core.mission import Mission
from tlcomm_core.scenario.loader import verify
from tlcomm_core.scenario.model import Change, Scenario
from tlcomm_core.scenario.site import Site
from tlcomm_core.simulation import simulate

# Either gap of the wall may be open, or both; never none.
WALLS = (
    ((4.0, 0.0, 4.5, 3.5),),
    ((4.0, 0.0, 4.5, 1.0), (4.0, 1.5, 4.5, 3.5)),
    ((4.0, 0.0, 4.5, 1.0), (4.0, 1.5, 4.5, 4.0)),
)
END_S = 200.0


def changing(seed: int) -> Scenario:
    """Return the hall with six changes: a wall with some gap, and boxes here and there."""
    rng = np.random.default_rng(seed)
    changes = []
    for at_s in np.sort(rng.uniform(5.0, 180.0, 6)).tolist():
        boxes = list(WALLS[rng.integers(len(WALLS))])
        for x, y, width in rng.integers((2, 0, 1), (14, 7, 3), (rng.integers(4), 3)).tolist():
            boxes.append((0.5 * x, 0.5 * y, 0.5 * (x + width), 0.5 * (y + 1)))
        changes.append(Change(at_s=at_s, obstacles_m=tuple(boxes)))
    scenario = gate()
    workspace = scenario.workspace.model_copy(update={"changes": tuple(changes)})
    return scenario.model_copy(update={"workspace": workspace})


def first_from(seed: int) -> Scenario:
    """Return the first such hall whose regions always keep a free cell."""
    while True:
        try:
            return verify(changing(seed))
        except ScenarioError:
            seed += 1000


@pytest.mark.parametrize("seed", range(6))
def test_nobody_runs_into_anything_and_all_agree(seed: int) -> None:
    """Wherever agents are when cells close, even round them."""
    left = simulate(Mission(Site.from_scenario(first_from(seed)), seed, None, END_S))
    assert left.collisions == {"one": 0, "two": 0}
    held = defaultdict(set)
    for record in left.records.strategies:
        held[record.strategy.round].add(record.strategy)
    assert len(held) >= 4
    assert all(len(strategies) == 1 for strategies in held.values())
