"""Better trees for a team, by joining a part of it to another agent.

``reattach``  what hangs on an edge, tried everywhere else
"""

from collections.abc import Sequence
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from tlcomm_core.game.best_response import CHANGE_TOLERANCE_S
from tlcomm_core.game.links import Neighbourhood
from tlcomm_core.game.search.spanning_tree import Edge
from tlcomm_core.game.search.tree_programme import TreeProgramme

__all__ = ["reattach"]


def reattach(programme: TreeProgramme, neighbourhood: Neighbourhood) -> TreeProgramme:
    """Cut each edge of a tree in turn, and join the smaller part to whom it costs least.

    Where that is, is told from what the whole team costs by the place of each agent, less what the
    smaller part adds to it: exact for agents far from the cut, so that only the most promising
    one has to be tried.

    Args:
        programme: of a tree with a placement.
        neighbourhood: of the programme's places.

    Returns:
        The programme of the last tree, which costs no more.

    Cost: O(N²·Z + (N·log N + E)·Z·D), where E is the length of the paths on which the tree was
        changed, or tried to be.
    """
    everyone = _costs_of_all(programme)
    for edge in programme.edges:
        part, rest = sorted((programme.behind(*edge), programme.behind(*edge[::-1])), key=len)
        changed = _reattached(programme, neighbourhood, everyone, part, rest[0])
        if changed is not None:
            programme = changed
            everyone = _costs_of_all(programme)
    return programme


def _costs_of_all(programme: TreeProgramme) -> NDArray[np.float64]:
    return np.array([programme.costs_of(agent) for agent in range(programme.team)])


def _reattached(
    programme: TreeProgramme,
    neighbourhood: Neighbourhood,
    everyone: NDArray[np.float64],
    part: Sequence[int],
    rest: int,
) -> TreeProgramme | None:
    """Return the programme with a part of the tree joined to another agent, if that costs less.

    Now the first of the part is joined to agent ``rest``.
    """
    present = float(everyone[0].min())
    inside = list(part)
    each = np.array(programme.costs_within(part))
    nearest = each.min(axis=0)
    added = present - float(programme.costs_of(rest, frozenset(part[:1])).min())
    own, everyone[inside] = everyone[inside], np.inf
    promised = everyone.min(axis=0) - added + neighbourhood.least(nearest)
    place = int(np.argmin(promised))
    host = int(np.argmin(everyone[:, place]))
    everyone[inside] = own
    if not promised[place] < present - CHANGE_TOLERANCE_S:
        return None
    guest = part[int(np.argmin(each[:, neighbourhood.cheapest(nearest, place)]))]
    changed = _exchanged(programme, (rest, part[0]), (host, guest))
    return changed if changed.cost() < present - CHANGE_TOLERANCE_S else None


def _exchanged(programme: TreeProgramme, cut: Edge, joint: Edge) -> TreeProgramme:
    """Return the programme with an edge replaced by another that joins the tree's two parts."""
    path = programme.path(*joint)
    kept = [step for step in pairwise(path) if frozenset(step) != frozenset(cut)]
    return programme.rejoined(path, [*kept, joint])
