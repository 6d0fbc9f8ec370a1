"""What an automaton does in its states on the letters of a transition system, looked up once.

- ``Moves``   the moves of pairs of a state and a label
- ``ranges``  ranges of indices in a row
"""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from tlcomm_core.planning.relaxation import Move, Reader

__all__ = ["Moves", "ranges"]

Ints = NDArray[np.int64]
Bools = NDArray[np.bool_]


class Moves:
    """The reader's moves as one flat table, filled as pairs are first asked for."""

    def __init__(self, reader: Reader, labels: Sequence[frozenset[str]]) -> None:
        """Begin without any.

        Args:
            reader: the automaton as the product reads it.
            labels: of the transition system.
        """
        numbers: dict[frozenset[str], int] = {}
        letter = [numbers.setdefault(label & reader.atoms, len(numbers)) for label in labels]
        self._reader = reader
        self._letter_of_label = np.array(letter, dtype=np.int64)
        self._letters = tuple(numbers)
        pairs = reader.state_count * len(self._letters)
        self._start = np.full(pairs, -1, dtype=np.int64)
        self._end = np.zeros(pairs, dtype=np.int64)
        self._flat: list[Move] = []
        self._target = np.array([], dtype=np.int64)
        self._accepting = np.array([], dtype=np.bool_)

    def of(self, states: Ints, labels: Ints) -> tuple[Ints, Ints]:
        """Return the moves of all pairs in a row, and how many each pair has."""
        pairs = states * len(self._letters) + self._letter_of_label[labels]
        self._fill(np.unique(pairs[self._start[pairs] < 0]))
        starts, ends = self._start[pairs], self._end[pairs]
        return ranges(starts, ends), ends - starts

    def targets(self, moves: Ints) -> Ints:
        """Return the states that some moves lead to."""
        targets: Ints = self._target[moves]
        return targets

    def accepting(self, moves: Ints) -> Bools:
        """Return which of some moves accept."""
        accepting: Bools = self._accepting[moves]
        return accepting

    def table(self) -> tuple[Move, ...]:
        """Return the moves asked for so far."""
        return tuple(self._flat)

    def _fill(self, pairs: Ints) -> None:
        known = len(self._flat)
        for pair in pairs.tolist():
            state, letter = divmod(pair, len(self._letters))
            self._start[pair] = len(self._flat)
            self._flat.extend(self._reader.moves(state, self._letters[letter]))
            self._end[pair] = len(self._flat)
        new = self._flat[known:]
        target = np.array([move.target for move in new], dtype=np.int64)
        accepting = np.array([move.accepting for move in new], dtype=np.bool_)
        self._target = np.append(self._target, target)
        self._accepting = np.append(self._accepting, accepting)


def ranges(starts: Ints, ends: Ints) -> Ints:
    """Return the concatenation of the ranges [start, end)."""
    counts = ends - starts
    offsets = np.cumsum(counts) - counts
    ranges: Ints = np.arange(counts.sum(), dtype=np.int64) + np.repeat(starts - offsets, counts)
    return ranges
