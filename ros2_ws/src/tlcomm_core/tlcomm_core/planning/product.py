"""The product of a transition system and a Büchi automaton, as arrays.

- ``Automaton``  what the product asks of an automaton
- ``Product``    states and edges
- ``build``      the reachable part
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Final, Protocol

import numpy as np
from numpy.typing import NDArray

from tlcomm_core.planning.transition_system import TransitionSystem

__all__ = ["Automaton", "Product", "build", "ticks_ns"]

Ints = NDArray[np.int64]

# Far above the rounding of sums of times, far below a nanosecond.
_ROUNDING_NS: Final = 1e-3


class Automaton(Protocol):
    """A Büchi automaton with acceptance on transitions, nondeterministic or not."""

    @property
    def atoms(self) -> tuple[str, ...]:
        """Names that it reads."""
        ...

    @property
    def initial(self) -> int:
        """State before the first letter."""
        ...

    @property
    def state_count(self) -> int:
        """Number of states."""
        ...

    def successors(self, state: int, label: frozenset[str]) -> tuple[tuple[int, bool], ...]:
        """Return (target, accepting) of each transition that a letter allows."""
        ...


@dataclass(frozen=True, slots=True, eq=False)
class Product:
    """The reachable product states and edges.

    A product state is a state of the transition system with the automaton's state after reading
    the label of the composed state entered. Parallel edges (several actions) are kept.

    Attributes:
        size: number of product states.
        initial: product states after reading the initial label, ascending.
        source: int[E].
        target: int[E].
        step: the transition system's step of each edge, int[E].
        accepting: whether the edge takes an accepting transition of the automaton, bool[E].
        time_ns: cost, int[E], see ``ticks_ns``.
    """

    size: int
    initial: Ints
    source: Ints
    target: Ints
    step: Ints
    accepting: NDArray[np.bool_]
    time_ns: Ints


def ticks_ns(time_s: NDArray[np.float64]) -> Ints:
    """Return times in whole nanoseconds, rounded up.

    Integers make sums exact and ties real. Rounding up is subadditive: a stop on the way never
    looks faster than the same way without it. Any optimum in these ticks is one in seconds to
    within 1 ns per step.
    """
    ticks: Ints = np.ceil(time_s * 1e9 - _ROUNDING_NS).astype(np.int64)
    return ticks


def build(system: TransitionSystem, automaton: Automaton) -> Product:
    """Return the reachable part of the product.

    Source: Section IV-A, P_i. A run begins in the initial state and reads its label first.
    Cost: linear in the product's edges; the automaton is asked once per state and letter.
    """
    return _Builder(system, automaton).build()


@dataclass(frozen=True, slots=True)
class _Layer:
    """The edges that leave some product states; states as keys."""

    source: Ints
    target: Ints
    step: Ints
    accepting: NDArray[np.bool_]


class _Builder:
    """Breadth-first search in whole layers.

    The key of (state s, automaton state q) is s·|Q| + q.
    """

    def __init__(self, system: TransitionSystem, automaton: Automaton) -> None:
        self._system = system
        self._first_step = np.searchsorted(system.source, np.arange(len(system.states) + 1))
        self._count = automaton.state_count
        self._moves = _Moves(automaton, system.labels)
        self._initial = automaton.initial

    def build(self) -> Product:
        """Return the product of what is reachable, its states numbered by their keys."""
        # The initial state is number 0, so its keys are the automaton's states.
        first_label = np.array([self._system.initial_label])
        initial = np.unique(self._moves.of(np.array([self._initial]), first_label)[0])
        layers = list(self._layers(initial))
        source = np.concatenate([layer.source for layer in layers])
        target = np.concatenate([layer.target for layer in layers])
        step = np.concatenate([layer.step for layer in layers])
        keys = np.union1d(np.concatenate((initial, source)), target)
        return Product(
            size=len(keys),
            initial=np.searchsorted(keys, initial),
            source=np.searchsorted(keys, source),
            target=np.searchsorted(keys, target),
            step=step,
            accepting=np.concatenate([layer.accepting for layer in layers]),
            time_ns=ticks_ns(self._system.time_s)[step],
        )

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
        steps = _ranges(starts, ends)
        source = np.repeat(keys, ends - starts)
        reading = np.repeat(automaton_states, ends - starts)
        targets, accepting, counts = self._moves.of(reading, self._system.label[steps])
        step = np.repeat(steps, counts)
        target = self._system.target[step] * self._count + targets
        return _Layer(np.repeat(source, counts), target, step, accepting)


class _Moves:
    """The automaton's transitions as one flat table, filled as pairs are first asked for."""

    def __init__(self, automaton: Automaton, labels: Sequence[frozenset[str]]) -> None:
        atoms = frozenset(automaton.atoms)
        numbers: dict[frozenset[str], int] = {}
        letter = [numbers.setdefault(label & atoms, len(numbers)) for label in labels]
        self._automaton = automaton
        self._letter_of_label = np.array(letter, dtype=np.int64)
        self._letters = tuple(numbers)
        pairs = automaton.state_count * len(self._letters)
        self._start = np.full(pairs, -1, dtype=np.int64)
        self._end = np.zeros(pairs, dtype=np.int64)
        self._flat: list[tuple[int, bool]] = []

    def of(self, states: Ints, labels: Ints) -> tuple[Ints, NDArray[np.bool_], Ints]:
        """Return targets and acceptance for all pairs in a row, and how many each pair has."""
        pairs = states * len(self._letters) + self._letter_of_label[labels]
        self._fill(np.unique(pairs[self._start[pairs] < 0]))
        starts, ends = self._start[pairs], self._end[pairs]
        flat = np.array(self._flat, dtype=np.int64).reshape(-1, 2)[_ranges(starts, ends)]
        return flat[:, 0], flat[:, 1] > 0, ends - starts

    def _fill(self, pairs: Ints) -> None:
        for pair in pairs.tolist():
            state, letter = divmod(pair, len(self._letters))
            self._start[pair] = len(self._flat)
            self._flat.extend(self._automaton.successors(state, self._letters[letter]))
            self._end[pair] = len(self._flat)


def _ranges(starts: Ints, ends: Ints) -> Ints:
    """Return the concatenation of the ranges [start, end)."""
    counts = ends - starts
    offsets = np.cumsum(counts) - counts
    ranges: Ints = np.arange(counts.sum(), dtype=np.int64) + np.repeat(starts - offsets, counts)
    return ranges
