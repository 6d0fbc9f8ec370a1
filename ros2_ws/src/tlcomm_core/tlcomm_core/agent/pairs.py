"""Who meets whom, and in which windows, where a team meets by pairs.

``Pair``           two agents and their windows
``pairs_of``       a scenario's pairs: a spanning tree of who is linked at the start, coloured
``spanning_tree``  of small degree
``colours``        such that no two links of one agent have the same

In a window each agent can attend one meeting of a pair. So pairs with a member in common take
turns: with links coloured so that those of one agent differ, in C colours, the windows belong to
the colours by turns, 1, …, C, 1, …, and each pair meets in every C-th window. A tree needs no more
colours than its largest degree, and no colouring can do with less. So what counts is a small
degree: along a path each pair meets in every other window, however large the team. More links than
a tree's would carry news on shorter ways, but each of them less often.

What all agents know of a scenario decides, so all of them find the same pairs without a word.

Source: Y. Kantaros, M. Guo and M. M. Zavlanos, "Temporal logic task planning and intermittent
    connectivity control of mobile robot networks", IEEE Trans. Automatic Control, 2019: the teams
    of a connected graph in a schedule of communication events; here each team is a pair. That
    bipartite graphs need as many colours as their largest degree: D. König, 1916.
"""

from collections import deque
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from tlcomm_core.scenario.site import Site
from tlcomm_core.workspace.sight import sightlines
from tlcomm_core.world.radio import distances_m, edges, neighbours, pair_indices

__all__ = ["Pair", "colours", "pairs_of", "spanning_tree"]

Link = tuple[int, int]
"""Two nodes, the lesser first."""

# Below this a degree can't come: a tree of three nodes has a middle.
_LEAST_DEGREE = 2


@dataclass(frozen=True, slots=True)
class Pair:
    """Two agents that meet in every ``stride``-th window, and at t = 0.

    Attributes:
        members: their names, in the scenario's order.
        first: the first window r ≥ 1 that they meet in.
        stride: C, by how many windows each is later than the one before.
    """

    members: tuple[str, str]
    first: int
    stride: int

    def after(self, window: int) -> int:
        """Return the window that they meet in after one of theirs; 0 stands for t = 0."""
        return window + self.stride if window else self.first

    def meets_in(self, window: int) -> bool:
        """Return whether a window r ≥ 1 is one of theirs."""
        return window >= self.first and (window - self.first) % self.stride == 0

    def turn(self, window: int) -> int:
        """Return the number of the meeting in one of their windows, from 0 at t = 0."""
        return -(-window // self.stride)


def pairs_of(site: Site) -> tuple[Pair, ...]:
    """Return a scenario's pairs, by their first windows; none of a single agent.

    Args:
        site: whose agents are connected at the start.
    """
    names = tuple(site.scenario.agents)
    tree = spanning_tree(len(names), _links_at_start(site))
    turns = colours(tree)
    stride = max(turns, default=0) + 1
    pairs = [
        Pair((names[first], names[second]), turn + 1, stride)
        for (first, second), turn in zip(tree, turns, strict=True)
    ]
    return tuple(sorted(pairs, key=lambda pair: (pair.first, pair.members)))


def spanning_tree(count: int, links: Sequence[Link]) -> tuple[Link, ...]:
    """Return a spanning tree whose largest degree is small, sorted.

    It grows from node 0, next to whoever has the fewest links. Then a link of a node of the largest
    degree gives way to another, as long as there is one between two nodes whose degrees are at
    least two less.

    Args:
        count: of nodes, at least one.
        links: of a connected graph.

    Source: the local search of M. Fürer and B. Raghavachari, "Approximating the minimum-degree
        Steiner tree to within one of optimal", J. Algorithms, 1994. (The least degree itself is
        NP-hard to find: 2 stands for a Hamiltonian path.)
    Deviates: single exchanges only, without those that make others possible.
    Cost: O(count² · links).
    """
    tree = _grown(count, links)
    while (exchange := _exchange(count, links, tree)) is not None:
        removed, added = exchange
        tree = (tree - {removed}) | {added}
    return tuple(sorted(tree))


def colours(tree: Sequence[Link]) -> tuple[int, ...]:
    """Return a colour of each link, from 0, so that links with a node in common differ.

    Args:
        tree: the links of a tree.

    Returns:
        As many different ones as the largest degree.
    """
    colour: dict[Link, int] = {}
    adjacent = neighbours(len(tree) + 1, tree)
    ahead = deque([0])
    while ahead:
        node = ahead.popleft()
        known = {colour[link] for other in adjacent[node] if (link := _link(node, other)) in colour}
        free = (number for number in range(len(tree)) if number not in known)
        for other in sorted(adjacent[node]):
            if _link(node, other) not in colour:
                colour[_link(node, other)] = next(free)
                ahead.append(other)
    return tuple(colour[link] for link in tree)


def _links_at_start(site: Site) -> tuple[Link, ...]:
    """Return who hears whom at the start."""
    scenario = site.scenario
    places_m = np.array([agent.start[:2] for agent in scenario.agents.values()])
    linked = distances_m(places_m) <= scenario.communication.range_m
    if scenario.radio.line_of_sight:
        first, second = pair_indices(len(places_m))
        linked &= sightlines(site.grid, places_m[first], places_m[second])
    return edges(len(places_m), linked)


def _grown(count: int, links: Sequence[Link]) -> frozenset[Link]:
    adjacent = neighbours(count, links)
    degree = [0] * count
    inside, tree = {0}, set[Link]()
    while len(inside) < count:
        near, new = min(
            ((node, other) for node in inside for other in adjacent[node] - inside),
            key=lambda ends: (degree[ends[0]], ends),
        )
        degree[near] += 1
        degree[new] += 1
        inside.add(new)
        tree.add(_link(near, new))
    return frozenset(tree)


def _exchange(count: int, links: Sequence[Link], tree: frozenset[Link]) -> tuple[Link, Link] | None:
    """Return a link to remove and one to add, so that fewer nodes have the largest degree."""
    adjacent = neighbours(count, tree)
    largest = max(len(nodes) for nodes in adjacent)
    if largest <= _LEAST_DEGREE:
        return None
    for link in links:
        if link in tree or max(len(adjacent[node]) for node in link) > largest - 2:
            continue
        for node, following in pairwise(_way(adjacent, *link)):
            if len(adjacent[node]) == largest:
                return _link(node, following), link
    return None


def _way(adjacent: Sequence[frozenset[int]], start: int, end: int) -> list[int]:
    """Return the nodes on the way from one node of a tree to another."""
    before = {start: start}
    ahead = deque([start])
    while end not in before:
        node = ahead.popleft()
        for other in adjacent[node] - before.keys():
            before[other] = node
            ahead.append(other)
    way = [end]
    while way[-1] != start:
        way.append(before[way[-1]])
    return way[::-1]


def _link(node: int, other: int) -> Link:
    return (node, other) if node < other else (other, node)
