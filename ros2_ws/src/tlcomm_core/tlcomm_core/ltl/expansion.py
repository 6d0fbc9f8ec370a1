"""What a set of formulas demands of the present letter and of the rest of the word.

- ``Expansion``   the expansion rules over one formula's subformulas
- ``antichain``   the sets among some that contain no other
- ``EVENTUALITIES``   the operators that may be postponed
- ``MAX_STEPS``   how much work an expansion does before it gives up

A conjunction of formulas is equivalent to a disjunction of *terms*: literals that the present
letter must satisfy, obligations that the rest of the word must satisfy, and the eventualities that
are thereby postponed rather than fulfilled. Everything is a bit set in one Python integer, so that
joining two terms is ``|``, and one demands no more than another if ``one & other == one``.
"""

from collections.abc import Collection, Iterable
from typing import Final

from tlcomm_core.errors import IntractableTaskError, LocalMisuseError
from tlcomm_core.ltl.formula import FALSE, TRUE, Formula, Operator, atoms, subformulas
from tlcomm_core.ltl.guard import Cube

__all__ = ["EVENTUALITIES", "MAX_STEPS", "Expansion", "antichain"]

# Joined or compared terms during the whole translation of one formula.
MAX_STEPS: Final = 40_000_000

EVENTUALITIES: Final = frozenset(
    {Operator.EVENTUALLY, Operator.UNTIL, Operator.STRONG_RELEASE},
)


class Expansion:
    """The expansion rules over the subformulas of one formula in negation normal form.

    Bits of a term, from the lowest: per atom "must be true" and "must be false"; per subformula
    "obliges the rest of the word"; per subformula "is postponed". A set of obligations alone uses
    only the second group, shifted down to bit 0.

    Attributes:
        atoms: names of the atoms, in the order of their bits.
        start: the obligations of the formula itself; None if it is the constant false.
    """

    def __init__(self, formula: Formula, names: tuple[str, ...] = ()) -> None:
        """Number the subformulas and expand each.

        Args:
            formula: in negation normal form.
            names: atoms to number first, so that several expansions agree.

        Raises:
            IntractableTaskError: that takes more than ``MAX_STEPS``.
        """
        self._steps = 0
        self.atoms = tuple(dict.fromkeys([*names, *atoms(formula)]))
        self._order = tuple(subformulas(formula))
        self._place = {node: index for index, node in enumerate(self._order)}
        self._atom_place = {name: index for index, name in enumerate(self.atoms)}
        self._literal_bits = 2 * len(self.atoms)
        self._literals = (1 << self._literal_bits) - 1
        self._required = sum(1 << (2 * index) for index in range(len(self.atoms)))
        self._obligations = (1 << len(self._order)) - 1
        self._pieces: dict[Formula, int | None] = {}
        self._implied: list[tuple[int, int]] = []
        self._terms: dict[Formula, tuple[int, ...]] = {}
        self._set_terms: dict[int, tuple[int, ...]] = {}
        for node in self._order:
            self._pieces[node] = self._split(node)
            self._note_implied(node)
            self._terms[node] = self._expand(node)
        self.start = self._pieces[formula]

    def spend(self, steps: int) -> None:
        """Count steps of work.

        Raises:
            IntractableTaskError: there have been more than ``MAX_STEPS``.
        """
        self._steps += steps
        if self._steps > MAX_STEPS:
            raise IntractableTaskError(
                f"the formula's automaton needs more than {MAX_STEPS} steps of expansion;"
                " split the task or leave out alternatives"
            )

    def terms(self, obligations: int) -> tuple[int, ...]:
        """Return the terms whose disjunction is equivalent to the conjunction of a set.

        Raises:
            IntractableTaskError: the work of this expansion exceeds ``MAX_STEPS``.
        """
        found = self._set_terms.get(obligations)
        if found is None:
            members = [self._terms[self._order[place]] for place in _bits(obligations)]
            members.sort(key=len)
            found = (0,)
            for member in members:
                found = self._product(found, member)
            self._set_terms[obligations] = found
        return found

    def literals(self, term: int) -> int:
        """Return the literals of a term as bits: 2i requires atom i, 2i + 1 forbids it."""
        return term & self._literals

    def obligations(self, term: int) -> int:
        """Return the set of formulas that the rest of the word must satisfy."""
        return (term >> self._literal_bits) & self._obligations

    def postponed(self, term: int) -> int:
        """Return the set of eventualities that a term doesn't fulfil."""
        return term >> (self._literal_bits + len(self._order))

    def demands(self, term: int) -> int:
        """Return a term without its postponed eventualities: literals and obligations."""
        return term & ((1 << (self._literal_bits + len(self._order))) - 1)

    def cube(self, literals: int) -> Cube:
        """Return the cube of a term's literal bits."""
        places = _bits(literals)
        return Cube(
            frozenset(self.atoms[place // 2] for place in places if place % 2 == 0),
            frozenset(self.atoms[place // 2] for place in places if place % 2 == 1),
        )

    def _split(self, node: Formula) -> int | None:
        """Return the set of conjuncts of a formula, None if it is false."""
        if node is TRUE or node is FALSE:
            return 0 if node is TRUE else None
        if node.operator is not Operator.AND:
            return 1 << self._place[node]
        left, right = (self._pieces[child] for child in node.children)
        return None if left is None or right is None else left | right

    def _note_implied(self, node: Formula) -> None:
        """Remember that G f makes f redundant beside it."""
        if node.operator is Operator.ALWAYS:
            pieces = self._pieces[node.children[0]]
            self._implied.append((1 << self._place[node], pieces or 0))

    def _without_implied(self, obligations: int) -> int:
        redundant = 0
        for owner, pieces in self._implied:
            if obligations & owner:
                redundant |= pieces
        return obligations & ~redundant

    def _later(self, node: Formula) -> tuple[int, ...]:
        """Return the expansion of "the rest of the word satisfies the formula"."""
        pieces = self._pieces[node]
        return () if pieces is None else (pieces << self._literal_bits,)

    def _again(self, node: Formula) -> tuple[int, ...]:
        """Return the expansion of "the rest of the word satisfies this very formula"."""
        (term,) = self._later(node)
        if node.operator in EVENTUALITIES:
            term |= 1 << (self._literal_bits + len(self._order) + self._place[node])
        return (term,)

    def _expand(self, node: Formula) -> tuple[int, ...]:
        parts = [self._terms[child] for child in node.children]
        match node.operator:
            case Operator.TRUE:
                return (0,)
            case Operator.FALSE:
                return ()
            case Operator.ATOM | Operator.NOT:
                return (self._literal(node),)
            case Operator.NEXT:
                return self._later(node.children[0])
            case Operator.AND | Operator.OR:
                return self._join(node.operator, parts[0], parts[1])
            case _:
                return self._unfold(node, parts)

    def _literal(self, node: Formula) -> int:
        name = node.name or node.children[0].name
        if name not in self._atom_place:
            message = f"{node!r} isn't in negation normal form"
            raise LocalMisuseError(message)
        return 1 << (2 * self._atom_place[name] + (node.operator is Operator.NOT))

    def _join(
        self, operator: Operator, left: tuple[int, ...], right: tuple[int, ...]
    ) -> tuple[int, ...]:
        if operator is Operator.AND:
            return self._product(left, right)
        return self._antichain([*left, *right])

    def _unfold(self, node: Formula, parts: list[tuple[int, ...]]) -> tuple[int, ...]:
        """Expand a formula that may have to hold again later by its fixpoint equation."""
        again = self._again(node)
        match node.operator:
            case Operator.EVENTUALLY:
                return self._antichain([*parts[0], *again])
            case Operator.ALWAYS:
                return self._product(parts[0], again)
            case Operator.UNTIL | Operator.WEAK_UNTIL:
                return self._antichain([*parts[1], *self._product(parts[0], again)])
            case Operator.RELEASE | Operator.STRONG_RELEASE:
                return self._product(parts[1], self._antichain([*parts[0], *again]))
            case _:
                message = f"{node!r} isn't in negation normal form"
                raise LocalMisuseError(message)

    def _product(self, left: tuple[int, ...], right: tuple[int, ...]) -> tuple[int, ...]:
        self.spend(len(left) * len(right))
        joined = {one | other for one in left for other in right}
        terms = {self._normal(term) for term in joined if self._is_consistent(term)}
        return self._antichain(terms)

    def _antichain(self, terms: Collection[int]) -> tuple[int, ...]:
        self.spend(len(terms) ** 2 // 2)
        return antichain(terms)

    def _is_consistent(self, term: int) -> bool:
        return not term & (term >> 1) & self._required

    def _normal(self, term: int) -> int:
        """Remove the obligations that others in the term imply."""
        obligations = self.obligations(term)
        redundant = obligations & ~self._without_implied(obligations)
        return term & ~(redundant << self._literal_bits)


def antichain(sets: Iterable[int]) -> tuple[int, ...]:
    """Return the bit sets that contain no other of them, smallest first.

    Cost: quadratic in the number of sets.
    """
    kept: list[int] = []
    for candidate in sorted(set(sets), key=lambda bits: (bits.bit_count(), bits)):
        if not any(smaller & candidate == smaller for smaller in kept):
            kept.append(candidate)
    return tuple(kept)


def _bits(number: int) -> list[int]:
    """Return the places of the ones, lowest first."""
    places = []
    while number:
        lowest = number & -number
        places.append(lowest.bit_length() - 1)
        number ^= lowest
    return places
