"""The words of a text in the Hanoi Omega-Automata format, and its label expressions.

- ``Token``        one word, and where it stands
- ``Cursor``       the words in turn
- ``label``        a label expression as a formula
- ``letters_of``   the letters that satisfy such a formula, as a guard
"""

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Final

from tlcomm_core.errors import InputError
from tlcomm_core.ltl.formula import FALSE, TRUE, Formula, Operator, atom, subformulas
from tlcomm_core.ltl.guard import Cube, Guard, simplified
from tlcomm_core.ltl.normal_form import negation_normal_form

__all__ = ["MAX_CUBES", "MAX_LENGTH", "Cursor", "Token", "label", "letters_of"]

MAX_LENGTH: Final = 2_000_000
MAX_CUBES: Final = 1000
_MAX_DIGITS: Final = 9

_TOKEN: Final = re.compile(
    r'(?P<space>[ \t\r\n]+)|(?P<comment>/\*)|(?P<string>"(?:\\.|[^"\\])*")'
    r"|(?P<header>[A-Za-z_][A-Za-z0-9_-]*:)|(?P<marker>--(?:BODY|END|ABORT)--)"
    r"|(?P<word>[A-Za-z_][A-Za-z0-9_-]*)|(?P<alias>@[A-Za-z0-9_-]+)"
    r"|(?P<number>0|[1-9][0-9]*)|(?P<sign>[\[\](){}!&|])",
    re.DOTALL,
)
_COMMENT_MARK: Final = re.compile(r"/\*|\*/")
_STRENGTH: Final = {"|": 1, "&": 2, "!": 3}
_SHOWN: Final = 40


@dataclass(frozen=True, slots=True)
class Token:
    """A word of the text.

    Attributes:
        kind: string, header, marker, word, alias, number, sign, or end.
        text: as it stands there.
        line: counted from 1.
    """

    kind: str
    text: str
    line: int

    def error(self, reason: str) -> InputError:
        """Return an error about this word."""
        shown = self.text if len(self.text) <= _SHOWN else f"{self.text[:_SHOWN]}…"
        found = "the end" if self.kind == "end" else repr(shown)
        return InputError(f"automaton, line {self.line}: {reason}, found {found}")


class Cursor:
    """Reads word after word."""

    def __init__(self, text: str) -> None:
        """Stand before the first word.

        Raises:
            InputError: there is a character that begins no word, or the text is too long.
        """
        if len(text) > MAX_LENGTH:
            raise InputError(f"automaton: {len(text)} characters, at most {MAX_LENGTH} are read")
        self._tokens: Final = tuple(_tokens(text))
        self._place = 0

    @property
    def next(self) -> Token:
        """The word ahead."""
        return self._tokens[self._place]

    def take(self) -> Token:
        """Return the word ahead and step over it."""
        token = self.next
        self._place += token.kind != "end"
        return token

    def skip(self, text: str) -> bool:
        """Step over a certain word if it is ahead; return whether it was."""
        found = self.next.text == text and self.next.kind in {"sign", "header"}
        self._place += found
        return found

    def expect(self, kind: str, expected: str) -> Token:
        """Step over a word of a kind, or raise an error that says what was expected."""
        if self.next.kind != kind:
            raise self.next.error(f"expected {expected}")
        return self.take()

    def sign(self, text: str) -> None:
        """Step over a certain sign, or raise an error."""
        if not self.skip(text):
            raise self.next.error(f"expected {text!r}")

    def number(self, expected: str, below: int | None = None) -> int:
        """Step over a number and return it; it may have to be below a bound."""
        token = self.expect("number", expected)
        if len(token.text) > _MAX_DIGITS or (below is not None and int(token.text) >= below):
            bound = "" if below is None else f" below {below}"
            raise token.error(f"expected {expected}{bound}")
        return int(token.text)

    def string(self, expected: str) -> str:
        """Step over a string in quotes and return its content."""
        text = self.expect("string", expected).text
        return re.sub(r"\\(.)", r"\1", text[1:-1], flags=re.DOTALL)


def _tokens(text: str) -> Iterator[Token]:
    place, line = 0, 1
    while place < len(text):
        match = _TOKEN.match(text, place)
        if match is None or match.lastgroup is None:
            raise Token("sign", text[place], line).error("expected no such character")
        end = _comment_end(text, place, line) if match.lastgroup == "comment" else match.end()
        if match.lastgroup not in {"comment", "space"}:
            yield Token(match.lastgroup, match.group(), line)
        line += text.count("\n", place, end)
        place = end
    yield Token("end", "", line)


def _comment_end(text: str, start: int, line: int) -> int:
    """Return where a comment is over; comments nest."""
    depth = 0
    for mark in _COMMENT_MARK.finditer(text, start):
        depth += 1 if mark.group() == "/*" else -1
        if depth == 0:
            return mark.end()
    raise Token("sign", "/*", line).error("expected a comment that ends")


def label(cursor: Cursor, names: Sequence[str], aliases: Mapping[str, Formula]) -> Formula:
    """Read a label expression, up to the first word that can't belong to it.

    Args:
        cursor: where it begins.
        names: the atoms, by number.
        aliases: the expressions that names beginning with ``@`` stand for.

    Raises:
        InputError: it is malformed.
    """
    operands: list[Formula] = []
    operators: list[str] = []

    def reduce(least: int) -> None:
        while operators and _STRENGTH.get(operators[-1], 0) >= least:
            _apply(operators.pop(), operands)

    while True:
        while cursor.next.kind == "sign" and cursor.next.text in {"!", "("}:
            operators.append(cursor.take().text)
        operands.append(_operand(cursor, names, aliases))
        reduce(_STRENGTH["!"])
        while "(" in operators and cursor.skip(")"):
            reduce(1)
            operators.pop()
            reduce(_STRENGTH["!"])
        if not (cursor.next.kind == "sign" and cursor.next.text in {"&", "|"}):
            break
        operator = cursor.take().text
        reduce(_STRENGTH[operator])
        operators.append(operator)
    if "(" in operators:
        raise cursor.next.error("expected ')'")
    reduce(1)
    return operands[0]


def _apply(operator: str, operands: list[Formula]) -> None:
    right = operands.pop()
    if operator == "!":
        operands.append(Formula(Operator.NOT, (right,)))
    else:
        kind = Operator.AND if operator == "&" else Operator.OR
        operands.append(Formula(kind, (operands.pop(), right)))


def _operand(cursor: Cursor, names: Sequence[str], aliases: Mapping[str, Formula]) -> Formula:
    token = cursor.next
    if token.kind == "number":
        return atom(names[cursor.number("the number of an atom", below=len(names))])
    if token.kind == "word" and token.text in {"t", "f"}:
        return TRUE if cursor.take().text == "t" else FALSE
    if token.kind == "alias" and token.text in aliases:
        return aliases[cursor.take().text]
    raise token.error("expected 't', 'f', the number of an atom or a known alias")


def letters_of(formula: Formula, token: Token) -> Guard:
    """Return the guard that a formula without temporal operators describes.

    Args:
        formula: from ``label``.
        token: where to say it is if the guard is too large.

    Raises:
        InputError: it takes more than ``MAX_CUBES`` cubes.
    """
    cubes: dict[Formula, set[Cube]] = {}
    normal = negation_normal_form(formula)
    for node in subformulas(normal):
        cubes[node] = _cubes(node, [cubes[child] for child in node.children])
        if len(cubes[node]) > MAX_CUBES:
            raise token.error(f"expected a label of at most {MAX_CUBES} cubes")
    return simplified(cubes[normal])


def _cubes(node: Formula, parts: list[set[Cube]]) -> set[Cube]:
    match node.operator:
        case Operator.ATOM:
            return {Cube(frozenset([node.name]), frozenset())}
        case Operator.NOT:
            return {Cube(frozenset(), frozenset([node.children[0].name]))}
        case Operator.OR:
            return parts[0] | parts[1]
        case Operator.AND:
            return {
                Cube(one.required | other.required, one.forbidden | other.forbidden)
                for one in parts[0]
                for other in parts[1]
                if one.is_compatible(other)
            }
        case _:
            return {Cube(frozenset(), frozenset())} if node is TRUE else set()
