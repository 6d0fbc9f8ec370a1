"""Bounds by a placement's centre against the cheapest placements themselves."""

import numpy as np
import pytest

from tlcomm_core.game.links import Links
from tlcomm_core.game.search.centre_bound import centre_bounds, reach
from tlcomm_core.game.search.placement import cheapest_placement


@pytest.mark.parametrize("separation_m", [0.0, 0.5])
@pytest.mark.parametrize("team", [1, 2, 3, 4, 5, 6, 7])
def test_no_placement_costs_less_than_its_bound(team: int, separation_m: float) -> None:
    """The least bound is at most the optimum; and around the places whose bounds are not above it
    lies an optimal placement, so that the others may be left out.
    """
    rng = np.random.default_rng(team)
    x, y = np.meshgrid(np.arange(7), np.arange(6))
    locations_m = 0.5 * np.column_stack((x.ravel(), y.ravel()))
    near = Links(locations_m, 0.75).neighbourhood_apart(separation_m)
    for _ in range(30):
        costs = rng.exponential(10.0, (team, len(locations_m)))
        costs[rng.uniform(size=costs.shape) < rng.choice([0.1, 0.7])] = np.inf
        optimum = cheapest_placement(costs, near)
        bounds = centre_bounds(costs, near)
        if not np.isfinite(optimum.cost):
            continue
        assert bounds.min() <= optimum.cost + 1e-6
        inside = reach(bounds <= optimum.cost + 1e-6, team, near)
        assert cheapest_placement(np.where(inside, costs, np.inf), near).cost == optimum.cost


def test_the_bound_of_a_line_is_exact() -> None:
    """Where each agent has a place of its own on a line, the bound is the cost of that line."""
    team = 7
    locations_m = np.column_stack((0.5 * np.arange(team), np.zeros(team)))
    near = Links(locations_m, 0.5).neighbourhood
    costs = np.where(np.eye(team, dtype=bool), np.arange(team, dtype=float), np.inf)
    bounds = centre_bounds(costs, near)
    assert bounds[team // 2] == pytest.approx(sum(range(team)))
    assert (np.delete(bounds, team // 2) > 1e5).all()
