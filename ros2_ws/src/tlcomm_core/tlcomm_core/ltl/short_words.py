"""All lasso words of a few letters, read at once.

``shortest_lasso``  the shortest one that satisfies a formula
"""

from collections.abc import Callable
from typing import Final

import numpy as np
from numpy.typing import NDArray

from tlcomm_core.ltl.formula import Formula, Operator, atoms, subformulas
from tlcomm_core.ltl.word import LassoWord, Letter

__all__ = ["shortest_lasso"]

Bools = NDArray[np.bool_]

# How many truths of a subformula at a place of a word are worth finding out.
_MOST_TRUTHS: Final = 20_000_000

_BOOLEAN: Final[dict[Operator, Callable[[Bools, Bools], Bools]]] = {
    Operator.AND: lambda a, b: a & b,
    Operator.OR: lambda a, b: a | b,
    Operator.IMPLIES: lambda a, b: ~a | b,
    Operator.IFF: lambda a, b: a == b,
}
_Law = Callable[[Bools, Bools, Bools], Bools]
# The expansion law of an operator, from the first and the last operand and its own truth at the
# next place; and whether waiting for ever is enough.
_EXPANSION: Final[dict[Operator, tuple[_Law, bool]]] = {
    Operator.EVENTUALLY: (lambda a, _, later: a | later, False),
    Operator.ALWAYS: (lambda a, _, later: a & later, True),
    Operator.UNTIL: (lambda a, b, later: b | a & later, False),
    Operator.WEAK_UNTIL: (lambda a, b, later: b | a & later, True),
    Operator.RELEASE: (lambda a, b, later: b & (a | later), True),
    Operator.STRONG_RELEASE: (lambda a, b, later: b & (a | later), False),
}


def shortest_lasso(formula: Formula, most_letters: int) -> LassoWord | None:
    """Return the lasso word with the fewest letters in stem and loop that satisfies a formula.

    Of these it has the fewest true atoms, then the shortest loop, then atoms true early.

    Args:
        formula: what is to hold.
        most_letters: how many letters the word may have.

    Returns:
        The word; ``None`` if none is that short, or if there are too many words to read.

    Cost: 2^(n·k) words for n letters and k atoms; given up beyond ``_MOST_TRUTHS``.
    """
    nodes, names = sum(1 for _ in subformulas(formula)), atoms(formula)
    for letters in range(1, most_letters + 1):
        if nodes * letters**2 << letters * len(names) > _MOST_TRUTHS:
            return None
        found = _Words(names, letters).least(formula)
        if found is not None:
            return found
    return None


class _Words:
    """All words of some letters."""

    def __init__(self, names: tuple[str, ...], letters: int) -> None:
        count = letters * len(names)
        bits = np.arange(1 << count) >> np.arange(count)[:, None] & 1
        self._names: Final = names
        self._letters: Final = letters
        self._effort: Final = bits.sum(axis=0)
        # By place, atom and word.
        self._true: Final[Bools] = bits.reshape(letters, len(names), 1 << count) > 0

    def least(self, formula: Formula) -> LassoWord | None:
        """Return the best word that satisfies a formula, for any place where the loop begins."""
        found: list[tuple[int, LassoWord]] = []
        for begin in reversed(range(self._letters)):
            fitting = np.flatnonzero(self._holds(formula, begin))
            if len(fitting):
                word = int(fitting[self._effort[fitting].argmin()])
                found.append((int(self._effort[word]), self._told(word, begin)))
        return min(found, key=lambda candidate: candidate[0], default=(0, None))[1]

    def _told(self, word: int, begin: int) -> LassoWord:
        letters = tuple(self._letter(place, word) for place in range(self._letters))
        return LassoWord(letters[:begin], letters[begin:])

    def _letter(self, place: int, word: int) -> Letter:
        true = self._true[place, :, word].tolist()
        return frozenset(name for name, is_true in zip(self._names, true, strict=True) if is_true)

    def _holds(self, formula: Formula, begin: int) -> Bools:
        """Return which words satisfy a formula, bool[words]."""
        truths: dict[Formula, Bools] = {}
        for node in subformulas(formula):
            truths[node] = self._truth(node, [truths[child] for child in node.children], begin)
        at_first: Bools = truths[formula][0]
        return at_first

    def _truth(self, node: Formula, operands: list[Bools], begin: int) -> Bools:
        """Return where a formula holds, bool[places, words], from where its operands do."""
        match node.operator:
            case Operator.TRUE | Operator.FALSE:
                shape = (self._letters, len(self._effort))
                return np.full(shape, node.operator is Operator.TRUE)
            case Operator.ATOM:
                return self._true[:, self._names.index(node.name)]
            case Operator.NOT:
                return ~operands[0]
            case Operator.NEXT:
                return np.concatenate((operands[0][1:], operands[0][begin : begin + 1]))
            case operator if operator in _BOOLEAN:
                return _BOOLEAN[operator](operands[0], operands[1])
            case operator:
                law, is_patient = _EXPANSION[operator]
                return _solution(law, operands[0], operands[-1], begin, is_patient=is_patient)


def _solution(law: _Law, a: Bools, b: Bools, begin: int, *, is_patient: bool) -> Bools:
    """Return the least solution of an expansion law, or the greatest if waiting is enough.

    Once round the loop settles where it begins, and once more all the rest.
    """
    truth = np.full_like(a, is_patient)
    for _ in range(2):
        later = truth[begin]
        for place in reversed(range(len(a))):
            later = truth[place] = law(a[place], b[place], later)
    return truth
