"""What a formula demands in every letter of a word, and which atoms it thereby rules out.

- ``invariants``  the parts of a formula that are G of a formula free of operators of time
- ``forbidden``   the atoms that these never let be true
"""

from collections.abc import Collection, Iterator, Mapping

from tlcomm_core.ltl.formula import Formula, Operator, subformulas
from tlcomm_core.ltl.normal_form import is_timeless, negation_normal_form

__all__ = ["forbidden", "invariants"]


def invariants(formula: Formula) -> tuple[Formula, ...]:
    """Return each β, in negation normal form, for which G β is a conjunct of the formula.

    G distributes over conjunctions: ``G (!d & (a -> F b))`` has the invariant ``!d``.
    """
    return tuple(_invariants(negation_normal_form(formula)))


def _invariants(normal: Formula) -> Iterator[Formula]:
    pending = [(normal, False)]
    while pending:
        part, is_always = pending.pop()
        if part.operator is Operator.AND:
            pending += [(child, is_always) for child in reversed(part.children)]
        elif part.operator is Operator.ALWAYS:
            pending.append((part.children[0], True))
        elif is_always and is_timeless(part):
            yield part


def forbidden(formula: Formula, beside: Mapping[str, Collection[str]]) -> frozenset[str]:
    """Return the atoms that no word which satisfies the formula may ever have true.

    An atom is forbidden when it makes an invariant false, whichever of the atoms that can be true
    beside it are.

    Args:
        formula: a task.
        beside: the atoms in question, each with those that can be true beside it; while it is
            true, all others are false.

    Deviates: sound but not complete: the atoms beside it are taken as independent of each other.
    Cost: linear in the formula for each atom.
    """
    parts = invariants(formula)
    return frozenset(
        name
        for name, others in beside.items()
        if not all(_can_hold(part, name, others) for part in parts)
    )


def _can_hold(invariant: Formula, name: str, others: Collection[str]) -> bool:
    """Return whether an invariant may hold in a letter that has an atom true."""
    value: dict[Formula, bool] = {}
    for node in subformulas(invariant):
        match node.operator:
            case Operator.ATOM:
                value[node] = node.name == name or node.name in others
            case Operator.NOT:
                value[node] = node.children[0].name != name
            case Operator.AND:
                value[node] = all(value[child] for child in node.children)
            case _:
                value[node] = any(value[child] for child in node.children)
    return value[invariant]
