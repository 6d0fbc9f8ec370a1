"""The last steps of every construction: from the graphs of a conjunction's parts to an automaton.

- ``Parts``       what is conjoined
- ``assembled``   the automaton of the words that fit all of it
"""

from collections.abc import Collection, Iterable
from dataclasses import dataclass
from typing import Final

from tlcomm_core.ltl.alphabet import LetterGuards, sharpened
from tlcomm_core.ltl.automaton import BuchiAutomaton, Construction, Transition
from tlcomm_core.ltl.composition import CubeGuards, Guards, composed, grouped, ungrouped
from tlcomm_core.ltl.degeneralization import degeneralized
from tlcomm_core.ltl.graph import Edge, Graph
from tlcomm_core.ltl.guard import Cube, Guard, simplified
from tlcomm_core.ltl.recurrence import joined
from tlcomm_core.ltl.reduction import productive, reduced, renumbered

__all__ = ["Parts", "assembled"]

# Graphs with more cubes than this aren't reduced; fewer if they are products, whose factors were.
_MOST_CUBES: Final = 20_000
_MOST_CUBES_OF_PRODUCTS: Final = 1_000


@dataclass(frozen=True, slots=True)
class Parts:
    """What is conjoined, over the same atoms.

    Attributes:
        atoms: names of the atoms, in the order of their bits.
        graphs: at least one automaton, with an edge per cube.
        targets: per further conjunct G F β the cubes of which β is the disjunction.
    """

    atoms: tuple[str, ...]
    graphs: tuple[Graph, ...]
    targets: tuple[tuple[int, ...], ...] = ()


def assembled(
    parts: Parts,
    kind: Construction,
    *,
    any_order: bool = False,
    letters: Collection[frozenset[str]] | None = None,
) -> BuchiAutomaton:
    """Return the automaton of the words that all parts accept.

    Every state but the initial one of an empty automaton lies on an accepting run.

    Args:
        parts: what is conjoined.
        kind: what the automaton says about itself.
        any_order: see ``degeneralized``.
        letters: the letters of the words that matter; on others it has no edges.

    Raises:
        IntractableTaskError: it would be too large.
    Cost: see ``composed`` and ``degeneralized``.
    """
    guards, factors = _guarded(parts, letters)
    graph = degeneralized(composed(factors, guards), any_order=any_order)
    most_cubes = _MOST_CUBES_OF_PRODUCTS if len(factors) > 1 else _MOST_CUBES
    graph = _smaller(graph, guards, most_cubes)
    if parts.targets:
        targets = tuple(guards.number(cubes) for cubes in parts.targets)
        graph = _smaller(joined(graph, targets, guards.both), guards, most_cubes)
    named = _Named(parts.atoms, guards)
    rows = tuple(named.transitions(row) for row in graph.rows)
    return BuchiAutomaton(parts.atoms, 0, rows, kind)


def _guarded(
    parts: Parts, letters: Collection[frozenset[str]] | None
) -> tuple[Guards, list[Graph]]:
    """Return the guards to work with and the parts' graphs, grouped."""
    if letters is None:
        guards = CubeGuards(len(parts.atoms))
        return guards, [grouped(graph, guards) for graph in parts.graphs]
    few = LetterGuards(parts.atoms, letters)
    return few, [sharpened(grouped(graph, few), few) for graph in parts.graphs]


def _smaller(graph: Graph, guards: Guards, most_cubes: int) -> Graph:
    """Reduce a grouped graph; a large one loses its useless states alone."""
    cubes = sum(len(guards.cubes(edge.literals)) for row in graph.rows for edge in row)
    if cubes > most_cubes:
        return renumbered(productive(graph))
    return grouped(reduced(ungrouped(graph, guards)), guards)


class _Named:
    """Transitions with the atoms' names in their guards, each guard made once."""

    def __init__(self, atoms: tuple[str, ...], guards: Guards) -> None:
        self._atoms = atoms
        self._guards = guards
        self._known: dict[frozenset[int], Guard] = {}

    def transitions(self, row: Iterable[Edge]) -> tuple[Transition, ...]:
        """Return the edges, those with the same target and acceptance as one."""
        groups: dict[tuple[int, int], list[int]] = {}
        for edge in row:
            groups.setdefault((edge.target, edge.marks), []).append(edge.literals)
        return tuple(
            Transition(self._guard(frozenset(group)), target, accepting=marks == 1)
            for (target, marks), group in groups.items()
        )

    def _guard(self, numbers: frozenset[int]) -> Guard:
        found = self._known.get(numbers)
        if found is None:
            cubes = (cube for number in sorted(numbers) for cube in self._guards.cubes(number))
            found = simplified(self._cube(literals) for literals in cubes)
            self._known[numbers] = found
        return found

    def _cube(self, literals: int) -> Cube:
        return Cube(
            frozenset(name for i, name in enumerate(self._atoms) if literals >> 2 * i & 1),
            frozenset(name for i, name in enumerate(self._atoms) if literals >> 2 * i + 1 & 1),
        )
