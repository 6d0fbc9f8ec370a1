"""Which places a meeting can't do without.

``cut_places``  those whose loss would leave the others apart
"""

from collections.abc import Iterable

from tlcomm_core.game.links import Links

__all__ = ["cut_places"]


def cut_places(links: Links, places: Iterable[int]) -> frozenset[int]:
    """Return the articulation points of the graph over some places.

    Without one of them, its component of the graph falls apart. How many agents are at a place
    doesn't matter here.

    Source: depth-first search with low points of J. Hopcroft and R. Tarjan, "Algorithm 447:
        efficient algorithms for graph manipulation" (1973).
    Cost: O(places + links).
    """
    graph = links.graph(places)
    depth: dict[int, int] = {}
    cuts: set[int] = set()
    for root in graph:
        if root not in depth:
            cuts |= _cuts_from(root, graph, depth)
    return frozenset(cuts)


def _cuts_from(root: int, graph: dict[int, frozenset[int]], depth: dict[int, int]) -> set[int]:
    """Return the articulation points of the root's component; note every place's depth."""
    depth[root] = 0
    low = {root: 0}
    path = [root]
    ways = [iter(graph[root])]
    cuts: set[int] = set()
    branches = 0
    while path:
        here = path[-1]
        onward = next(ways[-1], None)
        if onward is None:
            path.pop()
            ways.pop()
            if not path:
                break
            above = path[-1]
            low[above] = min(low[above], low[here])
            if above == root:
                branches += 1
            elif low[here] >= depth[above]:
                cuts.add(above)
        elif onward in depth:
            low[here] = min(low[here], depth[onward])
        else:
            depth[onward] = low[onward] = len(path)
            path.append(onward)
            ways.append(iter(graph[onward]))
    return cuts | {root} if branches > 1 else cuts
