"""Shortest paths with the fewest edges, and which edges they take.

- ``Arcs``           edges as arrays
- ``Graph``          edges in rows, without parallel ones
- ``ShortestPaths``  all from one root

Times are whole nanoseconds, held as floats: exact up to 2^53 ns (104 days). They may be zero:
scipy takes zeros that are stored in a sparse array for edges.
"""

from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csr_array
from scipy.sparse.csgraph import breadth_first_order, dijkstra

__all__ = ["Arcs", "Graph", "ShortestPaths"]

Bools = NDArray[np.bool_]
Floats = NDArray[np.float64]
Ints = NDArray[np.int64]


@dataclass(frozen=True, slots=True, eq=False)
class Arcs:
    """Edges; several may be parallel.

    Attributes:
        source: int[E].
        target: int[E].
        time_ns: int[E].
        name: what the caller calls each edge, int[E].
    """

    source: Ints
    target: Ints
    time_ns: Ints
    name: Ints

    def __len__(self) -> int:
        """Return the number of edges."""
        return len(self.source)

    def where(self, chosen: Bools | Ints) -> "Arcs":
        """Return some of the edges, by mask or index."""
        columns = (self.source, self.target, self.time_ns, self.name)
        return Arcs(*(column[chosen] for column in columns))

    def joined(self, *others: "Arcs") -> "Arcs":
        """Return these edges and those of the others."""
        every = (self, *others)
        return Arcs(
            source=np.concatenate([arcs.source for arcs in every]),
            target=np.concatenate([arcs.target for arcs in every]),
            time_ns=np.concatenate([arcs.time_ns for arcs in every]),
            name=np.concatenate([arcs.name for arcs in every]),
        )


class Graph:
    """Edges by source, then target; of parallel ones the fastest, the first of equals.

    Attributes:
        size: number of states N.
        arcs: the edges kept, in order.
        first_arc: index of each state's first edge, int[N + 1].
        matrix: times by source and target.
    """

    def __init__(self, size: int, arcs: Arcs) -> None:
        """Sort and thin out. Cost: O(N + E)."""
        self.size: Final = size
        order = _by(size, arcs.target)
        order = order[_by(size, arcs.source[order])]
        pairs = arcs.source[order] * size + arcs.target[order]
        self.arcs: Final = arcs.where(order[_fastest(pairs, arcs.time_ns[order])])
        self.first_arc: Final = np.searchsorted(self.arcs.source, np.arange(size + 1))
        times_ns = self.arcs.time_ns.astype(np.float64)
        self.matrix: Final = self._csr(times_ns, self.arcs.target, self.first_arc)

    def times_from(self, root: int, limit_ns: float = np.inf) -> Floats:
        """Return the least time from one state to each, float[N]; inf beyond the limit."""
        times_ns: Floats = dijkstra(self.matrix, indices=[root], limit=limit_ns)[0]
        return times_ns

    def subgraph(self, chosen: Bools) -> csr_array:
        """Return the structure that some of the edges make, all with weight 1."""
        kept = np.append(0, np.cumsum(chosen))[self.first_arc]
        targets = self.arcs.target[chosen]
        return self._csr(np.ones(len(targets)), targets, kept)

    def name_of(self, source: int, target: int) -> int:
        """Return the name of the edge between two states."""
        start, end = self.first_arc[source : source + 2]
        return int(self.arcs.name[start + np.searchsorted(self.arcs.target[start:end], target)])

    @staticmethod
    def _csr(weights: Floats, targets: Ints, starts: Ints) -> csr_array:
        content = (weights, targets.astype(np.int32), starts.astype(np.int32))
        return csr_array(content, shape=(len(starts) - 1, len(starts) - 1))


class ShortestPaths:
    """Paths of least time from one root; of these, ones with the fewest edges.

    Attributes:
        times_ns: to each state, float[N]; inf where no path leads.
    """

    def __init__(self, graph: Graph, root: int) -> None:
        """Search. Cost: one Dijkstra and one breadth-first search."""
        self._graph: Final = graph
        self._root: Final = root
        self.times_ns: Final = graph.times_from(root)
        arcs = graph.arcs
        reached_ns = self.times_ns[arcs.source]
        # A path is shortest exactly if each of its edges is tight.
        tight = np.isfinite(reached_ns) & (reached_ns + arcs.time_ns == self.times_ns[arcs.target])
        _, previous = breadth_first_order(graph.subgraph(tight), root, return_predecessors=True)
        self._previous: Final = previous

    def path_to(self, state: int) -> tuple[int, ...]:
        """Return the names of the edges from the root to a state that can be reached."""
        names: list[int] = []
        while state != self._root:
            previous = int(self._previous[state])
            names.append(self._graph.name_of(previous, state))
            state = previous
        return tuple(reversed(names))


def _by(size: int, states: Ints) -> Ints:
    """Return the stable order of edges by one of their states: a counting sort."""
    count = len(states)
    content = (np.arange(count), states.astype(np.int32), np.arange(count + 1, dtype=np.int32))
    order: Ints = csr_array(content, shape=(count, size)).tocsc().data
    return order


def _fastest(pairs: Ints, times_ns: Ints) -> Ints:
    """Return the index of the fastest of each run of equal pairs, the first of equals."""
    if not len(pairs):
        return np.arange(0)
    is_new = np.diff(pairs, prepend=-1) != 0
    least_ns = np.minimum.reduceat(times_ns, np.flatnonzero(is_new))
    run = np.cumsum(is_new) - 1
    fastest = np.flatnonzero(times_ns == least_ns[run])
    firsts: Ints = fastest[np.diff(run[fastest], prepend=-1) != 0]
    return firsts
