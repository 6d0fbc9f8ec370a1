"""What a formula implies and what kind it is, as far as its syntax shows.

- ``Implication``   memoised answers for the formulas of one translation

All formulas are in negation normal form. A *pure eventuality* f is equivalent to F f, a *pure
universality* to G f. Answers are "surely" or "don't know".

Source: Etessami and Holzmann, "Optimizing Büchi automata", 2000 (pure eventuality and
universality); Somenzi and Bloem, "Efficient Büchi automata from LTL formulae", 2000 (syntactic
implication).
"""

from typing import Final

from tlcomm_core.ltl.formula import FALSE, TRUE, Formula, Operator

__all__ = ["Implication"]

# Deeper down the answer is "don't know", so that neither time nor the stack depends on depth.
_DEEPEST: Final = 40

# Which operator over weaker operands a formula with the first operator implies.
_WEAKER: Final = frozenset(
    {
        (Operator.UNTIL, Operator.UNTIL),
        (Operator.UNTIL, Operator.WEAK_UNTIL),
        (Operator.WEAK_UNTIL, Operator.WEAK_UNTIL),
        (Operator.RELEASE, Operator.RELEASE),
        (Operator.STRONG_RELEASE, Operator.RELEASE),
        (Operator.STRONG_RELEASE, Operator.STRONG_RELEASE),
        (Operator.NEXT, Operator.NEXT),
    }
)


class Implication:
    """Memoised answers about kinds and implications."""

    def __init__(self) -> None:
        """Begin knowing nothing."""
        self._known: dict[tuple[Formula, Formula], bool] = {}
        self._kinds: dict[Formula, tuple[bool, bool]] = {}

    def is_eventual(self, formula: Formula) -> bool:
        """Return whether the formula surely equals F of itself."""
        return self._kind(formula)[0]

    def is_universal(self, formula: Formula) -> bool:
        """Return whether the formula surely equals G of itself."""
        return self._kind(formula)[1]

    def holds(self, one: Formula, other: Formula, depth: int = 0) -> bool:
        """Return whether every word that satisfies the one surely satisfies the other.

        Cost: at most one step per pair of subformulas.
        """
        if one is other or one is FALSE or other is TRUE:
            return True
        if depth > _DEEPEST or one is TRUE or other is FALSE:
            return False
        known = self._known.get((one, other))
        if known is None:
            known = self._by_structure(one, other, depth + 1)
            self._known[one, other] = known
        return known

    def _kind(self, formula: Formula) -> tuple[bool, bool]:
        stack = [formula]
        while stack:
            node = stack[-1]
            missing = [child for child in node.children if child not in self._kinds]
            if node not in self._kinds and missing:
                stack += missing
                continue
            stack.pop()
            self._kinds[node] = self._kind_from_operands(node)
        return self._kinds[formula]

    def _kind_from_operands(self, node: Formula) -> tuple[bool, bool]:  # noqa: PLR0911  one answer per rule
        kinds = [self._kinds[child] for child in node.children]
        eventual = all(kind[0] for kind in kinds)
        universal = all(kind[1] for kind in kinds)
        match node.operator:
            case Operator.ATOM | Operator.NOT:
                return False, False
            case Operator.EVENTUALLY:
                return True, universal
            case Operator.ALWAYS:
                return eventual, True
            case Operator.UNTIL:
                return kinds[1][0], universal
            case Operator.RELEASE:
                return eventual, kinds[1][1]
            case Operator.WEAK_UNTIL | Operator.STRONG_RELEASE:
                return eventual, universal
            case _:
                return eventual, universal

    def _by_structure(self, one: Formula, other: Formula, depth: int) -> bool:
        if (one.operator, other.operator) in _WEAKER and all(
            self.holds(mine, theirs, depth)
            for mine, theirs in zip(one.children, other.children, strict=True)
        ):
            return True
        return self._from_left(one, other, depth) or self._from_right(one, other, depth)

    def _from_left(self, one: Formula, other: Formula, depth: int) -> bool:  # noqa: PLR0911  one answer per rule
        """Return whether what the left formula is made of implies the right one."""
        parts = [self.holds(child, other, depth) for child in one.children]
        match one.operator:
            case Operator.AND:
                return any(parts)
            case Operator.OR | Operator.WEAK_UNTIL:
                return all(parts)
            case Operator.ALWAYS:
                return parts[0]
            case Operator.NEXT | Operator.EVENTUALLY:
                return parts[0] and self.is_eventual(other)
            case Operator.UNTIL:
                return parts[1] and (parts[0] or self.is_eventual(other))
            case Operator.RELEASE:
                return parts[1]
            case Operator.STRONG_RELEASE:
                return parts[1] or (parts[0] and self.is_eventual(other))
            case _:
                return False

    def _from_right(self, one: Formula, other: Formula, depth: int) -> bool:  # noqa: PLR0911  one answer per rule
        """Return whether the left formula implies enough of what the right one is made of."""
        parts = [
            other.operator is not Operator.NOT and self.holds(one, child, depth)
            for child in other.children
        ]
        match other.operator:
            case Operator.AND | Operator.RELEASE | Operator.STRONG_RELEASE if all(parts):
                return True
            case Operator.OR:
                return any(parts)
            case Operator.EVENTUALLY:
                return parts[0]
            case Operator.UNTIL:
                return parts[1]
            case Operator.WEAK_UNTIL:
                return parts[1] or (parts[0] and self.is_universal(one))
            case Operator.NEXT | Operator.ALWAYS:
                return parts[0] and self.is_universal(one)
            case Operator.RELEASE:
                return parts[1] and self.is_universal(one)
            case _:
                return False
