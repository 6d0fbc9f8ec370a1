"""The exact solver against brute force on tiny rounds."""

from itertools import product

import networkx as nx
import numpy as np
import pytest

from tlcomm_core.errors import InfeasibleRoundError
from tlcomm_core.game.algorithm import solve
from tlcomm_core.game.best_response import Scope, best_response
from tlcomm_core.game.links import Links
from tlcomm_core.game.potential import potential
from tlcomm_core.game.problem import Profile, RoundProblem
from tlcomm_core.game.sample import sample_problem
from tlcomm_core.game.search.exact import Share, solve_exactly
from tlcomm_core.game.search.placement import cheapest_placement

SIZES = [(1, 4, 3, 3), (2, 4, 3, 3), (3, 3, 3, 2), (4, 2, 3, 1), (4, 2, 2, 2)]


def least_potential(problem: RoundProblem) -> float:
    """Return the least Φ of all connected team strategies, one by one."""
    opens_s, _ = problem.window_s
    options = [
        [(int(z), int(h)) for h, z in np.argwhere(np.isfinite(own.arrival_s))]
        for own in problem.candidates
    ]
    least_s = np.inf
    for parts in product(*options):
        locations = tuple(z for z, _ in parts)
        if problem.links.is_connected(locations):
            strategies = problem.strategies(Profile(locations, tuple(h for _, h in parts)))
            least_s = min(least_s, potential(strategies, opens_s))
    return least_s


def feasible_problem(size: tuple[int, int, int, int], seed: int) -> RoundProblem:
    """Return a random round that has an initial strategy."""
    rng = np.random.default_rng([seed, *size])
    while True:
        problem = sample_problem(rng, *size)
        try:
            solve(problem)
        except InfeasibleRoundError:
            continue
        return problem


@pytest.mark.parametrize("seed", range(8))
@pytest.mark.parametrize("size", SIZES)
def test_nothing_is_better_than_the_optimum(size: tuple[int, int, int, int], seed: int) -> None:
    """Its Φ is the least of all, it is what its strategies have, and it is proven."""
    problem = feasible_problem(size, seed)
    optimum = solve_exactly(problem, solve(problem).nash)
    opens_s, _ = problem.window_s
    strategies = problem.strategies(optimum.profile)
    assert optimum.potential_s == potential(strategies, opens_s)
    assert optimum.potential_s == pytest.approx(least_potential(problem), abs=1e-6)
    assert optimum.gap_s <= 1e-6
    assert problem.links.is_connected(optimum.profile.location)


@pytest.mark.parametrize("seed", range(10))
def test_the_optimum_is_an_equilibrium(seed: int) -> None:
    """Nobody gains by leaving a global minimum of the potential alone."""
    problem = feasible_problem((5, 4, 5, 4), seed)
    optimum = solve_exactly(problem, solve(problem).nash)
    strategies = problem.strategies(optimum.profile)
    for agent in range(len(strategies)):
        others = strategies[:agent] + strategies[agent + 1 :]
        choice = optimum.profile.choice(agent)
        response = best_response(problem, agent, choice, others, Scope.EVERYWHERE)
        assert response.change_s >= -1e-6


@pytest.mark.parametrize("seed", range(10))
def test_it_starts_anywhere_and_stops_anytime(seed: int) -> None:
    """The start doesn't matter; stopped early, the bound holds and the start isn't lost."""
    problem = feasible_problem((4, 4, 4, 4), seed)
    solution = solve(problem)
    optimum = solve_exactly(problem, solution.initial)
    assert optimum.potential_s == pytest.approx(
        solve_exactly(problem, solution.nash).potential_s, abs=1e-6
    )
    for allowed in range(0, optimum.placements, 3):
        left = iter(range(allowed))
        partial = solve_exactly(
            problem, solution.nash, is_over=lambda left=left: next(left, None) is None
        )
        assert partial.bound_s - 1e-6 <= optimum.potential_s <= partial.potential_s + 1e-6
        assert partial.potential_s <= solution.potentials_s[-1]


@pytest.mark.parametrize("tolerance", [0.0, 0.1, 0.5])
@pytest.mark.parametrize("count", [1, 3, 8])
@pytest.mark.parametrize("seed", range(6))
def test_shares_make_up_the_whole(seed: int, count: int, tolerance: float) -> None:
    """The best of all shares is as near to the optimum as asked for, and their bounds prove it."""
    problem = feasible_problem((5, 4, 5, 4), seed)
    start = solve(problem).initial
    optimum_s = solve_exactly(problem, start).potential_s
    found = [
        solve_exactly(problem, start, Share(index, count), tolerance) for index in range(count)
    ]
    best_s, bound_s = min(own.potential_s for own in found), min(own.bound_s for own in found)
    assert bound_s - 1e-6 <= optimum_s <= best_s + 1e-6
    assert bound_s >= (1.0 - tolerance) * best_s - 1e-6


@pytest.mark.parametrize("seed", range(30))
def test_no_placement_is_cheaper(seed: int) -> None:
    """The cheapest connected placement of up to four agents, over all placements."""
    rng = np.random.default_rng(seed)
    count, places = int(rng.integers(1, 5)), int(rng.integers(1, 7))
    locations_m = rng.uniform(0.0, 3.0, (places, 2))
    costs = np.where(
        rng.uniform(size=(count, places)) < 0.2, np.inf, rng.normal(size=(count, places))
    )
    neighbourhood = Links(locations_m, 1.0).neighbourhood
    best = min(
        (
            float(sum(costs[agent, place] for agent, place in enumerate(chosen)))
            for chosen in product(range(places), repeat=count)
            if connected(locations_m[list(chosen)])
        ),
    )
    placement = cheapest_placement(costs, neighbourhood)
    assert placement.cost == pytest.approx(best)
    if np.isfinite(best):
        assert connected(locations_m[list(placement.locations)])
        assert sum(costs[range(count), placement.locations]) == pytest.approx(best)


def connected(places_m: np.ndarray) -> bool:
    """Tell whether places within 1 m of each other form one graph."""
    distance_m = np.linalg.norm(places_m[:, None] - places_m[None], axis=2)
    return bool(nx.is_connected(nx.from_numpy_array(distance_m <= 1.0)))
