"""The hall of the gate, whose wall and boxes change at random.

``changing_hall``  one of them
"""

import numpy as np

from support.gate import gate
from tlcomm_core.errors import ScenarioError
from tlcomm_core.scenario.loader import verify
from tlcomm_core.scenario.model import Change, Scenario

__all__ = ["changing_hall"]

# Either gap of the wall may be open, or both; never none.
_WALLS = (
    ((4.0, 0.0, 4.5, 3.5),),
    ((4.0, 0.0, 4.5, 1.0), (4.0, 1.5, 4.5, 3.5)),
    ((4.0, 0.0, 4.5, 1.0), (4.0, 1.5, 4.5, 4.0)),
)


def changing_hall(seed: int) -> Scenario:
    """Return the first such hall from a seed on whose regions always keep a free cell."""
    while True:
        try:
            return verify(_changing(seed))
        except ScenarioError:
            seed += 1000


def _changing(seed: int) -> Scenario:
    """Return the hall with six changes: a wall with some gap, and boxes here and there."""
    rng = np.random.default_rng(seed)
    changes = []
    for at_s in np.sort(rng.uniform(5.0, 180.0, 6)).tolist():
        boxes = list(_WALLS[rng.integers(len(_WALLS))])
        for x, y, width in rng.integers((2, 0, 1), (14, 7, 3), (rng.integers(4), 3)).tolist():
            boxes.append((0.5 * x, 0.5 * y, 0.5 * (x + width), 0.5 * (y + 1)))
        changes.append(Change(at_s=at_s, obstacles_m=tuple(boxes)))
    scenario = gate()
    workspace = scenario.workspace.model_copy(update={"changes": tuple(changes)})
    return scenario.model_copy(update={"workspace": workspace})
