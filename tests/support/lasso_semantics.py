"""The semantics of LTL on a word stem·loop^ω, straight from its definition."""

from collections.abc import Callable, Sequence

from tlcomm_core.ltl import Formula, Operator, subformulas

__all__ = ["holds"]

Letter = frozenset[str]

# What an operator says about one place, from its operands there (a missing one is false).
_HERE: dict[Operator, Callable[[bool, bool], bool]] = {
    Operator.TRUE: lambda _a, _b: True,
    Operator.FALSE: lambda _a, _b: False,
    Operator.NOT: lambda a, _b: not a,
    Operator.AND: lambda a, b: a and b,
    Operator.OR: lambda a, b: a or b,
    Operator.IMPLIES: lambda a, b: b or not a,
    Operator.IFF: lambda a, b: a == b,
}
# The expansion law of an operator from its operands and its own value at the next place, and
# whether it means the law's greatest solution.
_EXPANSION: dict[Operator, tuple[bool, Callable[[bool, bool, bool], bool]]] = {
    Operator.EVENTUALLY: (False, lambda a, _b, later: a or later),
    Operator.ALWAYS: (True, lambda a, _b, later: a and later),
    Operator.UNTIL: (False, lambda a, b, later: b or (a and later)),
    Operator.WEAK_UNTIL: (True, lambda a, b, later: b or (a and later)),
    Operator.STRONG_RELEASE: (False, lambda a, b, later: b and (a or later)),
    Operator.RELEASE: (True, lambda a, b, later: b and (a or later)),
}


def holds(formula: Formula, stem: Sequence[Letter], loop: Sequence[Letter]) -> bool:
    """Return whether the word satisfies the formula."""
    word = [*stem, *loop]
    following = [*range(1, len(word)), len(stem)]
    missing = [False] * len(word)
    values: dict[Formula, list[bool]] = {}
    for node in subformulas(formula):
        operands = [*(values[child] for child in node.children), missing, missing]
        values[node] = _values(node, operands[0], operands[1], word, following)
    return values[formula][0]


def _values(
    node: Formula, a: list[bool], b: list[bool], word: list[Letter], following: list[int]
) -> list[bool]:
    """Return where a formula holds, from where its operands hold."""
    if node.operator is Operator.ATOM:
        return [node.name in letter for letter in word]
    if node.operator is Operator.NEXT:
        return [a[place] for place in following]
    if node.operator in _HERE:
        return [_HERE[node.operator](*here) for here in zip(a, b, strict=True)]
    start, law = _EXPANSION[node.operator]
    current = [start] * len(word)
    for _ in range(len(word) + 1):
        later = [current[place] for place in following]
        current = [law(*here) for here in zip(a, b, later, strict=True)]
    return current
