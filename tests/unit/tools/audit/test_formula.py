"""Tests of ``tlcomm_tools.audit.formula``: reading, and evaluation against the definition."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tlcomm_core.errors import InputError
from tlcomm_tools.audit.formula import (
    Letter,
    Tree,
    count_fulfilled,
    read_formula,
    recurring_part,
)

A, B, C = ("atom", "a"), ("atom", "b"), ("atom", "c")


def word(text: str) -> list[Letter]:
    """Return letters: "ab,-,c" is {a, b}, {}, {c}."""
    return [frozenset(part.replace("-", "")) for part in text.split(",")]


@pytest.mark.parametrize(
    ("text", "tree"),
    [
        ("a & b | c", ("|", ("&", A, B), C)),
        ("a | b & c", ("|", A, ("&", B, C))),
        ("a U b & c", ("&", ("U", A, B), C)),
        ("a U b U c", ("U", A, ("U", B, C))),
        ("F a & b", ("&", ("F", A), B)),
        ("!a U b", ("U", ("!", A), B)),
        ("<>[]a", ("F", ("G", A))),
        ("not (a V b)", ("U", ("!", A), ("!", B))),
        ("!(a W b)", ("M", ("!", A), ("!", B))),
        ("!X F a", ("X", ("G", ("!", A)))),
        ("a -> b -> c", ("|", ("!", A), ("|", ("!", B), C))),
        ("a <-> b", ("|", ("&", A, B), ("&", ("!", A), ("!", B)))),
        ("true && 0 || 1", ("|", ("&", ("true",), ("false",)), ("true",))),
        ("~~a", A),
    ],
)
def test_formulas_are_read_with_spots_precedence(text: str, tree: Tree) -> None:
    """Each operator binds as the contract says, and negations end at the atoms."""
    assert read_formula(text) == tree


@pytest.mark.parametrize("text", ["", "a &", "(a", "a)", "a b", "& a", "a ? b", "2x", "F"])
def test_nonsense_is_refused(text: str) -> None:
    """What isn't a formula is an input error that quotes it."""
    with pytest.raises(InputError, match="formula"):
        read_formula(text)


@pytest.mark.parametrize(
    ("text", "part"),
    [
        ("G F a", A),
        ("[]<>(a & X b)", ("&", A, ("X", B))),
        ("G F G a", None),
        ("G F (a W b)", None),
        ("F G a", None),
        ("G a", None),
        ("a", None),
    ],
)
def test_the_recurring_part(text: str, part: Tree | None) -> None:
    """Only □◇φ with co-safe φ has a recurring part."""
    assert recurring_part(read_formula(text)) == part


@pytest.mark.parametrize(
    ("text", "letters", "ends"),
    [
        ("G F a", "a,-,a,a", [0, 2, 3]),
        ("G F (a & F b)", "b,a,a,b,b,ab", [3, 5]),
        ("G F (a & F (b & F c))", "a,b,a,c,a,c,b,c", [3, 7]),
        ("G F (a & X b)", "a,-,a,b,b", [3]),
        ("G F (!a U b)", "-,a,b,-,b", [2, 4]),
        ("G F (b M a)", "a,a,ab,a", [2]),
        ("G F (a & b)", "a,b,a", []),
        ("G F true", "-,-", [0, 1]),
        ("G F false", "-,-", []),
    ],
)
def test_fulfilments_are_counted_anew(text: str, letters: str, ends: list[int]) -> None:
    """Each fulfilment ends at the first letter that makes it certain; the next begins after it."""
    part = recurring_part(read_formula(text))
    assert part is not None
    assert count_fulfilled(part, word(letters)) == ends


def holds(tree: Tree, letters: list[Letter], at: int) -> bool:  # noqa: PLR0911 (a case each)
    """Tell by the definition whether a co-safe formula holds for certain from one letter on."""
    operator, *operands = tree
    rest = range(at, len(letters))
    match operator:
        case "atom":
            return at < len(letters) and operands[0] in letters[at]
        case "!":
            return at < len(letters) and not holds(operands[0], letters, at)
        case "&":
            return all(holds(own, letters, at) for own in operands)
        case "|":
            return any(holds(own, letters, at) for own in operands)
        case "X":
            return holds(operands[0], letters, at + 1)
        case "F":
            return any(holds(operands[0], letters, k) for k in rest)
        case "U":
            return any(
                holds(operands[1], letters, k)
                and all(holds(operands[0], letters, j) for j in range(at, k))
                for k in rest
            )
        case "M":
            return any(
                holds(operands[0], letters, k)
                and all(holds(operands[1], letters, j) for j in range(at, k + 1))
                for k in rest
            )
    raise AssertionError(operator)


TREES = st.recursive(
    st.sampled_from([A, B, C, ("!", A), ("!", B)]),
    lambda inner: st.one_of(
        st.tuples(st.sampled_from(["X", "F"]), inner),
        st.tuples(st.sampled_from(["&", "|", "U", "M"]), inner, inner),
    ),
    max_leaves=5,
)
WORDS = st.lists(st.frozensets(st.sampled_from("abc")), max_size=7)


@given(TREES, WORDS)
def test_fulfilments_follow_the_definition(tree: Tree, letters: list[Letter]) -> None:
    """The indices are those that the quantifiers of the definition give, letter by letter."""
    wanted, start = [], 0
    for end in range(len(letters)):
        if holds(("F", tree), letters[start : end + 1], 0):
            wanted.append(end)
            start = end + 1
    assert count_fulfilled(tree, letters) == wanted
