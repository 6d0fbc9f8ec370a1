"""The game's solvers against brute force on tiny rounds."""

from collections.abc import Iterator
from itertools import product

import networkx as nx
import numpy as np
import pytest

from tlcomm_core.errors import InfeasibleRoundError
from tlcomm_core.game.algorithm import solve
from tlcomm_core.game.best_response import Scope, best_response
from tlcomm_core.game.initial import initial_profile
from tlcomm_core.game.potential import potential
from tlcomm_core.game.problem import Profile, RoundProblem
from tlcomm_core.game.sample import sample_problem

Part = tuple[int, int]
SEEDS = range(40)


def parts(problem: RoundProblem, agent: int) -> list[Part]:
    """Return all admissible (location, candidate) of an agent."""
    own = problem.candidates[agent]
    known = np.argwhere(np.isfinite(own.arrival_s.T)).tolist()
    return [(location, candidate) for location, candidate in known]


def phi(problem: RoundProblem, profile: tuple[Part, ...]) -> float:
    """Return Φ as the paper writes it."""
    tables = problem.candidates
    times = [own.arrival_s[h, z] for own, (z, h) in zip(tables, profile, strict=True)]
    extra = [own.extra_s[h, z] for own, (z, h) in zip(tables, profile, strict=True)]
    t_c = max(problem.window_s[0], *times)
    return float(sum(d + (t_c - t) for d, t in zip(extra, times, strict=True)))


def connected(problem: RoundProblem, profile: tuple[Part, ...]) -> bool:
    """Tell whether the places form a connected graph."""
    places = problem.locations_m[[z for z, _ in profile]]
    graph = nx.Graph()
    graph.add_nodes_from(range(len(places)))
    graph.add_edges_from(
        (i, j)
        for i, j in product(range(len(places)), repeat=2)
        if np.hypot(*(places[i] - places[j])) <= problem.range_m + 1e-9
    )
    return bool(nx.is_connected(graph))


def of(profile: Profile) -> tuple[Part, ...]:
    """Return a profile agent by agent."""
    return tuple(zip(profile.location, profile.candidate, strict=True))


def deviations(
    problem: RoundProblem, profile: tuple[Part, ...], agent: int
) -> Iterator[tuple[float, Part]]:
    """Yield Φ and the agent's part for each of its connected deviations."""
    for part in parts(problem, agent):
        switched = (*profile[:agent], part, *profile[agent + 1 :])
        if connected(problem, switched):
            yield phi(problem, switched), part


@pytest.mark.parametrize("seed", SEEDS)
def test_the_initial_strategy_is_the_best_common_place(seed: int) -> None:
    """No place and no choice of tasks at it has a smaller potential than S⁰."""
    rng = np.random.default_rng(seed)
    problem = sample_problem(rng, int(rng.integers(1, 5)), 4, 3, 3)
    options = [
        phi(problem, combination)
        for place in range(len(problem.locations_m))
        for combination in product(
            *(
                [part for part in parts(problem, agent) if part[0] == place]
                for agent in range(len(problem.agents))
            )
        )
    ]
    if not options:
        with pytest.raises(InfeasibleRoundError):
            initial_profile(problem)
        return
    profile = initial_profile(problem)
    assert len(set(profile.location)) == 1
    assert phi(problem, of(profile)) == pytest.approx(min(options), abs=1e-9)


@pytest.mark.parametrize("seed", SEEDS)
def test_no_agent_gains_by_leaving_the_equilibrium(seed: int) -> None:
    """Of all unilateral connected deviations inside the window none lowers the potential."""
    rng = np.random.default_rng(seed)
    problem = sample_problem(rng, int(rng.integers(2, 7)), 5, 6, 5)
    try:
        solution = solve(problem)
    except InfeasibleRoundError:
        pytest.skip("an infeasible sample")
    nash = of(solution.nash)
    value_s = phi(problem, nash)
    assert solution.search.is_equilibrium
    assert value_s == pytest.approx(solution.potentials_s[-1], abs=1e-9)
    for agent in range(len(nash)):
        assert min(deviations(problem, nash, agent))[0] >= value_s - 1e-8


@pytest.mark.parametrize("seed", SEEDS)
def test_a_best_response_is_the_best_deviation(seed: int) -> None:
    """Change, place and candidate are those of brute force, in the ball and everywhere."""
    rng = np.random.default_rng(seed)
    problem = sample_problem(rng, int(rng.integers(2, 6)), 5, 6, 5)
    try:
        profile = initial_profile(problem)
    except InfeasibleRoundError:
        pytest.skip("an infeasible sample")
    strategies = problem.strategies(profile)
    for agent, scope in product(range(len(strategies)), Scope):
        others = strategies[:agent] + strategies[agent + 1 :]
        response = best_response(problem, agent, profile.choice(agent), others, scope)
        here_m = problem.locations_m[profile.location[agent]]
        least_s = min(
            value_s
            for value_s, (place, _) in deviations(problem, of(profile), agent)
            if scope is Scope.EVERYWHERE
            or np.hypot(*(problem.locations_m[place] - here_m)) <= problem.range_m + 1e-9
        )
        present_s = potential(strategies, problem.window_s[0])
        switched = profile.switched(agent, response.choice)
        assert response.change_s == pytest.approx(least_s - present_s, abs=1e-9)
        assert phi(problem, of(switched)) == pytest.approx(least_s, abs=1e-9)
        assert connected(problem, of(switched))


@pytest.mark.parametrize("seed", range(12))
def test_the_optimum_bounds_the_equilibrium(seed: int) -> None:
    """The best of all team strategies costs at most what the equilibrium does, and that S⁰."""
    problem = sample_problem(np.random.default_rng(seed), 3, 3, 3, 2)
    try:
        solution = solve(problem)
    except InfeasibleRoundError:
        pytest.skip("an infeasible sample")
    optimum_s = min(
        phi(problem, profile)
        for profile in product(*(parts(problem, agent) for agent in range(3)))
        if connected(problem, profile)
    )
    assert optimum_s <= solution.potentials_s[-1] + 1e-9
    assert solution.potentials_s[-1] <= solution.potentials_s[0]
