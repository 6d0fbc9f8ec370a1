"""Equivalent formulas with smaller automata.

- ``rewritten``   a formula in negation normal form, simplified

Source: Etessami and Holzmann, "Optimizing Büchi automata", 2000; Somenzi and Bloem, "Efficient
Büchi automata from LTL formulae", 2000.
"""

from typing import Final

from tlcomm_core.ltl.formula import FALSE, TRUE, Formula, Operator, subformulas
from tlcomm_core.ltl.implication import Implication
from tlcomm_core.ltl.normal_form import negation_normal_form

__all__ = ["rewritten"]

_MOST_SUBFORMULAS: Final = 400
_MOST_PASSES: Final = 5


def rewritten(formula: Formula) -> Formula:
    """Return an equivalent formula in negation normal form, simplified by its syntax.

    A formula with more than 400 distinct subformulas is only brought into normal form.

    Cost: a few passes over the subformulas, each at most quadratic in their number.
    """
    current = negation_normal_form(formula)
    rules = _Rules()
    for _ in range(_MOST_PASSES):
        order = list(subformulas(current))
        if len(order) > _MOST_SUBFORMULAS:
            return current
        images: dict[Formula, Formula] = {}
        for node in order:
            images[node] = rules.apply(node.operator, [images[c] for c in node.children], node)
        fresh = negation_normal_form(images[current])
        if fresh is current:
            return current
        current = fresh
    return current


class _Rules:
    """The rewriting rules, applied to one node over operands that are simplified already."""

    def __init__(self) -> None:
        self._implication = Implication()
        self._negations: dict[Formula, Formula] = {}

    def apply(self, operator: Operator, operands: list[Formula], leaf: Formula) -> Formula:
        """Return what an operator over simplified operands becomes; ``leaf`` is the node itself."""
        match operands:
            case [left, right] if left.operator is right.operator is Operator.NEXT:
                # X a U X b = X (a U b), and so for all operators of two operands.
                return self._next(self.apply(operator, [*left.children, *right.children], leaf))
            case [left, right]:
                return self._binary(operator, left, right)
            case [operand] if operator is Operator.NEXT:
                return self._next(operand)
            case [operand] if operator in {Operator.EVENTUALLY, Operator.ALWAYS}:
                return self._unary(operator, operand)
            case _:
                return leaf

    def _binary(self, operator: Operator, left: Formula, right: Formula) -> Formula:
        match operator:
            case Operator.AND | Operator.OR:
                return self._boolean(operator, left, right)
            case Operator.UNTIL | Operator.WEAK_UNTIL:
                return self._until(operator, left, right)
            case _:
                return self._release(operator, left, right)

    def _negated(self, formula: Formula) -> Formula:
        found = self._negations.get(formula)
        if found is None:
            found = negation_normal_form(Formula(Operator.NOT, (formula,)))
            self._negations[formula] = found
        return found

    def _implies(self, one: Formula, other: Formula) -> bool:
        return self._implication.holds(one, other)

    def _excludes(self, one: Formula, other: Formula) -> bool:
        return self._implies(one, self._negated(other)) or self._implies(other, self._negated(one))

    def _covers(self, one: Formula, other: Formula) -> bool:
        """Return whether one of the two surely holds on every word."""
        return self._implies(self._negated(one), other) or self._implies(self._negated(other), one)

    def _is_tail(self, formula: Formula) -> bool:
        """Return whether the formula surely says the same about every suffix of a word."""
        return self._implication.is_eventual(formula) and self._implication.is_universal(formula)

    def _boolean(self, operator: Operator, left: Formula, right: Formula) -> Formula:  # noqa: PLR0911  one answer per rule
        """Simplify AND and OR."""
        conjunction = operator is Operator.AND
        if self._implies(left, right):
            return left if conjunction else right
        if self._implies(right, left):
            return right if conjunction else left
        if conjunction and self._excludes(left, right):
            return FALSE
        if not conjunction and self._covers(left, right):
            return TRUE
        first = self._given(operator, left, right)
        second = self._given(operator, right, left) if first is left else right
        if first is not left or second is not right:
            return self._boolean(operator, first, second)
        # G a & G b = G (a & b) and F a | F b = F (a | b).
        shared = Operator.ALWAYS if conjunction else Operator.EVENTUALLY
        if left.operator is shared and right.operator is shared:
            both = self._boolean(operator, left.children[0], right.children[0])
            return self._unary(shared, both)
        return Formula(operator, (left, right))

    def _given(self, operator: Operator, formula: Formula, fact: Formula) -> Formula:
        """Simplify a Boolean formula that stands beside a fact under AND or OR.

        Under AND the fact may be taken to hold, under OR not to hold.
        """
        if formula.operator in {Operator.AND, Operator.OR}:
            parts = [self._given(operator, part, fact) for part in formula.children]
            if all(new is old for new, old in zip(parts, formula.children, strict=True)):
                return formula
            return self._boolean(formula.operator, parts[0], parts[1])
        if operator is Operator.AND:
            if self._implies(fact, formula):
                return TRUE
            return FALSE if self._excludes(fact, formula) else formula
        if self._implies(formula, fact):
            return FALSE
        return TRUE if self._covers(fact, formula) else formula

    def _next(self, operand: Formula) -> Formula:
        return operand if self._is_tail(operand) else Formula(Operator.NEXT, (operand,))

    def _unary(self, operator: Operator, operand: Formula) -> Formula:  # noqa: PLR0911  one answer per rule
        """Simplify F and G."""
        eventually = operator is Operator.EVENTUALLY
        if operand is TRUE or operand is FALSE:
            return operand
        kind = self._implication.is_eventual if eventually else self._implication.is_universal
        if kind(operand):
            return operand
        inner = operand.children
        match operand.operator:
            case Operator.NEXT:
                return self._next(self._unary(operator, inner[0]))
            case Operator.UNTIL if eventually:
                return self._unary(operator, inner[1])
            case Operator.STRONG_RELEASE if eventually:
                return self._unary(operator, self._boolean(Operator.AND, *inner))
            case Operator.RELEASE if not eventually:
                return self._unary(operator, inner[1])
            case Operator.WEAK_UNTIL if not eventually:
                return self._unary(operator, self._boolean(Operator.OR, *inner))
            case Operator.AND | Operator.OR:
                return self._lifted(operator, operand)
            case _:
                return Formula(operator, (operand,))

    def _lifted(self, operator: Operator, operand: Formula) -> Formula:
        """Take an operand that says the same about every suffix out of F or G."""
        left, right = operand.children
        for tail, rest in ((left, right), (right, left)):
            if self._is_tail(tail):
                return self._boolean(operand.operator, self._unary(operator, rest), tail)
        return Formula(operator, (operand,))

    def _until(self, operator: Operator, left: Formula, right: Formula) -> Formula:  # noqa: PLR0911  one answer per rule
        """Simplify U and W."""
        strong = operator is Operator.UNTIL
        if self._implies(left, right) or (strong and self._implication.is_eventual(right)):
            return right
        if self._covers(left, right):
            return self._unary(Operator.EVENTUALLY, right) if strong else TRUE
        if self._implication.is_universal(left):
            if not strong:
                return self._boolean(Operator.OR, left, right)
            later = self._unary(Operator.EVENTUALLY, right)
            return self._boolean(Operator.OR, right, self._boolean(Operator.AND, left, later))
        if not strong and self._implication.is_eventual(right):
            return self._boolean(Operator.OR, right, self._unary(Operator.ALWAYS, left))
        if right.operator is operator and self._implies(left, right.children[0]):
            return right
        return Formula(operator, (left, right))

    def _release(self, operator: Operator, left: Formula, right: Formula) -> Formula:  # noqa: PLR0911  one answer per rule
        """Simplify R and M."""
        weak = operator is Operator.RELEASE
        if self._implies(right, left) or (weak and self._implication.is_universal(right)):
            return right
        if self._excludes(left, right):
            return self._unary(Operator.ALWAYS, right) if weak else FALSE
        if self._implication.is_eventual(left):
            if not weak:
                return self._boolean(Operator.AND, left, right)
            always = self._unary(Operator.ALWAYS, right)
            return self._boolean(Operator.AND, right, self._boolean(Operator.OR, left, always))
        if not weak and self._implication.is_universal(right):
            return self._boolean(Operator.AND, right, self._unary(Operator.EVENTUALLY, left))
        if right.operator is operator and self._implies(right.children[0], left):
            return right
        return Formula(operator, (left, right))
