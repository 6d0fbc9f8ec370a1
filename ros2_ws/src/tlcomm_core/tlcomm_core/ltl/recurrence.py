"""Conjuncts G F β without operators of time in β, kept out of the tableau.

- ``Recurrences``         a formula's conjuncts of that kind, and the rest
- ``separated``           finds them
- ``joined``              an automaton for the rest made to wait for each of them as well

In the tableau, k such conjuncts make 2ᵏ edges out of each one. Here each becomes one more level of
the counter that waits for the acceptance marks in turn.

Source: Babiak, Badie, Duret-Lutz, Křetínský and Strejček, "Compositional approach to suspension and
other improvements to LTL translation", 2013, for the idea to compose such conjuncts afterwards.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Final

from tlcomm_core.ltl.automaton import strong_components
from tlcomm_core.ltl.formula import Formula, Operator
from tlcomm_core.ltl.graph import Edge, Graph, check_size
from tlcomm_core.ltl.normal_form import conjoined, is_timeless

__all__ = ["FEW", "Recurrences", "joined", "separated"]

# So few make fewer states in the tableau.
FEW: Final = 4


@dataclass(frozen=True, slots=True)
class Recurrences:
    """A formula split into G F β₁ & … & G F βₖ and what is left.

    Attributes:
        rest: all other conjuncts, in negation normal form.
        targets: β₁, …, βₖ.
    """

    rest: tuple[Formula, ...]
    targets: tuple[Formula, ...]


def separated(formula: Formula) -> Recurrences:
    """Return the conjuncts G F β of a formula in negation normal form, if there are many."""
    parts = conjoined(formula)
    found = {node: target for node in parts if (target := _recurring(node)) is not None}
    if len(found) <= FEW:
        return Recurrences(parts, ())
    return Recurrences(tuple(node for node in parts if node not in found), tuple(found.values()))


def joined(graph: Graph, targets: tuple[int, ...], both: Callable[[int, int], int | None]) -> Graph:
    """Return a graph with one mark that waits for each target in turn, then for a graph's own mark.

    Args:
        graph: a grouped automaton with one mark.
        targets: per β the number of the guard that it is.
        both: the conjunction of two guards by number, None if no letter passes it.
    """
    component = strong_components([[edge.target for edge in row] for row in graph.rows])
    number: dict[tuple[int, int], int] = {(0, 0): 0}
    pending = [(0, 0)]
    rows: list[tuple[Edge, ...]] = []
    edges = 0
    for state, level in pending:
        row = []
        for edge in graph.rows[state]:
            inside = component[state] == component[edge.target]
            advances = [(edge.literals, level if inside else 0)]
            if inside and level < len(targets):
                met = both(edge.literals, targets[level])
                advances += [] if met is None else [(met, level + 1)]
            for guard, reached in advances:
                ends = inside and reached == len(targets) and bool(edge.marks)
                node = (edge.target, 0 if ends else reached)
                if node not in number:
                    number[node] = len(number)
                    pending.append(node)
                row.append(Edge(guard, number[node], int(ends)))
        rows.append(tuple(row))
        edges += len(row)
        check_size(len(number), edges)
    return Graph(tuple(rows), 1)


def _recurring(node: Formula) -> Formula | None:
    if node.operator is not Operator.ALWAYS:
        return None
    inner = node.children[0]
    if inner.operator is not Operator.EVENTUALLY:
        return None
    target = inner.children[0]
    return target if is_timeless(target) else None
