"""The product of a transition system and a task's automaton, as arrays.

- ``Product``   states and edges
- ``Reading``   which moves of the automaton they are
- ``build``     the reachable part
- ``ticks_ns``  times as integers
- ``MOST_RELAXED``   limit on products with a soft task
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from tlcomm_core.errors import IntractableTaskError
from tlcomm_core.planning.moves import Moves, ranges
from tlcomm_core.planning.relaxation import (
    Automaton,
    Move,
    Reader,
    Relaxed,
    SoftTask,
    Strict,
)
from tlcomm_core.planning.transition_system import TransitionSystem

__all__ = ["MOST_RELAXED", "Product", "Reading", "build", "ticks_ns"]

MOST_RELAXED: Final = 1_000_000

Ints = NDArray[np.int64]

# Far above the rounding of sums of times, far below a nanosecond.
_ROUNDING_NS: Final = 1e-3


@dataclass(frozen=True, slots=True, eq=False)
class Reading:
    """What the automaton does along a product's edges, and on the initial label.

    Attributes:
        moves: the distinct moves.
        initial: the move into each initial product state, an index into ``moves``.
        edge: the move of each edge, int[E], likewise.
    """

    moves: Sequence[Move]
    initial: Ints
    edge: Ints


@dataclass(frozen=True, slots=True, eq=False)
class Product:
    """The reachable product states and edges.

    A product state is a state of the transition system with the automaton's state after reading
    the label of the composed state entered. Parallel edges (several actions) are kept. What an
    edge takes is its step's time and the price of what it violates.

    Attributes:
        size: number of product states.
        initial: product states after reading the initial label, ascending.
        source: int[E].
        target: int[E].
        step: the transition system's step of each edge, int[E].
        accepting: whether the edge takes an accepting transition of the automaton, bool[E].
        time_ns: cost, int[E], see ``ticks_ns``.
        initial_ns: price of the initial label in each initial product state.
        reading: the automaton's part in it.
    """

    size: int
    initial: Ints
    source: Ints
    target: Ints
    step: Ints
    accepting: NDArray[np.bool_]
    time_ns: Ints
    initial_ns: Ints
    reading: Reading


def ticks_ns(time_s: NDArray[np.float64]) -> Ints:
    """Return times in whole nanoseconds, rounded up.

    Integers make sums exact and ties real. Rounding up is subadditive: a stop on the way never
    looks faster than the same way without it. Any optimum in these ticks is one in seconds to
    within 1 ns per step.
    """
    ticks: Ints = np.ceil(time_s * 1e9 - _ROUNDING_NS).astype(np.int64)
    return ticks


def build(system: TransitionSystem, automaton: Automaton, soft: SoftTask | None = None) -> Product:
    """Return the reachable part of the product.

    Raises:
        IntractableTaskError: there is a soft task, and steps times states of the automata together
            are more than ``MOST_RELAXED``.

    Source: Section IV-A, P_i. A run begins in the initial state and reads its label first.
    Cost: linear in the product's edges; the automaton is asked once per state and letter.
    """
    if soft is None:
        return _Builder(system, Strict(automaton), 0).build()
    relaxed = Relaxed(automaton, soft.automaton)
    if len(system.source) * relaxed.state_count > MOST_RELAXED:
        raise IntractableTaskError(
            f"{len(system.source)} steps of the agent, {automaton.state_count} states of the task's"
            f" automaton and {soft.automaton.state_count} of the soft task's make a product that"
            f" is too large (limit {MOST_RELAXED}); simplify the soft task or leave out regions"
        )
    price_ns = int(ticks_ns(np.array([soft.weight_s]))[0])
    return _Builder(system, relaxed, price_ns).build()


@dataclass(frozen=True, slots=True)
class _Layer:
    """The edges that leave some product states; states as keys."""

    source: Ints
    target: Ints
    step: Ints
    move: Ints


class _Builder:
    """Breadth-first search in whole layers.

    The key of (state s, automaton state q) is s·|Q| + q.
    """

    def __init__(self, system: TransitionSystem, reader: Reader, price_ns: int) -> None:
        self._system = system
        self._first_step = np.searchsorted(system.source, np.arange(len(system.states) + 1))
        self._count = reader.state_count
        self._moves = Moves(reader, system.labels)
        self._initial = reader.initial
        self._price_ns = price_ns

    def build(self) -> Product:
        """Return the product of what is reachable, its states numbered by their keys."""
        initial, initial_move = self._initial_states()
        layers = list(self._layers(initial))
        source = np.concatenate([layer.source for layer in layers])
        target = np.concatenate([layer.target for layer in layers])
        step = np.concatenate([layer.step for layer in layers])
        move = np.concatenate([layer.move for layer in layers])
        keys = np.union1d(np.concatenate((initial, source)), target)
        moves = self._moves.table()
        prices_ns = self._prices_ns(moves)
        return Product(
            size=len(keys),
            initial=np.searchsorted(keys, initial),
            source=np.searchsorted(keys, source),
            target=np.searchsorted(keys, target),
            step=step,
            accepting=np.array([each.accepting for each in moves], dtype=np.bool_)[move],
            time_ns=ticks_ns(self._system.time_s)[step] + prices_ns[move],
            initial_ns=prices_ns[initial_move],
            reading=Reading(moves, initial_move, move),
        )

    def _initial_states(self) -> tuple[Ints, Ints]:
        """Return the initial states, ascending, and the cheapest move into each."""
        start, label = np.array([self._initial]), np.array([self._system.initial_label])
        move, _ = self._moves.of(start, label)
        # The transition system's initial state is number 0, so its keys are the automaton's states.
        target = self._moves.targets(move)
        order = np.lexsort((self._prices_ns(self._moves.table())[move], target))
        initial, cheapest = np.unique(target[order], return_index=True)
        return initial, move[order][cheapest]

    def _prices_ns(self, moves: Sequence[Move]) -> Ints:
        counts = np.array([len(move.wanted) for move in moves], dtype=np.int64)
        return counts * self._price_ns

    def _layers(self, initial: Ints) -> Iterator[_Layer]:
        """Yield the edges out of the states at distance 0, 1, … of the initial ones."""
        known = np.zeros(len(self._system.states) * self._count, dtype=np.bool_)
        frontier = initial
        while True:
            known[frontier] = True
            layer = self._expand(frontier)
            yield layer
            frontier = np.unique(layer.target[~known[layer.target]])
            if not len(frontier):
                return

    def _expand(self, keys: Ints) -> _Layer:
        states, automaton_states = np.divmod(keys, self._count)
        starts, ends = self._first_step[states], self._first_step[states + 1]
        steps = ranges(starts, ends)
        source = np.repeat(keys, ends - starts)
        reading = np.repeat(automaton_states, ends - starts)
        move, counts = self._moves.of(reading, self._system.label[steps])
        step = np.repeat(steps, counts)
        target = self._system.target[step] * self._count + self._moves.targets(move)
        return _Layer(np.repeat(source, counts), target, step, move)
