"""The optimal accepting lasso of a product.

- ``Lasso``          edges of the prefix and of the suffix
- ``optimal_lasso``  least suffix time, then least prefix time, then fewest steps
"""

from dataclasses import dataclass
from typing import Final

import numpy as np
from scipy.sparse.csgraph import connected_components

from tlcomm_core.planning.product import Product
from tlcomm_core.planning.shortest_paths import Arcs, Bools, Floats, Graph, Ints, ShortestPaths

__all__ = ["Lasso", "optimal_lasso"]


@dataclass(frozen=True, slots=True)
class Lasso:
    """An accepting run: edges of the product, taken once and for ever."""

    prefix: tuple[int, ...]
    suffix: tuple[int, ...]


def optimal_lasso(product: Product) -> Lasso | None:
    """Return the best accepting lasso, or None if no run is accepting.

    The suffix is a cycle of least time through at least one accepting edge; among all these, and
    all places to enter them, the prefix has the least time; among those left, the number of edges
    is least. What is still equal is settled by the numbering of states and edges.

    Source: Section IV-A, nested Dijkstra; accepting edges instead of accepting states.
    Cost: one Dijkstra search per distinct target of an accepting edge within a strong component,
        cut off at the best cycle found so far.
    """
    names = np.arange(len(product.source))
    arcs = Arcs(product.source, product.target, product.time_ns, names)
    cycles = _Cycles(product, arcs)
    closing = cycles.best_closing_arcs()
    if not len(closing):
        return None
    entries = cycles.states_on(closing)
    prefixes = _Prefixes(product, arcs)
    return min(
        (
            Lasso(prefixes.path_to(entry), cycles.best_through(entry))
            for entry in prefixes.nearest(entries)
        ),
        key=lambda lasso: len(lasso.prefix) + len(lasso.suffix),
    )


class _Prefixes:
    """Paths from the initial states, which a root outside the product leads to."""

    def __init__(self, product: Product, arcs: Arcs) -> None:
        root = product.size
        zeros = np.zeros_like(product.initial)
        entrance = Arcs(zeros + root, product.initial, zeros, zeros - 1)
        self._paths: Final = ShortestPaths(Graph(root + 1, arcs.joined(entrance)), root)

    def nearest(self, states: Ints) -> list[int]:
        """Return those of some states that are reached first, ascending."""
        times_ns = self._paths.times_ns[states]
        return [int(state) for state in states[times_ns == times_ns.min()]]

    def path_to(self, state: int) -> tuple[int, ...]:
        """Return the edges, without the one from the root."""
        return self._paths.path_to(state)[1:]


class _Cycles:
    """Accepting cycles. Each lies in one strong component, together with its accepting edges."""

    def __init__(self, product: Product, arcs: Arcs) -> None:
        self._size: Final = product.size
        inner = _within_components(product.size, arcs)
        self._arcs: Final = arcs.where(inner)
        self._accepting: Final = arcs.where(inner & product.accepting)
        self._graph: Final = Graph(product.size, self._arcs)

    def best_closing_arcs(self) -> Arcs:
        """Return the accepting edges that close the cycles of least time; none without cycles."""
        closing = self._accepting
        bounds_ns = self._lower_bounds_ns()
        best = np.zeros(len(bounds_ns), dtype=np.bool_)
        best_ns = np.inf
        for head, into in _by_bound(closing.target, bounds_ns):
            if bounds_ns[into].min() > best_ns:
                break
            back_ns = self._graph.times_from(head, best_ns)
            cycle_ns = back_ns[closing.source[into]] + closing.time_ns[into]
            if cycle_ns.min() < best_ns:
                best_ns = cycle_ns.min()
                best[:] = False
            best[into] = cycle_ns == best_ns
        return closing.where(best)

    def states_on(self, closing: Arcs) -> Ints:
        """Return the states on the best cycles, ascending, given all that close them."""
        is_on = np.zeros(self._size, dtype=np.bool_)
        reverse = self._graph.reversed()
        for tail, head in zip(closing.source.tolist(), closing.target.tolist(), strict=True):
            is_on[head] = True
            if tail != head:
                ahead_ns = self._graph.times_from(head)
                is_on |= ahead_ns + reverse.times_from(tail) == ahead_ns[tail]
        return np.flatnonzero(is_on)

    def best_through(self, state: int) -> tuple[int, ...]:
        """Return the best accepting cycle through a state, from there on.

        In two copies of the graph, accepting edges lead from the first to the second: the cycle
        is the shortest path from the state to its copy.
        """
        copy = self._size
        arcs = self._arcs.joined(
            self._arcs.shifted(copy, copy),
            self._accepting.shifted(0, copy),
        )
        return ShortestPaths(Graph(2 * copy, arcs), state).path_to(state + copy)

    def _lower_bounds_ns(self) -> Floats:
        """Return for each accepting edge a time that no cycle through it undercuts."""
        away = self._arcs.where(self._arcs.source != self._arcs.target)
        least_out_ns = np.full(self._size, np.inf)
        np.minimum.at(least_out_ns, away.source, away.time_ns.astype(np.float64))
        closing = self._accepting
        is_loop = closing.source == closing.target
        bounds_ns: Floats = closing.time_ns + np.where(is_loop, 0.0, least_out_ns[closing.target])
        return bounds_ns


def _by_bound(heads: Ints, bounds_ns: Floats) -> list[tuple[int, Ints]]:
    """Return (head, its edges), by the least bound among a head's edges, then by head."""
    order = np.lexsort((bounds_ns, heads))
    states, starts = np.unique(heads[order], return_index=True)
    groups = np.split(order, starts[1:])
    by_bound = np.argsort(bounds_ns[order[starts]], kind="stable")
    return [(int(states[place]), groups[place]) for place in by_bound]


def _within_components(size: int, arcs: Arcs) -> Bools:
    """Tell for each edge whether it lies in a strong component, and so on some cycle."""
    _, component = connected_components(
        Graph(size, arcs).matrix, directed=True, connection="strong"
    )
    within: Bools = component[arcs.source] == component[arcs.target]
    return within
