"""Formulas: interning, traversal, printing."""

import copy
import pickle

import pytest

from tlcomm_core.errors import LocalMisuseError
from tlcomm_core.ltl import FALSE, TRUE, Formula, Operator, atom, atoms, parse, subformulas, to_text

DEPTH = 20_000


def deep_formula() -> Formula:
    """Return X X … X a, far deeper than Python's stack."""
    formula = atom("a")
    for _ in range(DEPTH):
        formula = Formula(Operator.NEXT, (formula,))
    return formula


def test_equal_formulas_are_one_object() -> None:
    """Building the same formula twice gives the same object, a different one another."""
    assert parse("F (a & b)") is parse("<>(a && b)")
    assert parse("a U b") is not parse("b U a")
    assert atom("true_") is not TRUE


def test_order_of_operands_and_names_reaches_the_digest() -> None:
    """Formulas that differ have different digests."""
    texts = ["a", "b", "a & b", "b & a", "a | b", "X a", "F a", "ab", "true", "false", "X X a"]
    assert len({parse(text).digest for text in texts}) == len(texts)


def test_formula_is_immutable() -> None:
    """Assigning to a node is refused."""
    with pytest.raises(AttributeError, match="immutable"):
        atom("a").name = "b"  # type: ignore[misc]


@pytest.mark.parametrize(
    ("operator", "children", "name"),
    [
        (Operator.AND, (TRUE,), ""),
        (Operator.NEXT, (), ""),
        (Operator.ATOM, (), ""),
        (Operator.TRUE, (), "a"),
        (Operator.FALSE, (FALSE,), ""),
    ],
)
def test_malformed_node_is_refused(
    operator: Operator, children: tuple[Formula, ...], name: str
) -> None:
    """A node with a wrong number of operands, or a name where none belongs, is our own bug."""
    with pytest.raises(LocalMisuseError, match="malformed node"):
        Formula(operator, children, name)


def test_copies_and_pickles_are_the_same_object() -> None:
    """Copying, deep copying and unpickling return the interned object, whatever its depth."""
    formula = deep_formula()
    assert copy.copy(formula) is formula
    assert copy.deepcopy(formula) is formula
    assert pickle.loads(pickle.dumps(formula)) is formula  # noqa: S301  our own bytes


def test_traversal_never_recurses() -> None:
    """Listing, printing and reading the atoms work on 20,000 levels."""
    formula = deep_formula()
    assert sum(1 for _ in subformulas(formula)) == DEPTH + 1
    assert atoms(formula) == ("a",)
    assert to_text(formula) == "X " * DEPTH + "a"


def test_subformulas_come_once_and_children_first() -> None:
    """Every distinct subformula appears exactly once, after its operands."""
    order = list(subformulas(parse("(a U b) & F (a U b) | X a")))
    assert [str(node) for node in order] == [
        "a",
        "b",
        "a U b",
        "F (a U b)",
        "a U b & F (a U b)",
        "X a",
        "a U b & F (a U b) | X a",
    ]


def test_atoms_come_in_order_of_appearance() -> None:
    """Atoms are listed once, as the text names them."""
    assert atoms(parse("F (z & a) | z U m")) == ("z", "a", "m")


@pytest.mark.parametrize(
    "text",
    [
        "a & b & c",
        "a & (b & c)",
        "a -> b -> c",
        "(a -> b) -> c",
        "a U b U c",
        "(a U b) U c",
        "a U b & c",
        "a U (b & c)",
        "!(a & b)",
        "!a & !b",
        "F G a",
        "G (a -> F b)",
        "(a | b) & c",
        "X !a U F b",
        "!(a U b)",
        "!!a",
        "(a <-> b) -> c",
        "a <-> b -> c",
        "true U false",
    ],
)
def test_printing_uses_the_parentheses_it_needs(text: str) -> None:
    """A text with minimal parentheses is printed as it was written."""
    assert to_text(parse(text)) == text
