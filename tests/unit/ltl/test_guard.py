"""Guards: evaluation, simplification, coverage."""

from collections.abc import Iterator
from itertools import chain, combinations

import pytest

from tlcomm_core.ltl.guard import Cube, Guard, covers_all_letters, simplified

ATOMS = ("a", "b", "c")


def cube(text: str) -> Cube:
    """Return the cube written as "a !b"."""
    words = text.split()
    return Cube(
        frozenset(word for word in words if not word.startswith("!")),
        frozenset(word[1:] for word in words if word.startswith("!")),
    )


def letters() -> Iterator[frozenset[str]]:
    """Yield every letter over the atoms."""
    subsets = (combinations(ATOMS, size) for size in range(len(ATOMS) + 1))
    return map(frozenset, chain.from_iterable(subsets))


def test_cube_reads_its_literals_only() -> None:
    """A cube holds where its atoms are as it says, whatever the others are."""
    assert cube("a !b").holds(frozenset({"a", "c"}))
    assert not cube("a !b").holds(frozenset({"a", "b"}))
    assert not cube("a !b").holds(frozenset())
    assert cube("").holds(frozenset())


def test_empty_guard_lets_nothing_pass() -> None:
    """A disjunction of no cubes is false."""
    assert not Guard(()).holds(frozenset({"a"}))


@pytest.mark.parametrize(
    ("cubes", "expected"),
    [
        (["a", "!a"], [""]),
        (["a", "!a b"], ["a", "b"]),
        (["a b", "a !b", "!a b"], ["a", "b"]),
        (["a", "a b"], ["a"]),
        (["a b c", "a b !c", "a !b"], ["a"]),
        (["!a", "a !b", "a b !c"], ["!a", "!b", "!c"]),
        (["a !b", "!a b"], ["a !b", "!a b"]),
        ([], []),
    ],
)
def test_simplified_guard_is_shorter_and_equivalent(cubes: list[str], expected: list[str]) -> None:
    """Redundant literals and cubes go; no letter changes sides."""
    guard = simplified(map(cube, cubes))
    assert set(guard.cubes) == set(map(cube, expected))
    plain = Guard(tuple(map(cube, cubes)))
    assert all(guard.holds(letter) == plain.holds(letter) for letter in letters())


@pytest.mark.parametrize(
    "cubes", [[], ["a"], ["a", "!a"], ["a", "!a b", "!b"], ["a b", "!a"], ["a", "!a b", "!a !b"]]
)
def test_coverage_agrees_with_trying_every_letter(cubes: list[str]) -> None:
    """Coverage means that no letter is left out."""
    guard = Guard(tuple(map(cube, cubes)))
    assert covers_all_letters(guard.cubes) == all(map(guard.holds, letters()))


def test_compatible_guards_share_a_letter() -> None:
    """Guards are compatible unless a literal of one contradicts the other in every pair."""
    assert Guard((cube("a"),)).is_compatible(Guard((cube("b"),)))
    assert not Guard((cube("a"), cube("b"))).is_compatible(Guard((cube("!a !b"),)))
