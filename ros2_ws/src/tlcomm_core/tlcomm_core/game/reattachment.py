"""Better trees for a team, by joining a part of it to another agent.

``reattach``  what hangs on an edge, tried everywhere else
"""

from collections.abc import Sequence
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from tlcomm_core.game.best_response import CHANGE_TOLERANCE_S
from tlcomm_core.game.links import Neighbourhood
from tlcomm_core.game.spanning_tree import Edge
from tlcomm_core.game.tree_programme import TreeProgramme

__all__ = ["reattach"]


def reattach(programme: TreeProgramme, neighbourhood: Neighbourhood) -> None:
    """Cut each edge of a tree in turn, and join the smaller part to whom it costs least.

    Where that is, is told from what the whole team costs by the place of each agent, less what the
    smaller part adds to it: exact for agents far from the cut, so that only the most promising
    one has to be tried. The programme's cost never rises.

    Args:
        programme: of a tree with a placement; changed in place.
        neighbourhood: of the programme's places.

    Cost: O(N²·Z + (N·log N + E)·Z·D), where E is the length of the paths on which the tree was
        changed, or tried to be.
    """
    everyone = _costs_of_all(programme)
    for edge in programme.edges:
        part, rest = sorted((programme.behind(*edge), programme.behind(*edge[::-1])), key=len)
        if _reattach(programme, neighbourhood, everyone, part, rest):
            everyone = _costs_of_all(programme)


def _costs_of_all(programme: TreeProgramme) -> NDArray[np.float64]:
    return np.array([programme.costs_of(agent) for agent in range(programme.team)])


def _reattach(
    programme: TreeProgramme,
    neighbourhood: Neighbourhood,
    everyone: NDArray[np.float64],
    part: Sequence[int],
    rest: Sequence[int],
) -> bool:
    """Join a part of the tree to another agent of the rest; tell whether that gains anything.

    Both begin with the end of the edge between them.
    """
    present = float(everyone[0].min())
    alone = programme.costs_within(part)
    added = present - float(programme.costs_of(rest[0], frozenset(part[:1])).min())
    each, others = np.array(alone), everyone[list(rest)]
    promised = others.min(axis=0) - added + neighbourhood.least(each.min(axis=0))
    place = int(np.argmin(promised))
    if not promised[place] < present - CHANGE_TOLERANCE_S:
        return False
    host = rest[int(np.argmin(others[:, place]))]
    onward = neighbourhood.cheapest(each.min(axis=0), place)
    guest = part[int(np.argmin(each[:, onward]))]
    return _is_better(programme, (rest[0], part[0]), (host, guest), present)


def _is_better(programme: TreeProgramme, cut: Edge, joint: Edge, present: float) -> bool:
    """Replace an edge by another; take that back unless it gains something."""
    path = programme.path(*joint)
    steps = [*pairwise(path)]
    kept = [step for step in steps if frozenset(step) != frozenset(cut)]
    programme.rejoin(path, [*kept, joint])
    if programme.cost() < present - CHANGE_TOLERANCE_S:
        return True
    programme.rejoin(path, steps)
    return False
