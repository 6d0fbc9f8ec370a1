"""Random rounds with rules for the places of meetings, and what the rules mean, by brute force.

``RULES``           each rule alone, and together
``ruled_problem``   a random round with some rules, most often behind some walls
``may_meet``        whether places are admissible, from the definitions
"""

from collections.abc import Sequence
from dataclasses import replace
from itertools import combinations

import networkx as nx
import numpy as np

from tlcomm_core.game.links import Links
from tlcomm_core.game.problem import RoundProblem
from tlcomm_core.game.rules import Rules
from tlcomm_core.game.sample import sample_problem

__all__ = ["RULES", "may_meet", "ruled_problem"]

RULES = {
    "plain": Rules(),
    "apart": Rules(separation_m=0.5),
    "far apart": Rules(separation_m=0.7),
    "resilient": Rules(resilience=1),
    "both": Rules(separation_m=0.5, resilience=1),
}
# Share of links that no sight line backs.
_BLIND = 0.15


def ruled_problem(
    seed: int, size: tuple[int, int, int, int], rules: Rules, *, is_blind: bool = False
) -> RoundProblem:
    """Return a random round.

    Args:
        seed: of everything.
        size: agents, tasks, columns and rows of places.
        rules: that hold.
        is_blind: whether some pairs of places are out of sight.
    """
    rng = np.random.default_rng([seed, *size])
    problem = sample_problem(rng, *size)
    links = Links(problem.locations_m, max(problem.range_m, 0.75))
    if is_blind:
        lots = np.triu(rng.uniform(size=(len(links), len(links))))
        seen = lots + lots.T >= _BLIND
        links = Links(links.locations_m, links.range_m, lambda place, others: seen[place, others])
    return replace(problem, links=links, rules=rules)


def may_meet(problem: RoundProblem, places: Sequence[int]) -> bool:
    """Tell whether agents may meet at some places, one for each."""
    graph = nx.Graph()
    graph.add_nodes_from(range(len(places)))
    for one, other in combinations(range(len(places)), 2):
        offset_m = problem.locations_m[places[one]] - problem.locations_m[places[other]]
        if np.hypot(*offset_m) < problem.rules.separation_m - 1e-9:
            return False
        if places[other] in problem.links.near(places[one]):
            graph.add_edge(one, other)
    if not nx.is_connected(graph):
        return False
    if not problem.rules.resilience or len(places) < 3:
        return True
    return all(nx.is_connected(graph.subgraph(set(graph) - {lost})) for lost in list(graph))
