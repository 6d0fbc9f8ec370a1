"""Direct simulation: which states can stand in for which.

- ``simulating``   per state the states that simulate it
- ``Letters``      sets of letters, exact for few atoms

State t simulates s if every edge of s is matched, letter by letter, by an edge of t with at least
the same marks into a state that simulates its target. All words accepted from s are then accepted
from t.

Source: Etessami and Holzmann, "Optimizing Büchi automata", 2000; Somenzi and Bloem, "Efficient
Büchi automata from LTL formulae", 2000; with acceptance on transitions as in Babiak, Badie,
Duret-Lutz, Křetínský and Strejček, "Compositional approach to suspension and other improvements to
LTL translation", 2013.
"""

from collections.abc import Iterable, Sequence
from functools import cache
from typing import Final

from tlcomm_core.ltl.graph import Edge

__all__ = ["Letters", "simulating"]

_MOST_ATOMS: Final = 8


class Letters:
    """Sets of letters as bit sets in one integer.

    With up to eight atoms there is a bit per letter. With more, a bit per cube that the graph
    uses, set for the cubes that imply it: inclusion of unions is then decided too cautiously, never
    wrongly.
    """

    def __init__(self, cubes: Iterable[int]) -> None:
        """Work out the set of each cube's letters."""
        distinct = sorted(set(cubes))
        width = max((cube.bit_length() + 1 for cube in distinct), default=0) // 2
        if width <= _MOST_ATOMS:
            self._sets = {cube: _letters(cube, width) for cube in distinct}
        else:
            self._sets = {
                cube: sum(
                    1 << place for place, other in enumerate(distinct) if cube & other == cube
                )
                for cube in distinct
            }

    def of(self, cube: int) -> int:
        """Return the set of the letters that satisfy a cube."""
        return self._sets[cube]


@cache
def _column(atom: int, width: int) -> int:
    """Return the letters over ``width`` atoms in which an atom is true."""
    half = 1 << atom
    block = ((1 << half) - 1) << half
    repeats = ((1 << (1 << width)) - 1) // ((1 << (2 * half)) - 1)
    return block * repeats


def _letters(cube: int, width: int) -> int:
    every = (1 << (1 << width)) - 1
    found = every
    for atom in range(width):
        if cube >> (2 * atom) & 1:
            found &= _column(atom, width)
        if cube >> (2 * atom + 1) & 1:
            found &= every ^ _column(atom, width)
    return found


def simulating(rows: Sequence[Sequence[Edge]], letters: Letters) -> list[int]:
    """Return per state the bit set of the states that simulate it, itself among them.

    Cost: states x edges per pass; as many passes as the longest chain of refutations.
    """
    above = [(1 << len(rows)) - 1] * len(rows)
    sources: list[set[int]] = [set() for _ in rows]
    for state, row in enumerate(rows):
        for edge in row:
            sources[edge.target].add(state)
    pending = set(range(len(rows)))
    while pending:
        matched = _Matches(rows, letters, above)
        changed = set()
        for state in pending:
            fresh = matched.simulating(state)
            if fresh != above[state]:
                above[state] = fresh
                changed.add(state)
        pending = {source for state in changed for source in sources[state]}
    return above


class _Matches:
    """One pass of the refinement, against a preliminary relation."""

    def __init__(
        self, rows: Sequence[Sequence[Edge]], letters: Letters, above: Sequence[int]
    ) -> None:
        self._rows = [[(letters.of(e.literals), e.target, e.marks) for e in row] for row in rows]
        self._above = list(above)
        self._known: dict[tuple[int, int, int], int] = {}

    def simulating(self, state: int) -> int:
        """Return the states, as bits, of those above that still match each move of ``state``."""
        found = self._above[state]
        for wanted, target, marks in self._rows[state]:
            rest = found & ~(1 << state)
            while rest:
                lowest = rest & -rest
                rest ^= lowest
                if wanted & ~self._offer(lowest.bit_length() - 1, target, marks):
                    found ^= lowest
        return found

    def _offer(self, state: int, target: int, marks: int) -> int:
        """Return the letters on which a state has an edge at least as good."""
        key = (state, target, marks)
        offer = self._known.get(key)
        if offer is None:
            offer = 0
            good = self._above[target]
            for have, where, carried in self._rows[state]:
                if good >> where & 1 and not marks & ~carried:
                    offer |= have
            self._known[key] = offer
        return offer
