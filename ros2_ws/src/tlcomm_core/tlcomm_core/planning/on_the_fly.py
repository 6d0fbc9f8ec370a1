"""What an optimal lasso needs of a transition system, for products too large to be held.

- ``MOST_HELD``, ``MOST_STATES``, ``MOST_READ``   limits
- ``is_large``        whether a product may be too large to be held
- ``check_size``      refuses those that are too large altogether
- ``essential_part``  the steps of the optimal lassos
"""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field, replace
from typing import Final

import numpy as np
from numpy.typing import NDArray

from tlcomm_core.errors import IntractableTaskError
from tlcomm_core.ltl import BuchiAutomaton
from tlcomm_core.planning.lasso import Key, Objective
from tlcomm_core.planning.product_rows import Edges, ProductRows
from tlcomm_core.planning.transition_system import TransitionSystem

__all__ = ["MOST_HELD", "MOST_READ", "MOST_STATES", "check_size", "essential_part", "is_large"]

Bools = NDArray[np.bool_]
Ints = NDArray[np.int64]

MOST_HELD: Final = 1_500_000
MOST_STATES: Final = 5_000_000
MOST_READ: Final = 200_000_000

# Later than any time, and far from overflowing a sum.
_NEVER_NS: Final = 2**61


def is_large(system: TransitionSystem, automaton: BuchiAutomaton) -> bool:
    """Return whether the product may have more than ``MOST_HELD`` edges."""
    return len(system.source) * automaton.state_count > MOST_HELD


def check_size(system: TransitionSystem, automaton: BuchiAutomaton) -> None:
    """See that the product isn't too large to be searched at all.

    Raises:
        IntractableTaskError: it may have more than ``MOST_STATES`` states.
    """
    size = len(system.states) * automaton.state_count
    if size > MOST_STATES:
        raise IntractableTaskError(
            f"the product of {len(system.states)} states of the agent and {automaton.state_count}"
            f" of the task's automaton is larger than {MOST_STATES};"
            " split the task or leave out regions"
        )


def essential_part(
    system: TransitionSystem, automaton: BuchiAutomaton, objective: Objective
) -> TransitionSystem:
    """Return the system with those steps alone that optimal lassos take, its states unchanged.

    The optimal lassos of its product with the automaton are those of the whole product; it has no
    step if no run is accepting. Edges of the product are made when a search comes to their
    source, and dropped again.

    Raises:
        IntractableTaskError: the product may have more than ``MOST_STATES`` states, or the
            searches read more than ``MOST_READ`` edges.

    Source: Section IV-A, nested Dijkstra, as in ``optimal_lasso``; on-the-fly construction as in
        Courcoubetis, Vardi, Wolper and Yannakakis, "Memory-efficient algorithms for the
        verification of temporal properties", 1992; searches that take all states within the
        shortest step's time at once, as in Meyer and Sanders, "Δ-stepping", 2003.
    Cost: one search over all that is reachable; then one per target of an accepting edge, cut off
        at the best lasso so far, and left out where a bound shows that none is better. Memory: 60
        bytes per state, and the edges that are read at a time.
    """
    check_size(system, automaton)
    steps = _Search(ProductRows(system, automaton), objective).essential_steps()
    columns = ("source", "target", "action", "label", "drive_s", "drive_m", "stay_s")
    return replace(system, **{name: getattr(system, name)[steps] for name in columns})


@dataclass(slots=True)
class _Record:
    """The best lassos so far: by the head of each, the edges that close it."""

    key: Key | None = None
    closings: dict[int, list[tuple[int, int]]] = field(default_factory=dict)

    def offer(self, key: Key, head: int, closing: tuple[int, int]) -> None:
        """Take a lasso, by its closing edge's source and step, if none is better."""
        if self.key is None or key < self.key:
            self.key, self.closings = key, {}
        if key == self.key:
            self.closings.setdefault(head, []).append(closing)


class _Search:
    """Ways to accepting edges, and back from their targets, called heads."""

    def __init__(self, rows: ProductRows, objective: Objective) -> None:
        self._rows: Final = rows
        self._objective: Final = objective
        self._first_ns: Final = np.full(rows.size, _NEVER_NS)
        self._around_ns: Final = np.full(rows.size, _NEVER_NS)
        self._touched: list[Ints] = []
        self._read_so_far = 0

    def essential_steps(self) -> Ints:
        """Return the steps of all the best lassos that have the fewest edges, ascending."""
        heads, bounds_ns = self._heads()
        record = self._best(heads, bounds_ns)
        sources = {source for found in record.closings.values() for source, _ in found}
        steps = set(self._steps_between(self._rows.initial, sources, self._first_ns, None))
        for head, closings in record.closings.items():
            component = self._rows.component_of(head)
            for _ in self._around(head, float(self._first_ns[head]), record.key):
                pass
            steps |= {step for _, step in closings}
            goals, root = {source for source, _ in closings}, np.array([head])
            steps |= set(self._steps_between(root, goals, self._around_ns, component))
        return np.array(sorted(steps), dtype=np.int64)

    def _heads(self) -> tuple[Ints, Ints]:
        """Search from the start; return heads, and a time that no cycle through each undercuts."""
        bounds_ns = np.full(self._rows.size, _NEVER_NS)
        for edges in self._explore(self._first_ns, self._rows.initial):
            closing = edges.where(edges.closes)
            around_ns = self._rows.least_out_ns(closing.target)
            around_ns[closing.source == closing.target] = 0
            np.minimum.at(bounds_ns, closing.target, closing.time_ns + around_ns)
        heads = np.flatnonzero(bounds_ns < _NEVER_NS)
        return heads, bounds_ns[heads]

    def _best(self, heads: Ints, bounds_ns: Ints) -> _Record:
        record = _Record()
        # An edge into a head is there at the same time as the head, or later.
        first_ns = self._first_ns[heads].astype(np.float64)
        cycle_ns = bounds_ns.astype(np.float64)
        pending = np.arange(len(heads))
        while len(pending):
            self._charge(len(pending))
            place = pending[self._objective.least(first_ns[pending], cycle_ns[pending])]
            self._close(int(heads[place]), float(first_ns[place]), record)
            pending = pending[pending != place]
            better = self._objective.is_promising(first_ns[pending], cycle_ns[pending], record.key)
            pending = pending[better]
        return record

    def _close(self, head: int, first_ns: float, record: _Record) -> None:
        """Offer the best cycles through a head."""
        into = [
            edges.where(edges.closes & (edges.target == head))
            for edges in self._around(head, first_ns, record.key)
        ]
        found = {
            (source, step): time_ns
            for edges in into
            for source, step, time_ns in zip(
                edges.source.tolist(), edges.step.tolist(), edges.time_ns.tolist(), strict=True
            )
        }
        for (source, step), time_ns in found.items():
            first_ns, cycle_ns = self._first_ns[source] + time_ns, self._around_ns[source] + time_ns
            record.offer(self._objective.key(int(first_ns), int(cycle_ns)), head, (source, step))

    def _around(self, head: int, first_ns: float, key: Key | None) -> Iterator[Edges]:
        """Yield the edges on cycles through a head that may be as good as the best.

        The times from the head are those of the last search alone.
        """
        for keys in self._touched:
            self._around_ns[keys] = _NEVER_NS
        root = np.array([head])
        self._touched = [root]
        limit_ns = self._objective.limit_ns(first_ns, key)
        component = self._rows.component_of(head)
        for edges in self._explore(self._around_ns, root, limit_ns, component):
            reached = edges.target[self._around_ns[edges.target] < _NEVER_NS]
            self._touched.append(np.unique(reached))
            yield edges

    def _explore(
        self,
        times_ns: Ints,
        roots: Ints,
        limit_ns: float = np.inf,
        component: int | None = None,
    ) -> Iterator[Edges]:
        """Yield the edges out of all states within a time from some; the times are filled in.

        An edge may come again, when its source turns out to be nearer than before.
        """
        times_ns[roots] = 0
        pending = roots
        while len(pending):
            ahead_ns = times_ns[pending]
            is_near = ahead_ns <= ahead_ns.min() + self._rows.stride_ns
            near, pending = pending[is_near], pending[~is_near]
            for edges in self._read(near, component):
                arrival_ns = times_ns[edges.source] + edges.time_ns
                better = (arrival_ns < times_ns[edges.target]) & (arrival_ns <= limit_ns)
                improved = edges.target[better]
                np.minimum.at(times_ns, improved, arrival_ns[better])
                pending = np.union1d(pending, improved)
                yield edges

    def _read(self, keys: Ints, component: int | None) -> Iterator[Edges]:
        for edges in self._rows.of(keys, component):
            self._charge(len(edges.source))
            yield edges

    def _charge(self, count: int) -> None:
        self._read_so_far += count
        if self._read_so_far > MOST_READ:
            raise IntractableTaskError(
                f"the search for a plan reads more than {MOST_READ} edges of the product;"
                " split the task or leave out regions"
            )

    def _steps_between(
        self, roots: Ints, goals: Iterable[int], times_ns: Ints, component: int | None
    ) -> Iterator[int]:
        """Yield the steps of shortest paths with the fewest edges from the roots to the goals."""
        missing = np.setdiff1d(np.array(sorted(goals), dtype=np.int64), roots)
        wanted, layers = missing, list[Edges]()
        seen = np.zeros(self._rows.size, dtype=np.bool_)
        seen[roots] = True
        frontier = roots
        while len(missing):
            assert len(frontier), "goals have been reached before"
            layers += (reached := list(self._tight(frontier, seen, times_ns, component)))
            frontier = np.concatenate([edges.target for edges in reached])
            missing = missing[~seen[missing]]
        for edges in reversed(layers):
            taken = np.isin(edges.target, wanted)
            wanted = np.union1d(wanted, edges.source[taken])
            yield from edges.step[taken].tolist()

    def _tight(
        self, frontier: Ints, seen: Bools, times_ns: Ints, component: int | None
    ) -> Iterator[Edges]:
        """Yield one edge of a shortest path to each state that is seen for the first time."""
        for edges in self._read(frontier, component):
            is_tight = times_ns[edges.source] + edges.time_ns == times_ns[edges.target]
            tight = edges.where(is_tight & ~seen[edges.target])
            fresh, index = np.unique(tight.target, return_index=True)
            seen[fresh] = True
            yield tight.where(index)
