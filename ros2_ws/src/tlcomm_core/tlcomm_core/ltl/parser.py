"""Text to formula, with errors that point at the character.

- ``parse``         the formula that a text means
- ``explain``       one line about a ``FormulaError``, for a command line
- ``MAX_NESTING``   how many parentheses and operators may be open at one place
- ``MAX_LENGTH``    how many characters a formula may have

Grammar, from the loosest to the tightest binding (as in Spot):

====================================  =============  ==========================
operators                             associativity  meaning
====================================  =============  ==========================
``->`` ``<->``                        right          implication, equivalence
``|`` ``||``                          left           disjunction
``&`` ``&&``                          left           conjunction
``U`` ``R`` ``V`` ``W`` ``M``         right          until, release (both R and
                                                     V), weak until, strong
                                                     release
``F`` ``<>`` ``G`` ``[]`` ``X``       prefix         eventually, always, next
``!`` ``~`` ``not``                   prefix         negation
====================================  =============  ==========================

Operands are ``true`` ``1`` ``false`` ``0``, a formula in parentheses, or an atom: a letter or
underscore, then letters, digits and underscores (ASCII), except the words above. A word is read
whole: ``FGa`` is an atom, ``F G a`` is not. (Spot would split it; here regions may be called
``Gate`` and actions ``Fill``.) Only a word of nothing but ``F``, ``G`` and ``X`` is a run of
operators: ``GF (a)`` is ``G F a``.
"""

import re
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Final

from tlcomm_core.errors import FormulaError
from tlcomm_core.ltl.formula import FALSE, TRUE, Formula, Operator, atom

__all__ = ["MAX_LENGTH", "MAX_NESTING", "explain", "parse"]

MAX_NESTING: Final = 1000
MAX_LENGTH: Final = 100_000

_TOKEN: Final = re.compile(
    r"""[ \t\r\n]*
    (<->|->|<>|\[\]|&&|\|\||
    [FGX](?=[FGX]+(?![A-Za-z0-9_]))|  # one letter of a run of prefix operators
    [A-Za-z0-9_]+|.|\Z)""",
    re.DOTALL | re.VERBOSE,
)
_CONSTANTS: Final = {"true": TRUE, "1": TRUE, "false": FALSE, "0": FALSE}
_PREFIX: Final = {
    "!": Operator.NOT,
    "~": Operator.NOT,
    "not": Operator.NOT,
    "X": Operator.NEXT,
    "F": Operator.EVENTUALLY,
    "<>": Operator.EVENTUALLY,
    "G": Operator.ALWAYS,
    "[]": Operator.ALWAYS,
}
_INFIX: Final = {
    "->": Operator.IMPLIES,
    "<->": Operator.IFF,
    "|": Operator.OR,
    "||": Operator.OR,
    "&": Operator.AND,
    "&&": Operator.AND,
    "U": Operator.UNTIL,
    "R": Operator.RELEASE,
    "V": Operator.RELEASE,
    "W": Operator.WEAK_UNTIL,
    "M": Operator.STRONG_RELEASE,
}
_LOOSEST_FIRST: Final = (
    {Operator.IMPLIES, Operator.IFF},
    {Operator.OR},
    {Operator.AND},
    {Operator.UNTIL, Operator.RELEASE, Operator.WEAK_UNTIL, Operator.STRONG_RELEASE},
    set(_PREFIX.values()),
)
_BINDING: Final = {op: level for level, ops in enumerate(_LOOSEST_FIRST) for op in ops}
_LEFT_ASSOCIATIVE: Final = frozenset({Operator.AND, Operator.OR})

_QUOTED_CHARACTERS: Final = 30
_EXCERPT_CHARACTERS: Final = 60


@dataclass(frozen=True, slots=True)
class _Token:
    text: str
    position: int

    @property
    def quoted(self) -> str:
        """How errors show it."""
        if not self.text:
            return "the end"
        return f"'{_printable(_cut(self.text, _QUOTED_CHARACTERS))}'"


@dataclass(frozen=True, slots=True)
class _Open:
    """Something that still waits for its right end: an operator, or (None) a parenthesis."""

    operator: Operator | None
    position: int


def parse(text: str) -> Formula:
    """Return the formula that ``text`` means.

    Raises:
        FormulaError: the text isn't a formula, is longer than ``MAX_LENGTH`` characters, or more
            than ``MAX_NESTING`` parentheses and operators are open at one place.
    Cost: linear in the text.
    """
    if len(text) > MAX_LENGTH:
        reason = f"longer than {MAX_LENGTH} characters ({len(text)})"
        raise FormulaError(reason, text, MAX_LENGTH)
    return _Parser(text).run()


class _Parser:
    """Operator-precedence parsing with explicit stacks."""

    def __init__(self, text: str) -> None:
        self._text = text
        self._operands: list[Formula] = []
        self._open: list[_Open] = []
        self._parentheses = 0
        self._previous: _Token | None = None

    def run(self) -> Formula:
        """Return the formula; ``FormulaError`` points at the first token that doesn't fit."""
        expect_operand = True
        for token in _tokens(self._text):
            expect_operand = self._operand(token) if expect_operand else self._infix(token)
            self._previous = token
        assert len(self._operands) == 1
        assert not self._open
        return self._operands.pop()

    def _operand(self, token: _Token) -> bool:
        """Take a token where an operand must begin; return whether it must still begin."""
        if token.text in _CONSTANTS:
            self._operands.append(_CONSTANTS[token.text])
            return False
        if token.text in _PREFIX:
            self._push(_PREFIX[token.text], token)
            return True
        if token.text == "(":
            self._parentheses += 1
            self._push(None, token)
            return True
        if token.text not in _INFIX and re.match(r"[A-Za-z_]", token.text):
            self._operands.append(atom(token.text))
            return False
        after = f"an operand after {self._previous.quoted}" if self._previous else "a formula"
        raise self._error(f"expected {after}, found {token.quoted}", token)

    def _infix(self, token: _Token) -> bool:
        """Take a token after an operand; return whether an operand must follow."""
        operator = _INFIX.get(token.text)
        if operator is not None:
            self._reduce(_BINDING[operator], inclusive=operator in _LEFT_ASSOCIATIVE)
            self._push(operator, token)
            return True
        if token.text == ")" and self._parentheses:
            self._reduce(-1, inclusive=True)
            self._open.pop()
            self._parentheses -= 1
            return False
        if not token.text and not self._parentheses:
            self._reduce(-1, inclusive=True)
            return False
        raise self._error(f"expected {self._what_may_follow()}, found {token.quoted}", token)

    def _what_may_follow(self) -> str:
        assert self._previous is not None
        if not self._parentheses:
            return f"an operator or the end after {self._previous.quoted}"
        opened = next(entry for entry in reversed(self._open) if entry.operator is None)
        closing = f"')' to close the '(' at column {opened.position + 1}"
        return f"an operator after {self._previous.quoted} or {closing}"

    def _push(self, operator: Operator | None, token: _Token) -> None:
        if len(self._open) >= MAX_NESTING:
            raise self._error(f"nested deeper than {MAX_NESTING} levels", token)
        self._open.append(_Open(operator, token.position))

    def _reduce(self, binding: int, *, inclusive: bool) -> None:
        """Finish the operators that bind tighter than ``binding`` (or equally, if inclusive)."""
        while self._open:
            operator = self._open[-1].operator
            if operator is None:
                return
            strength = _BINDING[operator]
            if strength < binding or (strength == binding and not inclusive):
                return
            self._open.pop()
            children = tuple(self._operands[-operator.arity :])
            del self._operands[-operator.arity :]
            self._operands.append(Formula(operator, children))

    def _error(self, reason: str, token: _Token) -> FormulaError:
        return FormulaError(reason, self._text, token.position)


def _tokens(text: str) -> Iterator[_Token]:
    """Yield the tokens, then one empty token at the end."""
    position = 0
    while True:
        match = _TOKEN.match(text, position)
        assert match is not None
        yield _Token(match[1], match.start(1))
        if not match[1]:
            return
        position = match.end()


def explain(error: FormulaError) -> str:
    """Return one line: the column (from 1), what is wrong, and the text around the place."""
    excerpt = _printable(_around(error.text, error.position))
    return f'column {error.position + 1}: {error} in "{excerpt}"'


def _around(text: str, position: int) -> str:
    """Return the text around a position, cut to a line's length."""
    start = max(0, min(position - _EXCERPT_CHARACTERS // 2, len(text) - _EXCERPT_CHARACTERS))
    end = start + _EXCERPT_CHARACTERS
    return f"{'…' * (start > 0)}{text[start:end]}{'…' * (end < len(text))}"


def _cut(text: str, characters: int) -> str:
    return text if len(text) <= characters else f"{text[:characters]}…"


def _printable(text: str) -> str:
    """Return the text with line breaks and other control characters escaped."""
    shown = (c if c.isprintable() else c.encode("unicode_escape").decode("ascii") for c in text)
    return "".join(shown)
