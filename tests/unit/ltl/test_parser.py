"""The parser: precedence, synonyms, errors and their places."""

import pytest

from tlcomm_core.errors import FormulaError
from tlcomm_core.ltl import (
    FALSE,
    MAX_LENGTH,
    MAX_NESTING,
    TRUE,
    Formula,
    Operator,
    atom,
    explain,
    parse,
)

A, B, C = atom("a"), atom("b"), atom("c")
NOT, NEXT, FINALLY, GLOBALLY = (
    Operator.NOT,
    Operator.NEXT,
    Operator.EVENTUALLY,
    Operator.ALWAYS,
)
AND, OR, IMPLIES, IFF = Operator.AND, Operator.OR, Operator.IMPLIES, Operator.IFF
UNTIL, RELEASE = Operator.UNTIL, Operator.RELEASE
WEAK, STRONG = Operator.WEAK_UNTIL, Operator.STRONG_RELEASE


def tree(operator: Operator, *children: Formula) -> Formula:
    """Return a node, written shortly."""
    return Formula(operator, children)


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("a -> b -> c", tree(IMPLIES, A, tree(IMPLIES, B, C))),
        ("a <-> b <-> c", tree(IFF, A, tree(IFF, B, C))),
        ("a -> b <-> c", tree(IMPLIES, A, tree(IFF, B, C))),
        ("a <-> b -> c", tree(IFF, A, tree(IMPLIES, B, C))),
        ("a | b | c", tree(OR, tree(OR, A, B), C)),
        ("a & b & c", tree(AND, tree(AND, A, B), C)),
        ("a U b U c", tree(UNTIL, A, tree(UNTIL, B, C))),
        ("a U b R c", tree(UNTIL, A, tree(RELEASE, B, C))),
        ("a W b M c", tree(WEAK, A, tree(STRONG, B, C))),
        ("a -> b | c", tree(IMPLIES, A, tree(OR, B, C))),
        ("a | b -> c", tree(IMPLIES, tree(OR, A, B), C)),
        ("a | b & c", tree(OR, A, tree(AND, B, C))),
        ("a & b | c", tree(OR, tree(AND, A, B), C)),
        ("a & b U c", tree(AND, A, tree(UNTIL, B, C))),
        ("a U b & c", tree(AND, tree(UNTIL, A, B), C)),
        ("F a U b", tree(UNTIL, tree(FINALLY, A), B)),
        ("a U G b", tree(UNTIL, A, tree(GLOBALLY, B))),
        ("X F !a & b", tree(AND, tree(NEXT, tree(FINALLY, tree(NOT, A))), B)),
        ("!X a W b", tree(WEAK, tree(NOT, tree(NEXT, A)), B)),
        ("a & F b U c | a", tree(OR, tree(AND, A, tree(UNTIL, tree(FINALLY, B), C)), A)),
        ("(a -> b) -> c", tree(IMPLIES, tree(IMPLIES, A, B), C)),
        ("((a))", A),
        ("a & (b | c)", tree(AND, A, tree(OR, B, C))),
    ],
)
def test_precedence_and_associativity(text: str, expected: Formula) -> None:
    """Operators bind and associate as in Spot."""
    assert parse(text) is expected


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("!a", tree(NOT, A)),
        ("~a", tree(NOT, A)),
        ("not a", tree(NOT, A)),
        ("not(a)", tree(NOT, A)),
        ("a & b", tree(AND, A, B)),
        ("a&&b", tree(AND, A, B)),
        ("a | b", tree(OR, A, B)),
        ("a||b", tree(OR, A, B)),
        ("a->b", tree(IMPLIES, A, B)),
        ("a<->b", tree(IFF, A, B)),
        ("X a", tree(NEXT, A)),
        ("F a", tree(FINALLY, A)),
        ("<>a", tree(FINALLY, A)),
        ("G a", tree(GLOBALLY, A)),
        ("[]a", tree(GLOBALLY, A)),
        ("[]<>a", tree(GLOBALLY, tree(FINALLY, A))),
        ("a U b", tree(UNTIL, A, B)),
        ("a R b", tree(RELEASE, A, B)),
        ("a V b", tree(RELEASE, A, B)),
        ("a W b", tree(WEAK, A, B)),
        ("a M b", tree(STRONG, A, B)),
        ("true", TRUE),
        ("1", TRUE),
        ("false", FALSE),
        ("0", FALSE),
        (" \t\n a\r\n", A),
    ],
)
def test_every_synonym(text: str, expected: Formula) -> None:
    """Every spelling of the grammar means its operator."""
    assert parse(text) is expected


@pytest.mark.parametrize(
    ("text", "same"), [("GF a", "G F a"), ("GF(a)", "G F a"), ("!XXG a", "! X X G a")]
)
def test_a_word_of_prefix_operators_is_a_run_of_them(text: str, same: str) -> None:
    """``GF`` can only mean ``G F``."""
    assert parse(text) is parse(same)


@pytest.mark.parametrize("name", ["FGa", "GFa", "Gate", "X1", "U2", "aUb", "_", "a_1", "nota", "T"])
def test_a_word_is_read_whole(name: str) -> None:
    """Letters of operators inside a longer word don't split it."""
    assert parse(name) is atom(name)


@pytest.mark.parametrize(
    ("text", "line"),
    [
        ("G F (p1 & )", "column 11: expected an operand after '&', found ')' in \"G F (p1 & )\""),
        ("", 'column 1: expected a formula, found the end in ""'),
        ("   ", 'column 4: expected a formula, found the end in "   "'),
        (")", "column 1: expected a formula, found ')' in \")\""),
        ("a b", "column 3: expected an operator or the end after 'a', found 'b' in \"a b\""),
        ("a & ", "column 5: expected an operand after '&', found the end in \"a & \""),
        ("a U U b", "column 5: expected an operand after 'U', found 'U' in \"a U U b\""),
        ("F", "column 2: expected an operand after 'F', found the end in \"F\""),
        (
            "a & (b | (c)",
            (
                "column 13: expected an operator after ')' or ')' to close the '(' at column 5,"
                ' found the end in "a & (b | (c)"'
            ),
        ),
        ("a)", "column 2: expected an operator or the end after 'a', found ')' in \"a)\""),
        ("()", "column 2: expected an operand after '(', found ')' in \"()\""),
        ("2", "column 1: expected a formula, found '2' in \"2\""),
        ("10", "column 1: expected a formula, found '10' in \"10\""),
        ("a $ b", "column 3: expected an operator or the end after 'a', found '$' in \"a $ b\""),
        ("a = b", "column 3: expected an operator or the end after 'a', found '=' in \"a = b\""),
        ("a - b", "column 3: expected an operator or the end after 'a', found '-' in \"a - b\""),
        ("é", "column 1: expected a formula, found 'é' in \"é\""),
        ("a\n& \x00", "column 5: expected an operand after '&', found '\\x00' in \"a\\n& \\x00\""),
        ("\ud800", "column 1: expected a formula, found '\\ud800' in \"\\ud800\""),
    ],
)
def test_errors_point_at_the_place(text: str, line: str) -> None:
    """The one line about an error has the column, what was expected, what was found, the text."""
    with pytest.raises(FormulaError) as caught:
        parse(text)
    assert explain(caught.value) == line
    assert caught.value.text == text


def test_long_formulas_are_cut_around_the_place() -> None:
    """The line about an error stays short and shows the text around the place."""
    with pytest.raises(FormulaError) as caught:
        parse("a & " * 1000 + "(b | | c)" + " & a" * 1000)
    assert caught.value.position == 4005
    line = explain(caught.value)
    assert len(line) < 160
    assert "(b | | c)" in line
    assert line.count("…") == 2


@pytest.mark.parametrize("opening", ["(", "!", "X ", "G(", "a U ", "a -> ", "not "])
def test_deep_nesting_is_refused(opening: str) -> None:
    """10,000 open parentheses or operators give an error that states the limit."""
    with pytest.raises(FormulaError, match="nested deeper than 1000 levels"):
        parse(opening * 10_000 + "a" + ")" * (10_000 * opening.count("(")))


def test_nesting_up_to_the_limit_is_read() -> None:
    """Exactly as many levels as stated are read, and long flat chains don't count as nested."""
    assert str(parse("!" * MAX_NESTING + "a")) == "!" * MAX_NESTING + "a"
    chain = " & ".join(["a"] * 5000)
    assert str(parse(chain)) == chain


@pytest.mark.parametrize("garbage", ["(", "a&", "\x00", "a ", "<", "😀", "a|b->"])
def test_a_megabyte_of_garbage_is_refused(garbage: str) -> None:
    """A text far beyond the limit of length is an input error, whatever stands in it."""
    with pytest.raises(FormulaError, match=f"longer than {MAX_LENGTH} characters") as caught:
        parse(garbage * (1_000_000 // len(garbage)))
    assert len(explain(caught.value)) < 700
