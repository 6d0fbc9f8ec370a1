"""Who is within range of whom, and what that makes of a team.

``pair_indices``  all pairs i < j
``distances_m``   the distance of each pair
``edges``         the pairs that a mask picks
``links``         the pairs within range: the edges of the communication graph
``neighbours``    per node, the nodes that it has an edge with
``diameter``      the most hops between any two nodes
``is_connected``  whether every node reaches every other
"""

from collections.abc import Iterable
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

__all__ = [
    "diameter",
    "distances_m",
    "edges",
    "is_connected",
    "links",
    "neighbours",
    "pair_indices",
]


@lru_cache(maxsize=32)
def pair_indices(count: int) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """Return the first and second members of all pairs i < j, ascending; read-only."""
    first, second = np.triu_indices(count, k=1)
    first.setflags(write=False)
    second.setflags(write=False)
    return first, second


def distances_m(positions_m: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the distance of each pair of nodes.

    The root of the sum of squares, since each of its operations is rounded the same way on every
    machine, which isn't so for ``hypot``.

    Args:
        positions_m: x and y of each node, float[..., N, 2].

    Returns:
        Distances in the order of ``pair_indices``, float[..., N(N-1)/2].
    """
    first, second = pair_indices(positions_m.shape[-2])
    offsets = positions_m.take(second, axis=-2) - positions_m.take(first, axis=-2)
    squares = offsets * offsets
    distances: NDArray[np.float64] = np.sqrt(squares[..., 0] + squares[..., 1])
    return distances


def links(positions_m: NDArray[np.float64], range_m: float) -> tuple[tuple[int, int], ...]:
    """Return the pairs that hear each other: those at most ``range_m`` apart.

    Args:
        positions_m: x and y of each node, float[N, 2].
        range_m: R.

    Returns:
        Index pairs (i, j), i < j, ascending.
    """
    return edges(len(positions_m), distances_m(positions_m) <= range_m)


def edges(count: int, linked: NDArray[np.bool_]) -> tuple[tuple[int, int], ...]:
    """Return the linked pairs of ``count`` nodes, ascending; ``linked`` by ``pair_indices``."""
    first, second = pair_indices(count)
    return tuple(zip(first[linked].tolist(), second[linked].tolist(), strict=True))


def neighbours(count: int, pairs: Iterable[tuple[int, int]]) -> tuple[frozenset[int], ...]:
    """Return the neighbours of each of ``count`` nodes."""
    adjacent: list[set[int]] = [set() for _ in range(count)]
    for first, second in pairs:
        adjacent[first].add(second)
        adjacent[second].add(first)
    return tuple(frozenset(nodes) for nodes in adjacent)


def diameter(count: int, pairs: Iterable[tuple[int, int]]) -> int | None:
    """Return the number of exchanges between neighbours after which all know of all.

    That is the most hops between any two nodes; 0 for a single node or none; None if the nodes
    aren't connected. Cost: O(diameter · (N + E)), on machine words.
    """
    adjacent = neighbours(count, pairs)
    everyone = (1 << count) - 1
    known = [1 << node for node in range(count)]
    exchanges = 0
    while any(mask != everyone for mask in known):
        heard = [_union(known, nodes) | known[node] for node, nodes in enumerate(adjacent)]
        if heard == known:
            return None
        known = heard
        exchanges += 1
    return exchanges


def is_connected(count: int, pairs: Iterable[tuple[int, int]]) -> bool:
    """Tell whether every one of ``count`` nodes reaches every other."""
    adjacent = neighbours(count, pairs)
    reached: set[int] = set()
    frontier = set(range(min(count, 1)))
    while frontier:
        reached |= frontier
        frontier = set().union(*(adjacent[node] for node in frontier)) - reached
    return len(reached) == count


def _union(masks: list[int], nodes: Iterable[int]) -> int:
    union = 0
    for node in nodes:
        union |= masks[node]
    return union
