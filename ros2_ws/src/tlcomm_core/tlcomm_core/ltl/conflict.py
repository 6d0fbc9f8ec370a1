"""Which parts of a formula exclude each other.

- ``conjuncts``          the parts that a formula asks for all of
- ``conflict``           a smallest set of parts that no word satisfies together
- ``known_conflict``     the same, or the formula itself where the search would be too large
- ``contradiction``      the same in a sentence
- ``smallest_conflict``  the same for any notion of "possible together"
"""

from collections.abc import Callable, Sequence
from itertools import combinations, islice
from typing import Final

from tlcomm_core.errors import IntractableTaskError, LocalMisuseError
from tlcomm_core.ltl.formula import Formula, Operator, atoms, conjunction
from tlcomm_core.ltl.translation import translate

__all__ = [
    "conflict",
    "conjuncts",
    "contradiction",
    "known_conflict",
    "smallest_conflict",
]

# How many sets are tried in search of one with fewer members than a minimal one has.
_MOST_TRIALS: Final = 200

_Wrapper = Callable[[Formula], Formula]


def conjuncts(formula: Formula) -> tuple[Formula, ...]:
    """Return formulas whose conjunction is equivalent to the formula, each as small as is easy.

    Conjunctions are taken apart, also under ``G``, ``X`` and to the right of ``->``, and so are
    negated disjunctions and implications. What can't be taken apart stays as it is written.
    """
    parts: dict[Formula, None] = {}
    stack = [formula]
    while stack:
        node = stack.pop()
        pieces = _pieces(node)
        if pieces:
            stack += reversed(pieces)
        else:
            parts[node] = None
    return tuple(parts)


def conflict(formula: Formula) -> tuple[Formula, ...]:
    """Return a smallest set of conjuncts that no word satisfies together.

    Parts that share no atom, not even through others, can't exclude each other, so the search
    is confined to one group of parts that do.

    Args:
        formula: an unsatisfiable formula.

    Returns:
        The parts in the order in which they are written, smallest as in ``smallest_conflict``.

    Raises:
        LocalMisuseError: the formula is satisfiable.
    Cost: that of ``smallest_conflict`` with one translation per set tried.
    """
    for group in _linked(conjuncts(formula)):
        if not _is_satisfiable(group):
            return smallest_conflict(group, _is_satisfiable)
    message = f"{formula!r} is satisfiable"
    raise LocalMisuseError(message)


def known_conflict(formula: Formula) -> tuple[Formula, ...]:
    """Return a smallest set of conjuncts of an unsatisfiable formula that exclude each other.

    It is the formula itself if the automaton of some set of its conjuncts is too large.
    """
    try:
        return conflict(formula)
    except IntractableTaskError:
        return (formula,)


def contradiction(parts: Sequence[Formula]) -> str:
    """Return, as a sentence, that some formulas exclude each other."""
    quoted = [repr(str(part)) for part in parts]
    if len(quoted) == 1:
        return f"{quoted[0]} contradicts itself: no word satisfies it"
    listed = f"{', '.join(quoted[:-1])} and {quoted[-1]}"
    return f"{listed} contradict each other: no word satisfies them all"


def smallest_conflict(
    parts: Sequence[Formula], is_possible: Callable[[Sequence[Formula]], bool]
) -> tuple[Formula, ...]:
    """Return a smallest set of formulas that aren't possible together.

    First a set from which none can be left out is found by deletion. Then all sets with fewer
    members are tried, from the smallest, if these are at most ``_MOST_TRIALS`` many.

    Args:
        parts: formulas that aren't possible together.
        is_possible: whether some formulas are; if so, then each selection of them is, too.

    Returns:
        Formulas in the given order, none of which can be left out; no set has fewer, unless the
        number of sets forbade the search.

    Source: Chinneck and Dravnieks, "Locating minimal infeasible constraint sets in linear
        programs", 1991 (deletion filter).
    Cost: one question per part, and at most ``_MOST_TRIALS`` more.
    """
    kept = list(parts)
    for part in reversed(parts):
        fewer = [other for other in kept if other is not part]
        if not is_possible(fewer):
            kept = fewer
    candidates = (chosen for size in range(1, len(kept)) for chosen in combinations(parts, size))
    trials = list(islice(candidates, _MOST_TRIALS + 1))
    if len(trials) > _MOST_TRIALS:
        return tuple(kept)
    return next((chosen for chosen in trials if not is_possible(chosen)), tuple(kept))


def _is_satisfiable(parts: Sequence[Formula]) -> bool:
    return not translate(conjunction(parts)).is_empty()


def _linked(parts: Sequence[Formula]) -> list[list[Formula]]:
    """Return the parts in groups that share no atom with each other."""
    groups: list[tuple[set[str], list[int]]] = []
    for index, part in enumerate(parts):
        names, members = set(atoms(part)), [index]
        apart = []
        for group in groups:
            if names.isdisjoint(group[0]):
                apart.append(group)
            else:
                names |= group[0]
                members += group[1]
        groups = [*apart, (names, members)]
    return [[parts[index] for index in sorted(members)] for _, members in groups]


def _pieces(formula: Formula) -> list[Formula]:
    """Take one conjunction apart, however deep under G, X and ->; none if there isn't any."""
    wrappers: list[_Wrapper] = []
    core = formula
    while (peeled := _peeled(core)) is not None:
        wrapper, core = peeled
        wrappers.append(wrapper)
    pieces = _operands(core)
    for wrapper in reversed(wrappers):
        pieces = [wrapper(piece) for piece in pieces]
    return pieces


def _peeled(node: Formula) -> tuple[_Wrapper, Formula] | None:
    """Return what distributes over a conjunction, and its operand."""
    match node.operator:
        case Operator.ALWAYS | Operator.NEXT:
            return _under(node.operator), node.children[0]
        case Operator.IMPLIES:
            return _implied_by(node.children[0]), node.children[1]
        case Operator.NOT:
            return _peeled_negation(node.children[0])
        case _:
            return None


def _peeled_negation(node: Formula) -> tuple[_Wrapper, Formula] | None:
    match node.operator:
        case Operator.NOT:
            return (lambda piece: piece), node.children[0]
        case Operator.EVENTUALLY:
            return _under(Operator.ALWAYS), _negated(node.children[0])
        case Operator.NEXT:
            return _under(Operator.NEXT), _negated(node.children[0])
        case _:
            return None


def _operands(node: Formula) -> list[Formula]:
    """Return the operands of a conjunction, whether written as one or as a negation."""
    if node.operator is Operator.AND:
        return list(node.children)
    if node.operator is Operator.NOT:
        inner = node.children[0]
        if inner.operator is Operator.OR:
            return [_negated(child) for child in inner.children]
        if inner.operator is Operator.IMPLIES:
            return [inner.children[0], _negated(inner.children[1])]
    return []


def _under(operator: Operator) -> _Wrapper:
    return lambda piece: Formula(operator, (piece,))


def _implied_by(condition: Formula) -> _Wrapper:
    return lambda piece: Formula(Operator.IMPLIES, (condition, piece))


def _negated(node: Formula) -> Formula:
    return Formula(Operator.NOT, (node,))
