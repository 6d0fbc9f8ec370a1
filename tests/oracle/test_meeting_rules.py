"""The rules for the places of meetings against their definitions, on tiny rounds."""

from itertools import product

import networkx as nx
import numpy as np
import pytest

from support.ruled_rounds import RULES, may_meet, ruled_problem
from tlcomm_core.errors import InfeasibleRoundError
from tlcomm_core.game.algorithm import Solution, solve
from tlcomm_core.game.links import Links
from tlcomm_core.game.potential import potential
from tlcomm_core.game.problem import Profile, RoundProblem
from tlcomm_core.game.resilience import cut_places
from tlcomm_core.game.search.exact import solve_exactly

Size = tuple[int, int, int, int]
SIZES: list[Size] = [(1, 3, 3, 2), (2, 3, 3, 2), (3, 3, 3, 2), (4, 2, 3, 2)]
LARGER: list[Size] = [(6, 5, 6, 5), (9, 4, 6, 6)]
# There is no room for four far apart.
CASES = [(name, size) for name in RULES for size in SIZES if (name, size[0]) != ("far apart", 4)]


def solved(seed: int, size: Size, name: str) -> tuple[RoundProblem, Solution]:
    """Return a random round that has a solution, with it; some places are out of sight."""
    for further in range(200):
        problem = ruled_problem(seed + 1000 * further, size, RULES[name], is_blind=bool(seed % 2))
        try:
            return problem, solve(problem)
        except InfeasibleRoundError:
            continue
    raise AssertionError("no round has a solution")


def least_potential(problem: RoundProblem) -> float:
    """Return the least Φ of all admissible team strategies, one by one."""
    opens_s, _ = problem.window_s
    options = [
        [(int(z), int(h)) for h, z in np.argwhere(np.isfinite(own.arrival_s))]
        for own in problem.candidates
    ]
    meetings = {
        places
        for places in product(*(sorted({z for z, _ in own}) for own in options))
        if may_meet(problem, places)
    }
    least_s = np.inf
    for parts in product(*options):
        locations = tuple(z for z, _ in parts)
        if locations in meetings:
            strategies = problem.strategies(Profile(locations, tuple(h for _, h in parts)))
            least_s = min(least_s, potential(strategies, opens_s))
    return least_s


@pytest.mark.parametrize("seed", range(20))
def test_cut_places_are_the_articulation_points(seed: int) -> None:
    """Of the graph over a random choice of places, whatever its components."""
    rng = np.random.default_rng(seed)
    links = Links(rng.uniform(0.0, 4.0, (30, 2)), 0.9)
    places = rng.choice(30, size=int(rng.integers(1, 30))).tolist()
    graph = nx.Graph((place, other) for place in places for other in links.near(place).tolist())
    graph.remove_edges_from(list(nx.selfloop_edges(graph)))
    assert cut_places(links, places) == set(nx.articulation_points(graph.subgraph(places)))


@pytest.mark.parametrize("seed", range(6))
@pytest.mark.parametrize("name", RULES)
def test_admissible_places_are_as_defined(name: str, seed: int) -> None:
    """For each choice of four agents' places, and for each place that the last may go to."""
    problem = ruled_problem(seed, (4, 2, 3, 2), RULES[name], is_blind=bool(seed % 2))
    everywhere = range(len(problem.links))
    for others in product(everywhere, repeat=3):
        admissible = [may_meet(problem, (*others, place)) for place in everywhere]
        assert [problem.is_admissible((*others, place)) for place in everywhere] == admissible
        if any(admissible):
            assert problem.open_places(others).tolist() == admissible


@pytest.mark.parametrize("seed", range(4))
@pytest.mark.parametrize(("name", "size"), [*CASES, *product(RULES, LARGER)])
def test_all_strategies_on_the_way_are_admissible(name: str, size: Size, seed: int) -> None:
    """From S⁰ to the equilibrium, no place breaks a rule, and Φ falls."""
    problem, solution = solved(seed, size, name)
    for profile in solution.profiles:
        assert may_meet(problem, profile.location)
        assert np.isfinite([s.arrival_s for s in problem.strategies(profile)]).all()
    assert (np.diff(solution.potentials_s) < 0.0).all()


@pytest.mark.parametrize("seed", range(4))
@pytest.mark.parametrize(("name", "size"), CASES)
def test_the_optimum_is_the_least_admissible(name: str, size: Size, seed: int) -> None:
    """Nothing admissible is better, and stopped at any time the bound isn't above it."""
    problem, solution = solved(seed, size, name)
    least_s = least_potential(problem)
    optimum = solve_exactly(problem, solution.initial, most_decisions=10**6)
    assert may_meet(problem, optimum.profile.location)
    assert optimum.potential_s == pytest.approx(least_s, abs=1e-6)
    assert optimum.gap_s <= 1e-6
    for allowed in range(0, optimum.placements, 7):
        left = iter(range(allowed))
        partial = solve_exactly(
            problem, solution.initial, is_over=lambda left=left: next(left, None) is None
        )
        assert partial.bound_s - 1e-6 <= least_s <= partial.potential_s + 1e-6
        assert may_meet(problem, partial.profile.location)


@pytest.mark.parametrize("seed", range(4))
def test_few_decisions_leave_a_gap_but_no_wrong_bound(seed: int) -> None:
    """However early the search gives up on resilience, the optimum isn't below its bound."""
    problem, solution = solved(seed, (4, 2, 3, 2), "both")
    least_s = least_potential(problem)
    for most in range(6):
        partial = solve_exactly(problem, solution.initial, most_decisions=most)
        assert partial.bound_s - 1e-6 <= least_s <= partial.potential_s + 1e-6
