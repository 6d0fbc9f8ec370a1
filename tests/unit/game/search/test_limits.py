"""Decisions on single agents."""

import numpy as np

from tlcomm_core.game.links import Links
from tlcomm_core.game.rules import Rules
from tlcomm_core.game.search.limits import Limits, contested

LINE = Links(np.column_stack((0.5 * np.arange(5), np.zeros(5))), 1.0)
COSTS = np.arange(15.0).reshape(3, 5)


def left(limits: Limits, separation_m: float) -> list[list[int]]:
    """Return the places that decisions leave to each agent."""
    costs = limits.applied(COSTS, LINE, separation_m)
    assert (costs[np.isfinite(costs)] == COSTS[np.isfinite(costs)]).all()
    return [np.flatnonzero(np.isfinite(row)).tolist() for row in costs]


def test_an_agent_is_at_a_place_or_it_is_not() -> None:
    """The two ways to decide leave no third."""
    at, away = Limits().decide(1, 2)
    assert left(at, 0.0) == [[0, 1, 2, 3, 4], [2], [0, 1, 2, 3, 4]]
    assert left(away, 0.0) == [[0, 1, 2, 3, 4], [0, 1, 3, 4], [0, 1, 2, 3, 4]]


def test_others_keep_away_from_a_place_that_is_taken() -> None:
    """As far as they must be separated, and from each that is."""
    at, _ = Limits().decide(1, 2)
    assert left(at, 1.0) == [[0, 4], [2], [0, 4]]
    both, _ = at.decide(0, 4)
    assert left(both, 1.0) == [[4], [2], [0]]


def test_whoever_breaks_a_rule_is_decided_on_first() -> None:
    """Then anybody, and nobody once all are."""
    at, _ = Limits().decide(1, 2)
    assert contested(LINE, Rules(separation_m=1.0), (4, 1, 0), Limits()) == 1
    assert contested(LINE, Rules(separation_m=1.0), (4, 2, 1), at) == 2
    assert contested(LINE, Rules(resilience=1), (0, 2, 4), Limits()) == 1
    assert contested(LINE, Rules(resilience=1), (0, 2, 4), at) == 0
    everybody = Limits(kept=((0, 0), (1, 2), (2, 4)))
    assert contested(LINE, Rules(resilience=1), (0, 2, 4), everybody) is None
