"""Conjuncts G F β without operators of time in β, kept out of the tableau.

- ``Recurrences``         a formula's conjuncts of that kind, and the rest
- ``separated``           finds them
- ``joined``              an automaton for the rest made to wait for each of them as well

In the tableau, k such conjuncts make 2ᵏ edges out of each one. Here each becomes one more level of
the counter that waits for the acceptance marks in turn.

Source: Babiak, Badie, Duret-Lutz, Křetínský and Strejček, "Compositional approach to suspension and
other improvements to LTL translation", 2013, for the idea to compose such conjuncts afterwards.
"""

from dataclasses import dataclass
from typing import Final

from tlcomm_core.ltl.automaton import strong_components
from tlcomm_core.ltl.formula import TRUE, Formula, Operator, subformulas
from tlcomm_core.ltl.graph import Edge, Graph, check_size

__all__ = ["Recurrences", "joined", "separated"]

# So few make fewer states in the tableau.
_FEW: Final = 4
_TIMELESS: Final = frozenset({Operator.ATOM, Operator.NOT, Operator.AND, Operator.OR})


@dataclass(frozen=True, slots=True)
class Recurrences:
    """A formula split into G F β₁ & … & G F βₖ and what is left.

    Attributes:
        rest: the conjunction of all other conjuncts, in negation normal form.
        targets: β₁, …, βₖ.
    """

    rest: Formula
    targets: tuple[Formula, ...]


def separated(formula: Formula) -> Recurrences:
    """Return the conjuncts G F β of a formula in negation normal form, if there are many."""
    others: list[Formula] = []
    targets: list[Formula] = []
    stack = [formula]
    while stack:
        node = stack.pop()
        if node.operator is Operator.AND:
            stack += reversed(node.children)
            continue
        if node.operator is Operator.ALWAYS and node.children[0].operator is Operator.AND:
            stack += [_always(child) for child in reversed(node.children[0].children)]
            continue
        target = _recurring(node)
        if target is None:
            others.append(node)
        elif target not in targets:
            targets.append(target)
    if len(targets) <= _FEW:
        return Recurrences(formula, ())
    rest = TRUE
    for node in others:
        rest = node if rest is TRUE else Formula(Operator.AND, (rest, node))
    return Recurrences(rest, tuple(targets))


def joined(graph: Graph, targets: tuple[tuple[int, ...], ...]) -> Graph:
    """Return a graph with one mark that waits for each target in turn, then for a graph's own mark.

    Args:
        graph: an automaton with one mark.
        targets: per β the cubes of which it is the disjunction.
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
            advances = _advances(edge, level, targets) if inside else [(edge.literals, 0)]
            for literals, reached in advances:
                ends = inside and reached == len(targets) and bool(edge.marks)
                node = (edge.target, 0 if ends else reached)
                if node not in number:
                    number[node] = len(number)
                    pending.append(node)
                row.append(Edge(literals, number[node], int(ends)))
        rows.append(tuple(row))
        edges += len(row)
        check_size(len(number), edges)
    return Graph(tuple(rows), 1)


def _advances(
    edge: Edge, level: int, targets: tuple[tuple[int, ...], ...]
) -> list[tuple[int, int]]:
    """Return the literals of an edge and the level after it, with and without the next target."""
    found = [(edge.literals, level)]
    if level < len(targets):
        met = (edge.literals | cube for cube in targets[level])
        found += [(literals, level + 1) for literals in met if not _contradicts(literals)]
    return found


def _always(formula: Formula) -> Formula:
    always = formula.operator is Operator.ALWAYS
    return formula if always else Formula(Operator.ALWAYS, (formula,))


def _recurring(node: Formula) -> Formula | None:
    if node.operator is not Operator.ALWAYS:
        return None
    inner = node.children[0]
    if inner.operator is not Operator.EVENTUALLY:
        return None
    target = inner.children[0]
    timeless = all(part.operator in _TIMELESS for part in subformulas(target))
    return target if timeless else None


def _contradicts(literals: int) -> bool:
    """Return whether the literals require and forbid the same atom."""
    return any(
        literals >> bit & literals >> bit + 1 & 1 for bit in range(0, literals.bit_length(), 2)
    )
