"""What a transition demands of the letter it reads.

- ``Cube``               a conjunction of literals
- ``Guard``              a disjunction of cubes
- ``simplified``         an equivalent guard with fewer and shorter cubes
- ``covers_all_letters`` whether some cube holds on every letter
"""

from collections.abc import Iterable
from dataclasses import dataclass

__all__ = ["Cube", "Guard", "covers_all_letters", "simplified"]


@dataclass(frozen=True, slots=True)
class Cube:
    """A conjunction of literals: atoms that must be true and atoms that must be false."""

    required: frozenset[str]
    forbidden: frozenset[str]

    def holds(self, label: frozenset[str]) -> bool:
        """Return whether the letter in which exactly ``label`` is true satisfies the cube."""
        return self.required <= label and self.forbidden.isdisjoint(label)

    def is_compatible(self, other: "Cube") -> bool:
        """Return whether some letter satisfies both."""
        return self.required.isdisjoint(other.forbidden) and self.forbidden.isdisjoint(
            other.required
        )

    def is_implied_by(self, other: "Cube") -> bool:
        """Return whether every letter that satisfies the other satisfies this one."""
        return self.required <= other.required and self.forbidden <= other.forbidden

    def literals(self) -> tuple[tuple[str, bool], ...]:
        """Return (atom, whether it must be true), sorted by atom."""
        pairs = [(name, True) for name in self.required]
        pairs += [(name, False) for name in self.forbidden]
        return tuple(sorted(pairs))

    def without(self, name: str) -> "Cube":
        """Return the cube with no literal about ``name``."""
        return Cube(self.required - {name}, self.forbidden - {name})

    def flipped(self, name: str) -> "Cube":
        """Return the cube with its literal about ``name`` turned round."""
        rest = self.without(name)
        if name in self.required:
            return Cube(rest.required, rest.forbidden | {name})
        return Cube(rest.required | {name}, rest.forbidden)


@dataclass(frozen=True, slots=True)
class Guard:
    """A disjunction of cubes; with none, no letter passes."""

    cubes: tuple[Cube, ...]

    def holds(self, label: frozenset[str]) -> bool:
        """Return whether the letter in which exactly ``label`` is true passes."""
        return any(cube.holds(label) for cube in self.cubes)

    def is_compatible(self, other: "Guard") -> bool:
        """Return whether some letter passes both."""
        return any(mine.is_compatible(cube) for mine in self.cubes for cube in other.cubes)


def simplified(cubes: Iterable[Cube]) -> Guard:
    """Return an equivalent guard, in a fixed order, with redundant literals and cubes removed.

    A literal goes when the cube with that literal turned round is covered by another cube
    (``a | !a & b`` is ``a | b``). The result has no redundant cube of this kind, but needn't be
    the smallest possible.

    Cost: a few passes of (number of cubes)² x (literals per cube).
    """
    current = _irredundant(cubes)
    while True:
        shorter = _irredundant(_shortened(cube, current) for cube in current)
        if shorter == current:
            return Guard(tuple(current))
        current = shorter


def _irredundant(cubes: Iterable[Cube]) -> list[Cube]:
    kept: list[Cube] = []
    for cube in sorted(set(cubes), key=lambda cube: (len(cube.literals()), cube.literals())):
        if not any(other.is_implied_by(cube) for other in kept):
            kept.append(cube)
    return kept


def _shortened(cube: Cube, cubes: list[Cube]) -> Cube:
    for name, _ in cube.literals():
        turned = cube.flipped(name)
        if any(other.is_implied_by(turned) for other in cubes):
            return cube.without(name)
    return cube


def covers_all_letters(cubes: Iterable[Cube]) -> bool:
    """Return whether every letter satisfies at least one of the cubes.

    Cost: exponential in the number of atoms in the worst case, as the question is.
    """
    stack = [list(cubes)]
    while stack:
        current = stack.pop()
        if not current:
            return False
        shortest = min(current, key=lambda cube: len(cube.required) + len(cube.forbidden))
        literals = shortest.literals()
        if literals:
            name = literals[0][0]
            stack.append([c.without(name) for c in current if name not in c.forbidden])
            stack.append([c.without(name) for c in current if name not in c.required])
    return True
