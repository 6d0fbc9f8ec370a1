"""The optimal accepting lasso of a product.

- ``Objective``      what is to be least, exactly: ``Key``
- ``SUFFIX_FIRST``   the paper's
- ``Key``            a lasso's value by an objective
- ``Lasso``          edges of the prefix and of the suffix
- ``optimal_lasso``  the best one, exactly
"""

from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from typing import Final

import numpy as np
from scipy.sparse.csgraph import connected_components

from tlcomm_core.planning.product import Product
from tlcomm_core.planning.shortest_paths import Arcs, Bools, Floats, Graph, Ints, ShortestPaths

__all__ = ["SUFFIX_FIRST", "Key", "Lasso", "Objective", "optimal_lasso"]

Key = tuple[Fraction | int, ...]

# Far above the rounding of one product and one sum, as a share.
_ROUNDING: Final = 1e-12


@dataclass(frozen=True, slots=True)
class Objective:
    """What a lasso is chosen by: its suffix's time C and the time T of its first satisfaction.

    T is when the run first completes an accepting edge of its suffix: where the prefix of the
    paper, which leads to an accepting state, ends.

    Attributes:
        gamma: γ > 0 of T + γ·C; ``None`` for the least C, and the least T only among these.
    """

    gamma: Fraction | None = None

    def key(self, first_ns: int, cycle_ns: int) -> Key:
        """Return what is to be least, exactly, in lexicographic order."""
        if self.gamma is None:
            return (cycle_ns, first_ns)
        return (first_ns + self.gamma * cycle_ns,)

    def is_promising(self, first_ns: Floats, cycle_ns: Floats, best: Key | None) -> Bools:
        """Tell which pairs (T, C) may be as good as the best so far; rounding never drops one."""
        if best is None:
            return np.isfinite(cycle_ns)
        if self.gamma is None:
            best_cycle_ns, best_first_ns = map(float, best)
            is_equal = cycle_ns == best_cycle_ns
            may_be: Bools = (cycle_ns < best_cycle_ns) | (is_equal & (first_ns <= best_first_ns))
            return may_be
        bound_ns = float(best[0]) * (1.0 + _ROUNDING)
        promising: Bools = first_ns + float(self.gamma) * cycle_ns <= bound_ns
        return promising

    def least(self, first_ns: Floats, cycle_ns: Floats) -> int:
        """Return the index of the best of some pairs (T, C), but for rounding."""
        if self.gamma is None:
            first_ns = np.where(cycle_ns == cycle_ns.min(), first_ns, np.inf)
            return int(first_ns.argmin())
        return int((first_ns + float(self.gamma) * cycle_ns).argmin())

    def limit_ns(self, first_ns: float, best: Key | None) -> float:
        """Return a time that no cycle exceeds which is as good as the best, given the least T."""
        if best is None:
            return np.inf
        if self.gamma is None:
            return float(best[0])
        return (float(best[0]) * (1.0 + _ROUNDING) - first_ns) / float(self.gamma) + 1.0


SUFFIX_FIRST: Final = Objective()


@dataclass(frozen=True, slots=True)
class Lasso:
    """An accepting run: edges of the product, taken once and for ever."""

    prefix: tuple[int, ...]
    suffix: tuple[int, ...]


def optimal_lasso(product: Product, objective: Objective = SUFFIX_FIRST) -> Lasso | None:
    """Return the best accepting lasso, or None if no run is accepting.

    Among runs that are equal by the objective, the number of edges up to the first satisfaction
    and in the suffix is least. What is still equal is settled by the numbering of states and
    edges. The suffix is told from where the run first enters its states.

    Source: Section IV-A, nested Dijkstra; accepting edges instead of accepting states.
    Deviates: the prefix is judged by the time of the first satisfaction, not of the entry into
        the cycle. An entry may come early for no use: passing through a place on the cycle, at
        the far end of what the task has to do, only to be turned the right way.
    Cost: one Dijkstra search for the prefixes and one per distinct target of an accepting edge
        within a strong component, cut off at the best lasso so far, and left out where bounds
        from the searches before show that none is better.
    """
    search = _Search(product, objective)
    return min(search.best_lassos(), key=lambda found: found[0], default=(0, None))[1]


@dataclass(slots=True)
class _Record:
    """The accepting edges that close the best lassos so far."""

    key: Key | None
    indices: list[int]

    def offer(self, key: Key, index: int) -> None:
        """Take an edge if none is better."""
        if self.key is None or key < self.key:
            self.key, self.indices = key, []
        if key == self.key:
            self.indices.append(index)


class _Search:
    """Accepting cycles, each in one strong component, and the ways into them.

    A root outside the product leads to the initial states.
    """

    def __init__(self, product: Product, objective: Objective) -> None:
        root = product.size
        names = np.arange(len(product.source))
        arcs = Arcs(product.source, product.target, product.time_ns, names)
        zeros = np.zeros_like(product.initial)
        entrance = Arcs(zeros + root, product.initial, product.initial_ns, zeros - 1)
        graph = Graph(root + 1, arcs.joined(entrance))
        component = _strong_components(graph)
        self._objective: Final = objective
        self._product: Final = product
        self._prefixes: Final = ShortestPaths(graph, root)
        within = component[graph.arcs.source] == component[graph.arcs.target]
        self._inner: Final = Graph(graph.size, graph.arcs.where(within))
        is_closing = product.accepting & (component[arcs.source] == component[arcs.target])
        self._closing: Final = arcs.where(is_closing)
        self._first_ns: Final = (
            self._prefixes.times_ns[self._closing.source] + self._closing.time_ns
        )

    def best_lassos(self) -> Iterator[tuple[int, Lasso]]:
        """Yield the lassos of the edges that are equally best, with their steps before folding."""
        heads: dict[int, ShortestPaths] = {}
        for index in sorted(self._best_closings()):
            source, head = int(self._closing.source[index]), int(self._closing.target[index])
            if head not in heads:
                heads[head] = ShortestPaths(self._inner, head)
            there, back = self._prefixes.path_to(source)[1:], heads[head].path_to(source)
            closing = int(self._closing.name[index])
            yield len(there) + len(back), self._folded(there, (*back, closing))

    def _best_closings(self) -> list[int]:
        """Return the edges that close the best lassos, by index into the closing ones."""
        closing, first_ns, objective = self._closing, self._first_ns, self._objective
        record = _Record(None, [])
        bounds_ns = self._lower_bounds_ns()
        pending = np.flatnonzero(objective.is_promising(first_ns, bounds_ns, None))
        while len(pending):
            least = pending[objective.least(first_ns[pending], bounds_ns[pending])]
            head = closing.target[least]
            is_here = closing.target[pending] == head
            here, pending = pending[is_here], pending[~is_here]
            limit_ns = objective.limit_ns(first_ns[here].min(), record.key)
            back_ns = self._inner.times_from(int(head), limit_ns)
            self._compare(here, back_ns, record)
            self._raise_bounds(bounds_ns, pending, back_ns, limit_ns)
            better = objective.is_promising(first_ns[pending], bounds_ns[pending], record.key)
            pending = pending[better]
        return record.indices

    def _raise_bounds(
        self, bounds_ns: Floats, pending: Ints, from_ns: Floats, limit_ns: float
    ) -> None:
        """Raise bounds, in place, by the triangle inequality with the times from one state."""
        closing = self._closing.where(pending)
        known = np.isfinite(from_ns[closing.target])
        pending, closing = pending[known], closing.where(known)
        # Beyond the limit the times are longer than the limit.
        ahead_ns = np.minimum(from_ns[closing.source], limit_ns)
        there_ns = closing.time_ns + ahead_ns - from_ns[closing.target]
        bounds_ns[pending] = np.maximum(bounds_ns[pending], there_ns)

    def _compare(self, here: Ints, back_ns: Floats, record: _Record) -> None:
        """Offer the edges into one state, given the times from there."""
        first_ns = self._first_ns[here]
        cycle_ns = back_ns[self._closing.source[here]] + self._closing.time_ns[here]
        # The best first: it leaves few of the others to be compared exactly.
        least = self._objective.least(first_ns, cycle_ns)
        for chosen in (np.arange(len(here)) == least, np.arange(len(here)) != least):
            promising = chosen & np.isfinite(cycle_ns)
            promising &= self._objective.is_promising(first_ns, cycle_ns, record.key)
            for place in np.flatnonzero(promising).tolist():
                key = self._objective.key(int(first_ns[place]), int(cycle_ns[place]))
                record.offer(key, int(here[place]))

    def _folded(self, there: tuple[int, ...], cycle: tuple[int, ...]) -> Lasso:
        """Return the run along a path and then a cycle, told from the first state on the cycle.

        Both follow shortest paths, so that from there on the cycle takes as long as the path.
        """
        source, target = self._product.source, self._product.target
        on_cycle = {int(source[edge]): place for place, edge in enumerate(cycle)}
        for length, edge in enumerate(there):
            place = on_cycle.get(int(source[edge]))
            if place is not None:
                return Lasso(there[:length], cycle[place:] + cycle[:place])
        place = on_cycle[int(source[cycle[-1]])]
        assert not there or target[there[-1]] == source[cycle[-1]], "the path leads to the cycle"
        return Lasso(there, cycle[place:] + cycle[:place])

    def _lower_bounds_ns(self) -> Floats:
        """Return for each accepting edge a time that no cycle through it undercuts."""
        arcs, closing = self._inner.arcs, self._closing
        away = arcs.where(arcs.source != arcs.target)
        least_out_ns = np.full(self._inner.size, np.inf)
        np.minimum.at(least_out_ns, away.source, away.time_ns.astype(np.float64))
        is_loop = closing.source == closing.target
        bounds_ns: Floats = closing.time_ns + np.where(is_loop, 0.0, least_out_ns[closing.target])
        return bounds_ns


def _strong_components(graph: Graph) -> Ints:
    """Return the number of each state's strong component."""
    _, component = connected_components(graph.matrix, directed=True, connection="strong")
    numbers: Ints = component.astype(np.int64)
    return numbers
