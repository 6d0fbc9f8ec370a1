"""Better trees for a team, by joining a few agents anew in the best of all ways.

``regroup``  coalitions round each agent
"""

import numpy as np

from tlcomm_core.game.best_response import CHANGE_TOLERANCE_S
from tlcomm_core.game.links import Neighbourhood
from tlcomm_core.game.search.placement import cheapest_placement
from tlcomm_core.game.search.spanning_tree import spanning_tree
from tlcomm_core.game.search.tree_programme import TreeProgramme

__all__ = ["regroup"]


def regroup(
    programme: TreeProgramme, neighbourhood: Neighbourhood, size: int, rng: np.random.Generator
) -> TreeProgramme:
    """Join a coalition round each agent anew, one after the other.

    A coalition is a subtree. All that hangs on one of its members stays joined to this member and
    follows it, so that its cost is one of the member's. Then the programme over subsets finds the
    best tree and the best places for the members at once.

    Args:
        programme: of a tree with a placement.
        neighbourhood: of the programme's places.
        size: members of a coalition; all agents make up a single one.
        rng: which subtrees are taken.

    Returns:
        The programme of the last tree, which costs no more.

    Cost: for each coalition O(3^size·Z + 2^size·Z·D), with Z the places that may gain anything.
    """
    size = min(size, programme.team)
    for first in range(programme.team if size < programme.team else 1):
        members = _coalition(programme, first, size, rng)
        programme = _rejoined(programme, members, neighbourhood) or programme
    return programme


def _coalition(
    programme: TreeProgramme, first: int, size: int, rng: np.random.Generator
) -> list[int]:
    """Return a random subtree of some agents, one given."""
    members = [first]
    beside = [*programme.neighbours(first)]
    while len(members) < size:
        joining = beside.pop(int(rng.integers(len(beside))))
        beside += [agent for agent in programme.neighbours(joining) if agent not in members]
        members.append(joining)
    return members


def _rejoined(
    programme: TreeProgramme, members: list[int], neighbourhood: Neighbourhood
) -> TreeProgramme | None:
    """Return the programme with the members of a subtree joined best, if that costs less."""
    inside = frozenset(members)
    costs = np.array([programme.costs_of(member, inside) for member in members])
    present = programme.cost()
    least = costs.min(axis=1)
    # Where a member costs more than the others, at their best, leave for it, nothing is gained.
    costs[costs - least[:, None] >= present - least.sum()] = np.inf
    kept = np.flatnonzero(np.isfinite(costs).any(axis=0))
    if not len(kept):
        return None
    placement = cheapest_placement(costs[:, kept], neighbourhood.among(kept))
    if not placement.cost < present - CHANGE_TOLERANCE_S:
        return None
    places = dict(zip(members, kept[list(placement.locations)].tolist(), strict=True))
    return programme.rejoined(members, spanning_tree(places, neighbourhood))
