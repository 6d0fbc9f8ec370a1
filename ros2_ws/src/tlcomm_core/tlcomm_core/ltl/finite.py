"""A formula's truth on a finite word that grows letter by letter.

- ``FiniteReading``   a formula, and whether the letters read so far satisfy it by themselves

The word ends after the last letter: ``X`` asks for a next letter, its negation doesn't;
eventualities must have come, ``G``, ``R`` and ``W`` have held so far.
"""

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Final

from tlcomm_core.ltl.formula import Formula, Operator

__all__ = ["FiniteReading"]


# A formula, and whether it is meant itself (True) or its negation is.
_Side = tuple[Formula, bool]


@dataclass(frozen=True, slots=True)
class _Claim:
    """That the rest of the word satisfies a formula, or its negation.

    Attributes:
        side: what is claimed.
        at_end: whether the claim counts as true where no letter is left.
    """

    side: _Side
    at_end: bool


# A disjunction of conjunctions of claims, of which none contains another.
_Claims = frozenset[frozenset[_Claim]]

_TRUE: Final[_Claims] = frozenset([frozenset()])
_FALSE: Final[_Claims] = frozenset()

_LEAVES: Final = frozenset({Operator.TRUE, Operator.FALSE, Operator.ATOM})
_BOOLEAN: Final = frozenset({Operator.AND, Operator.OR, Operator.IMPLIES, Operator.IFF})
# Operators for which waiting for ever is enough.
_PATIENT: Final = frozenset({Operator.ALWAYS, Operator.RELEASE, Operator.WEAK_UNTIL})


class FiniteReading:
    """A formula's truth on the finite word of the letters read so far.

    Source: Bauer, Leucker and Schallhart, "Comparing LTL semantics for runtime verification",
        2010 (FLTL); Bacchus and Kabanza, 2000 (progression).
    Cost: per letter, exponential in the formula at worst; linear for most, as the letter settles
        every atom.
    """

    def __init__(self, formula: Formula) -> None:
        """Begin with no letter; the formula counts as not yet satisfied."""
        self._claims = _claimed((formula, True), at_end=False)
        # Words repeat letters, and claims with them.
        self._letters: dict[frozenset[str], _Letter] = {}
        self._steps: dict[tuple[_Claims, frozenset[str]], _Claims] = {}

    @property
    def is_satisfied(self) -> bool:
        """Whether the letters read so far, if none followed, satisfy the formula."""
        return any(all(claim.at_end for claim in claims) for claims in self._claims)

    def read(self, letter: frozenset[str]) -> None:
        """Read one more letter, in which exactly some atoms are true."""
        step = (self._claims, letter)
        if step not in self._steps:
            reading = self._letters.setdefault(letter, _Letter(letter))
            self._steps[step] = _any(
                _all(reading.after(claim.side) for claim in claims) for claims in self._claims
            )
        self._claims = self._steps[step]


class _Letter:
    """What is left to claim after one letter; operands come before operators, not recursively."""

    def __init__(self, letter: frozenset[str]) -> None:
        self._letter = letter
        self._done: dict[_Side, _Claims] = {}

    def after(self, claimed: _Side) -> _Claims:
        """Return what is left to claim of the words that follow the letter."""
        stack = [claimed]
        while stack:
            side = stack[-1]
            missing = [need for need in _needs(side) if need not in self._done]
            if missing:
                stack += missing
                continue
            self._done[side] = self._expanded(side)
            stack.pop()
        return self._done[claimed]

    def _expanded(self, side: _Side) -> _Claims:
        node, positive = side
        if node.operator in _LEAVES:
            is_true = node.operator is Operator.TRUE or node.name in self._letter
            return _TRUE if is_true == positive else _FALSE
        if node.operator is Operator.NEXT:
            return _claimed((node.children[0], positive), at_end=not positive)
        done = [self._done[need] for need in _needs(side)]
        if node.operator is Operator.NOT:
            return done[0]
        if node.operator in _BOOLEAN:
            return _combined(side, done)
        return _unfolded(side, done)


def _needs(side: _Side) -> list[_Side]:
    """Return the sides whose expansions this one's needs."""
    node, positive = side
    match node.operator:
        case Operator.NEXT:
            return []
        case Operator.NOT:
            return [(node.children[0], not positive)]
        case Operator.IMPLIES:
            return [(node.children[0], not positive), (node.children[1], positive)]
        case Operator.IFF:
            left, right = node.children
            return [(left, True), (right, positive), (left, False), (right, not positive)]
        case _:
            return [(child, positive) for child in node.children]


def _combined(side: _Side, done: list[_Claims]) -> _Claims:
    """Join the expansions of a Boolean operator's operands."""
    node, positive = side
    if node.operator is Operator.IFF:
        return _any([_all(done[:2]), _all(done[2:])])
    return _all(done) if (node.operator is Operator.AND) == positive else _any(done)


def _unfolded(side: _Side, done: list[_Claims]) -> _Claims:
    """Expand an operator by its fixpoint law; a negated one by its dual's."""
    node, positive = side
    is_patient = (node.operator in _PATIENT) == positive
    again = _claimed(side, at_end=is_patient)
    if node.operator in {Operator.EVENTUALLY, Operator.ALWAYS}:
        return _all([done[0], again]) if is_patient else _any([done[0], again])
    if (node.operator in {Operator.UNTIL, Operator.WEAK_UNTIL}) == positive:
        return _any([done[1], _all([done[0], again])])
    return _all([done[1], _any([done[0], again])])


def _claimed(side: _Side, *, at_end: bool) -> _Claims:
    return frozenset([frozenset([_Claim(side, at_end)])])


def _any(parts: Iterable[_Claims]) -> _Claims:
    return _minimal(claims for part in parts for claims in part)


def _all(parts: Iterable[_Claims]) -> _Claims:
    product = _TRUE
    for part in parts:
        product = _minimal(one | other for one in product for other in part)
    return product


def _minimal(sets: Iterable[frozenset[_Claim]]) -> _Claims:
    """Return the sets that contain no other."""
    kept: list[frozenset[_Claim]] = []
    for candidate in sorted(set(sets), key=len):
        if not any(smaller <= candidate for smaller in kept):
            kept.append(candidate)
    return frozenset(kept)
