"""Places that the rules of meetings allow, near to others."""

import numpy as np
import pytest

from support.ruled_rounds import RULES, may_meet, ruled_problem
from tlcomm_core.game.search.adjustment import adjusted_places


@pytest.mark.parametrize("rule", RULES)
@pytest.mark.parametrize("seed", range(6))
def test_adjusted_places_are_admissible(seed: int, rule: str) -> None:
    """Wherever they were wanted, if there are any."""
    problem = ruled_problem(seed, (5, 3, 6, 6), RULES[rule])
    rng = np.random.default_rng(seed)
    costs = rng.uniform(size=(5, len(problem.links)))
    wanted = rng.integers(0, len(problem.links), size=5).tolist()
    places = adjusted_places(problem, costs, wanted, rng.permutation(5).tolist())
    assert places is not None
    assert may_meet(problem, places)


def test_what_is_admissible_stays() -> None:
    """And the agent placed first stays anyway."""
    problem = ruled_problem(1, (3, 3, 4, 4), RULES["apart"])
    costs = np.zeros((3, 16))
    assert adjusted_places(problem, costs, (0, 1, 2), (0, 1, 2)) == (0, 1, 2)
    changed = adjusted_places(problem, costs, (5, 5, 5), (2, 0, 1))
    assert changed is not None
    assert changed[2] == 5
    assert len(set(changed)) == 3


def test_nobody_is_placed_where_it_cannot_be() -> None:
    """An agent that can only be far from the others leaves the team without places."""
    problem = ruled_problem(0, (2, 3, 6, 6), RULES["plain"])
    costs = np.full((2, 36), np.inf)
    costs[0, 0] = costs[1, 35] = 0.0
    assert adjusted_places(problem, costs, (0, 35), (0, 1)) is None
