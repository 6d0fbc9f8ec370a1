"""Büchi automata with acceptance on transitions.

- ``Construction``      how an automaton was made
- ``Transition``        one guarded edge
- ``BuchiAutomaton``    what the product, the exporters and the reports read
- ``strong_components`` the strongly connected components of a graph
"""

from collections.abc import Sequence
from dataclasses import dataclass, field
from enum import Enum
from itertools import combinations

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from tlcomm_core.ltl.guard import Guard, covers_all_letters

__all__ = ["BuchiAutomaton", "Construction", "Transition", "strong_components"]


class Construction(Enum):
    """How an automaton was made; the value is the word for reports."""

    RESTARTED_GOOD_PREFIX = "restarted good-prefix automaton"
    COMPOSED = "composition of restarted good-prefix automata"
    TABLEAU = "tableau"
    FOR_LETTERS = "composition for the letters that can occur"
    GIVEN = "given automaton"


@dataclass(frozen=True, slots=True)
class Transition:
    """An edge taken on every letter that passes the guard."""

    guard: Guard
    target: int
    accepting: bool


@dataclass(frozen=True, slots=True)
class BuchiAutomaton:
    """A Büchi automaton: a run is accepting if it takes accepting transitions for ever.

    Attributes:
        atoms: names of the atoms that the guards may read.
        initial: the state before the first letter.
        transitions: per state its outgoing edges, in a fixed order.
        kind: how the automaton was made.
    """

    atoms: tuple[str, ...]
    initial: int
    transitions: tuple[tuple[Transition, ...], ...]
    kind: Construction
    _alphabet: frozenset[str] = field(init=False, repr=False, compare=False)
    _successors: dict[tuple[int, frozenset[str]], tuple[tuple[int, bool], ...]] = field(
        init=False, repr=False, compare=False, default_factory=dict
    )

    def __post_init__(self) -> None:
        """Check the indices."""
        object.__setattr__(self, "_alphabet", frozenset(self.atoms))
        assert 0 <= self.initial < self.state_count
        assert all(
            0 <= edge.target < self.state_count for edges in self.transitions for edge in edges
        )

    @property
    def state_count(self) -> int:
        """Number of states."""
        return len(self.transitions)

    def successors(self, state: int, label: frozenset[str]) -> tuple[tuple[int, bool], ...]:
        """Return the edges that a letter allows.

        Args:
            state: where the run is.
            label: the atoms that are true in the letter; others than ``atoms`` are ignored.

        Returns:
            (target, accepting) in a fixed order, each target once; where both an accepting and
            another edge lead to the same target, the accepting one.
        """
        key = (state, label & self._alphabet)
        found = self._successors.get(key)
        if found is None:
            targets: dict[int, bool] = {}
            for edge in self.transitions[state]:
                if edge.guard.holds(key[1]):
                    targets[edge.target] = targets.get(edge.target, False) or edge.accepting
            found = tuple(targets.items())
            self._successors[key] = found
        return found

    def is_empty(self) -> bool:
        """Return whether no word at all is accepted."""
        edges = [[e for e in row if e.guard.cubes] for row in self.transitions]
        component = strong_components([[edge.target for edge in row] for row in edges])
        return not any(
            edge.accepting and component[edge.target] == component[state]
            for state in self._reachable(edges)
            for edge in edges[state]
        )

    def is_deterministic(self) -> bool:
        """Return whether no letter allows two edges of one state."""
        return not any(
            one.guard.is_compatible(other.guard)
            for edges in self.transitions
            for one, other in combinations(edges, 2)
        )

    def is_complete(self) -> bool:
        """Return whether every letter allows an edge in every state."""
        return all(
            covers_all_letters(cube for edge in edges for cube in edge.guard.cubes)
            for edges in self.transitions
        )

    def _reachable(self, edges: list[list[Transition]]) -> list[int]:
        reached = [self.initial]
        known = {self.initial}
        for state in reached:
            for edge in edges[state]:
                if edge.target not in known:
                    known.add(edge.target)
                    reached.append(edge.target)
        return reached


def strong_components(targets: Sequence[Sequence[int]]) -> list[int]:
    """Return the index of each node's strongly connected component.

    Args:
        targets: per node the nodes that its edges lead to.
    """
    count = len(targets)
    rows = np.repeat(np.arange(count), [len(row) for row in targets])
    columns = np.array([target for row in targets for target in row], dtype=np.int64)
    graph = coo_array((np.ones(len(columns), dtype=np.int8), (rows, columns)), (count, count))
    _, labels = connected_components(graph.tocsr(), directed=True, connection="strong")
    return [int(label) for label in labels]
