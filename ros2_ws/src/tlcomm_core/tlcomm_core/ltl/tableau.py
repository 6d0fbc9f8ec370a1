"""Any LTL formula to a Büchi automaton, by an on-the-fly tableau.

- ``tableau_automaton``   an automaton of the words that satisfy the formula
- ``tableau_parts``       the automata that it is put together from

A state is a set of formulas that the rest of the word must satisfy; expanding it gives the edges.
An edge carries the mark of every eventuality that it doesn't postpone: an eventuality that is
never fulfilled is postponed for ever, and its mark isn't seen again.
"""

from typing import Final

from tlcomm_core.ltl.assembly import Parts, assembled
from tlcomm_core.ltl.automaton import BuchiAutomaton, Construction
from tlcomm_core.ltl.expansion import EVENTUALITIES, Expansion
from tlcomm_core.ltl.formula import Formula, Operator, atoms, conjunction, subformulas
from tlcomm_core.ltl.graph import Edge, Graph, check_size
from tlcomm_core.ltl.recurrence import separated
from tlcomm_core.ltl.reduction import reduced
from tlcomm_core.ltl.rewriting import rewritten

__all__ = ["tableau_automaton", "tableau_parts"]

# So many lasting obligations are expanded apart.
_MANY: Final = 3


def tableau_automaton(formula: Formula) -> BuchiAutomaton:
    """Return a Büchi automaton that accepts exactly the words that satisfy a formula.

    Every state but the initial one of an unsatisfiable formula lies on an accepting run.

    Raises:
        IntractableTaskError: it would be too large.
    Source: Gerth, Peled, Vardi and Wolper, "Simple on-the-fly automatic verification of linear
    temporal logic", 1995; acceptance on transitions as in Couvreur, "On-the-fly verification of
    linear temporal logic", 1999.
    Cost: exponential in the formula in the worst case, as the problem is; but no more than
        ``MAX_STEPS`` steps of expansion and ``MAX_STATES`` states with ``MAX_EDGES`` edges.
    """
    return assembled(tableau_parts(formula, atoms(formula)), Construction.TABLEAU)


def tableau_parts(formula: Formula, names: tuple[str, ...]) -> Parts:
    """Return automata whose common words are those that satisfy a formula.

    Args:
        formula: any.
        names: the atoms to number first.

    Raises:
        IntractableTaskError: one would be too large.
    """
    parts = separated(rewritten(formula))
    graphs = (reduced(_explored(Expansion(factor, names))) for factor in _factors(parts.rest))
    return Parts(names, tuple(graphs), tuple(_cubes(target, names) for target in parts.targets))


def _factors(conjuncts: tuple[Formula, ...]) -> list[Formula]:
    """Return the formulas to expand apart: all together, but each of many lasting obligations."""
    lasting = [node for node in conjuncts if _is_lasting(node)]
    if len(lasting) < _MANY:
        return [conjunction(conjuncts)]
    others = [node for node in conjuncts if node not in lasting]
    return [conjunction(others), *lasting] if others else lasting


def _is_lasting(node: Formula) -> bool:
    """Return whether a formula asks for eventualities again and again."""
    return node.operator is Operator.ALWAYS and any(
        part.operator in EVENTUALITIES for part in subformulas(node)
    )


def _cubes(timeless: Formula, names: tuple[str, ...]) -> tuple[int, ...]:
    """Return the literals of the cubes of a formula without operators of time."""
    expansion = Expansion(timeless, names)
    assert expansion.start is not None
    return tuple(expansion.literals(term) for term in expansion.terms(expansion.start))


def _explored(expansion: Expansion) -> Graph:
    """Return the generalized automaton of all sets of obligations that can be reached."""
    if expansion.start is None:
        return Graph(((),), 0)
    number = {expansion.start: 0}
    pending = [expansion.start]
    found: list[list[tuple[int, int, int]]] = []
    edges = 0
    for obligations in pending:
        row = []
        for term in expansion.terms(obligations):
            rest = expansion.obligations(term)
            if rest not in number:
                number[rest] = len(number)
                pending.append(rest)
            row.append((expansion.literals(term), number[rest], expansion.postponed(term)))
        found.append(row)
        edges += len(row)
        check_size(len(number), edges)
    return _marked(found)


def _marked(found: list[list[tuple[int, int, int]]]) -> Graph:
    """Turn "postpones" into marks "doesn't postpone", for eventualities ever postponed."""
    ever = 0
    for row in found:
        for _, _, postponed in row:
            ever |= postponed
    places = [place for place in range(ever.bit_length()) if ever >> place & 1]

    def marks(postponed: int) -> int:
        return sum(1 << index for index, place in enumerate(places) if not postponed >> place & 1)

    rows = (tuple(Edge(cube, target, marks(late)) for cube, target, late in row) for row in found)
    return Graph(tuple(rows), len(places))
