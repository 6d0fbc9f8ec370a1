"""Negation normal form and the classes of formulas that can be read off it.

- ``negation_normal_form``   negations at the atoms only, constants folded
- ``is_co_safe``             every word that satisfies it has a good prefix, by its syntax
- ``is_timeless``            it says something about the present letter alone
- ``recurring``              φ if the formula is G F φ
- ``conjoined``              the formulas that a formula is the conjunction of
"""

from typing import Final

from tlcomm_core.ltl.formula import FALSE, TRUE, Formula, Operator, subformulas

__all__ = ["conjoined", "is_co_safe", "is_timeless", "negation_normal_form", "recurring"]

_DUAL: Final = {
    Operator.TRUE: Operator.FALSE,
    Operator.FALSE: Operator.TRUE,
    Operator.AND: Operator.OR,
    Operator.OR: Operator.AND,
    Operator.NEXT: Operator.NEXT,
    Operator.EVENTUALLY: Operator.ALWAYS,
    Operator.ALWAYS: Operator.EVENTUALLY,
    Operator.UNTIL: Operator.RELEASE,
    Operator.RELEASE: Operator.UNTIL,
    Operator.WEAK_UNTIL: Operator.STRONG_RELEASE,
    Operator.STRONG_RELEASE: Operator.WEAK_UNTIL,
}
_TIMELESS: Final = frozenset({Operator.ATOM, Operator.NOT, Operator.AND, Operator.OR})
_NOT_CO_SAFE: Final = frozenset({Operator.RELEASE, Operator.ALWAYS, Operator.WEAK_UNTIL})

# What U, R, W, M become when one operand is constant: F or G of the other, or that constant;
# in all other cases, the right operand.
_UNARY_BY_RIGHT: Final = {
    (Operator.WEAK_UNTIL, FALSE): Operator.ALWAYS,
    (Operator.STRONG_RELEASE, TRUE): Operator.EVENTUALLY,
}
_UNARY_BY_LEFT: Final = {
    (Operator.UNTIL, TRUE): Operator.EVENTUALLY,
    (Operator.RELEASE, FALSE): Operator.ALWAYS,
}
_SETTLED_BY_LEFT: Final = frozenset({(Operator.WEAK_UNTIL, TRUE), (Operator.STRONG_RELEASE, FALSE)})


def negation_normal_form(formula: Formula) -> Formula:
    """Return an equivalent formula with ! at atoms only and without -> and <->.

    Constants are folded and trivial redundancies removed (``F F a``, ``a & a``, ``true U a``),
    so that formulas which differ in such sugar alone become the same.

    Cost: linear in the number of distinct subformulas.
    """
    plain: dict[Formula, Formula] = {}
    negated: dict[Formula, Formula] = {}
    for node in subformulas(formula):
        yes = tuple(plain[child] for child in node.children)
        no = tuple(negated[child] for child in node.children)
        plain[node], negated[node] = _both_polarities(node, yes, no)
    return plain[formula]


def is_co_safe(formula: Formula) -> bool:
    """Return whether the formula is syntactically co-safe.

    That is: its negation normal form has no G, R or W, so that every word which satisfies it has
    a finite prefix that settles the matter.

    Source: Kupferman and Vardi, "Model checking of safety properties", 2001.
    """
    normal = negation_normal_form(formula)
    return all(node.operator not in _NOT_CO_SAFE for node in subformulas(normal))


def is_timeless(formula: Formula) -> bool:
    """Return whether a formula in negation normal form has no operator of time and no constant."""
    return all(node.operator in _TIMELESS for node in subformulas(formula))


def recurring(formula: Formula) -> Formula | None:
    """Return φ in negation normal form if the formula, but for sugar, is G F φ; else None.

    A φ that folds to a constant takes the whole formula with it, and gives None.
    """
    normal = negation_normal_form(formula)
    if normal.operator is not Operator.ALWAYS:
        return None
    inner = normal.children[0]
    return inner.children[0] if inner.operator is Operator.EVENTUALLY else None


def conjoined(formula: Formula) -> tuple[Formula, ...]:
    """Return the conjuncts of a formula in negation normal form, from left to right, each once.

    G (f & g) counts as the two conjuncts G f and G g.
    """
    found: dict[Formula, None] = {}
    stack = [formula]
    while stack:
        node = stack.pop()
        inner = node.children[0] if node.operator is Operator.ALWAYS else TRUE
        if node.operator is Operator.AND:
            stack += reversed(node.children)
        elif inner.operator is Operator.AND:
            stack += [_fold_unary(Operator.ALWAYS, child) for child in reversed(inner.children)]
        else:
            found[node] = None
    return tuple(found)


def _both_polarities(
    node: Formula, yes: tuple[Formula, ...], no: tuple[Formula, ...]
) -> tuple[Formula, Formula]:
    """Return the normal forms of the node and of its negation from those of its operands."""
    match node.operator:
        case Operator.ATOM:
            return node, Formula(Operator.NOT, (node,))
        case Operator.NOT:
            return no[0], yes[0]
        case Operator.IMPLIES:
            return _fold(Operator.OR, (no[0], yes[1])), _fold(Operator.AND, (yes[0], no[1]))
        case Operator.IFF:
            same = _either(_both(yes[0], yes[1]), _both(no[0], no[1]))
            return same, _either(_both(yes[0], no[1]), _both(no[0], yes[1]))
        case operator:
            return _fold(operator, yes), _fold(_DUAL[operator], no)


def _both(left: Formula, right: Formula) -> Formula:
    return _fold(Operator.AND, (left, right))


def _either(left: Formula, right: Formula) -> Formula:
    return _fold(Operator.OR, (left, right))


def _fold(operator: Operator, operands: tuple[Formula, ...]) -> Formula:
    """Build a node over operands in normal form, or something simpler that means the same."""
    match operator:
        case Operator.NEXT | Operator.EVENTUALLY | Operator.ALWAYS:
            return _fold_unary(operator, operands[0])
        case Operator.AND | Operator.OR:
            return _fold_boolean(operator, operands[0], operands[1])
        case Operator.TRUE | Operator.FALSE:
            return Formula(operator)
        case _:
            return _fold_until(operator, operands[0], operands[1])


def _fold_unary(operator: Operator, operand: Formula) -> Formula:
    if operand in {TRUE, FALSE}:
        return operand
    if operator is not Operator.NEXT:
        if operand.operator is operator:
            return operand
        # F G F a = G F a and G F G a = F G a: only the last two matter.
        if {operator, operand.operator} == {Operator.EVENTUALLY, Operator.ALWAYS}:
            inner = operand.children[0]
            if inner.operator is operator:
                return operand
    return Formula(operator, (operand,))


def _fold_boolean(operator: Operator, left: Formula, right: Formula) -> Formula:
    neutral, absorbing = (TRUE, FALSE) if operator is Operator.AND else (FALSE, TRUE)
    if absorbing in {left, right} or _are_complements(left, right):
        return absorbing
    if left is neutral or left is right:
        return right
    return left if right is neutral else Formula(operator, (left, right))


def _are_complements(left: Formula, right: Formula) -> bool:
    return (left.operator is Operator.NOT and left.children[0] is right) or (
        right.operator is Operator.NOT and right.children[0] is left
    )


def _fold_until(operator: Operator, left: Formula, right: Formula) -> Formula:
    """Fold U, R, W, M with a constant operand or two equal ones."""
    if right in {TRUE, FALSE}:
        unary = _UNARY_BY_RIGHT.get((operator, right))
        return right if unary is None else _fold_unary(unary, left)
    if (operator, left) in _UNARY_BY_LEFT:
        return _fold_unary(_UNARY_BY_LEFT[operator, left], right)
    if (operator, left) in _SETTLED_BY_LEFT:
        return left
    return right if left in {TRUE, FALSE, right} else Formula(operator, (left, right))
