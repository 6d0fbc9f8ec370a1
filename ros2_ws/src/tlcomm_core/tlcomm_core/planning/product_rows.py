"""A product's rows, made when they are asked for and not kept.

- ``Edges``        edges that leave some product states
- ``ProductRows``  makes them
"""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from tlcomm_core.ltl import BuchiAutomaton
from tlcomm_core.ltl.automaton import strong_components
from tlcomm_core.planning.moves import Moves, ranges
from tlcomm_core.planning.product import ticks_ns
from tlcomm_core.planning.relaxation import Strict
from tlcomm_core.planning.transition_system import TransitionSystem

__all__ = ["Edges", "ProductRows"]

Bools = NDArray[np.bool_]
Ints = NDArray[np.int64]

# Edges in memory at a time; a single state may have more.
_MOST_AT_ONCE: Final = 300_000


@dataclass(frozen=True, slots=True)
class Edges:
    """Edges of the product, states as keys.

    Attributes:
        source: int[E].
        target: int[E].
        step: the transition system's step, int[E].
        time_ns: int[E].
        closes: whether the edge may close an accepting cycle: it takes an accepting transition
            within a strong component of the automaton, bool[E].
    """

    source: Ints
    target: Ints
    step: Ints
    time_ns: Ints
    closes: Bools

    def where(self, chosen: Bools | Ints) -> "Edges":
        """Return some of them, by mask or index."""
        return Edges(
            source=self.source[chosen],
            target=self.target[chosen],
            step=self.step[chosen],
            time_ns=self.time_ns[chosen],
            closes=self.closes[chosen],
        )


class ProductRows:
    """The edges out of any product state.

    The key of (state s, automaton state q) is s·|Q| + q.

    Attributes:
        size: number of keys; not all need be reachable.
        initial: product states after reading the initial label, ascending.
        stride_ns: a step takes at least this long, or no time.
    """

    def __init__(self, system: TransitionSystem, automaton: BuchiAutomaton) -> None:
        """Prepare. Cost: linear in the system's steps and the automaton's edges."""
        self._target: Final = system.target
        self._time_ns: Final = ticks_ns(system.time_s)
        self._first_step: Final = np.searchsorted(system.source, np.arange(len(system.states) + 1))
        self._moves: Final = Moves(Strict(automaton), system.labels)
        self._label: Final = system.label
        self._count: Final = automaton.state_count
        targets = [[edge.target for edge in row] for row in automaton.transitions]
        self._component: Final = np.array(strong_components(targets), dtype=np.int64)
        self.size: Final = len(system.states) * self._count
        states = np.array([automaton.initial])
        first, _ = self._moves.of(states, np.array([system.initial_label]))
        # The transition system's initial state is number 0.
        self.initial: Final = np.unique(self._moves.targets(first))
        lasting_ns = self._time_ns[self._time_ns > 0]
        self.stride_ns: Final = int(lasting_ns.min()) if len(lasting_ns) else 0
        self._least_out_ns: Final = self._least_by_state()

    def least_out_ns(self, keys: Ints) -> Ints:
        """Return for some product states a time that no edge out of them undercuts."""
        least_ns: Ints = self._least_out_ns[keys // self._count]
        return least_ns

    def of(self, keys: Ints, component: int | None = None) -> Iterator[Edges]:
        """Yield the edges out of some product states, not too many at once.

        Args:
            keys: product states.
            component: leave out edges that leave this strong component of the automaton.
        """
        states = keys // self._count
        counts = self._first_step[states + 1] - self._first_step[states]
        bounds = np.flatnonzero(np.diff(np.cumsum(counts) // _MOST_AT_ONCE)) + 1
        for part in np.split(keys, bounds):
            edges = self._expand(part)
            if component is not None:
                edges = edges.where(self._component[edges.target % self._count] == component)
            yield edges

    def component_of(self, key: int) -> int:
        """Return the number of the automaton's strong component in which a product state is."""
        return int(self._component[key % self._count])

    def _expand(self, keys: Ints) -> Edges:
        states, reading = np.divmod(keys, self._count)
        starts, ends = self._first_step[states], self._first_step[states + 1]
        step = ranges(starts, ends)
        source = np.repeat(keys, ends - starts)
        moves, counts = self._moves.of(np.repeat(reading, ends - starts), self._label[step])
        moved = self._moves.targets(moves)
        source, step = np.repeat(source, counts), np.repeat(step, counts)
        stays = self._component[source % self._count] == self._component[moved]
        target = self._target[step] * self._count + moved
        return Edges(
            source, target, step, self._time_ns[step], self._moves.accepting(moves) & stays
        )

    def _least_by_state(self) -> Ints:
        starts, ends = self._first_step[:-1], self._first_step[1:]
        least_ns = np.zeros(len(starts), dtype=np.int64)
        some = ends > starts
        if some.any():
            least_ns[some] = np.minimum.reduceat(self._time_ns, starts[some])
        return least_ns
