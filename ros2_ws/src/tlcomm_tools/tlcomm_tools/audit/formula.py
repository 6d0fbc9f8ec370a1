"""Formulas read and evaluated on finite words, independently of the planner's own.

``read_formula``     text to a tree
``recurring_part``   φ of a formula □◇φ
``count_fulfilled``  when φ, begun anew each time, was fulfilled in a word

Trees are tuples: an operator and its operands, or ("atom", name).
"""

import re
from collections.abc import Callable, Sequence
from typing import Any

from tlcomm_core.errors import InputError
from tlcomm_tools.audit.words import Letter

__all__ = ["Tree", "count_fulfilled", "read_formula", "recurring_part"]

Tree = tuple[Any, ...]

_TOKEN = re.compile(r"\s*(<->|->|<>|\[\]|&&?|\|\|?|[!~()]|[FGX](?=[FGX]+\b)|[A-Za-z0-9_]+|$)")
_SAME = {"&&": "&", "||": "|", "<>": "F", "[]": "G", "~": "!", "not": "!", "V": "R"}
_UNARY = {"!", "X", "F", "G"}
# From the loosest to the tightest; all but & and | are right-associative, and those associative.
_LEVELS = (("->", "<->"), ("|",), ("&",), ("U", "R", "W", "M"))
_DUAL = {"&": "|", "|": "&", "U": "R", "R": "U", "W": "M", "M": "W", "F": "G", "G": "F", "X": "X"}
_CO_SAFE = {"atom", "!", "true", "false", "&", "|", "X", "F", "U", "M"}


def read_formula(text: str) -> Tree:
    """Read a formula with the operators and precedence of the scenario file.

    Raises:
        InputError: it can't be read.
    """
    tokens = []
    position = 0
    while position < len(text.rstrip()):
        match = _TOKEN.match(text, position)
        if match is None:
            raise InputError(f"formula {text!r}: {text[position:].strip()[:1]!r} isn't expected")
        tokens.append(_SAME.get(match[1], match[1]))
        position = match.end()
    reader = _Reader(tokens, text)
    tree = reader.binary(0)
    if reader.tokens:
        raise InputError(f"formula {text!r}: {reader.tokens[-1]!r} isn't expected")
    return _normal(tree, positive=True)


class _Reader:
    """Reads a formula by recursive descent, a method per kind of operator."""

    def __init__(self, tokens: Sequence[str], text: str) -> None:
        self.tokens = list(reversed(tokens))
        self._text = text

    def binary(self, level: int) -> Tree:
        """Read operands joined by the binary operators from this level of precedence on."""
        if level == len(_LEVELS):
            return self.unary()
        left = self.binary(level + 1)
        if self.tokens and self.tokens[-1] in _LEVELS[level]:
            operator = self.tokens.pop()
            return (operator, left, self.binary(level))
        return left

    def unary(self) -> Tree:
        """Read an operand with the unary operators in front of it."""
        if not self.tokens:
            raise InputError(f"formula {self._text!r}: it ends too early")
        word = self.tokens.pop()
        if word in _UNARY:
            return (word, self.unary())
        if word == "(":
            inner = self.binary(0)
            if not self.tokens or self.tokens.pop() != ")":
                raise InputError(f"formula {self._text!r}: a ')' is missing")
            return inner
        if word in {"true", "1"}:
            return ("true",)
        if word in {"false", "0"}:
            return ("false",)
        if not word[:1].isalpha():
            raise InputError(f"formula {self._text!r}: {word!r} isn't expected")
        return ("atom", word)


def _normal(tree: Tree, *, positive: bool) -> Tree:
    """Return the tree, or its negation, with negations at atoms alone and no arrows."""
    operator, *operands = tree
    if operator == "!":
        return _normal(operands[0], positive=not positive)
    if operator == "atom":
        return tree if positive else ("!", tree)
    if operator in {"true", "false"}:
        return ("true",) if (operator == "true") is positive else ("false",)
    if operator == "->":
        return _normal(("|", ("!", operands[0]), operands[1]), positive=positive)
    if operator == "<->":
        left, right = operands
        both = ("|", ("&", left, right), ("&", ("!", left), ("!", right)))
        return _normal(both, positive=positive)
    inner = [_normal(operand, positive=positive) for operand in operands]
    return (operator if positive else _DUAL[operator], *inner)


def recurring_part(tree: Tree) -> Tree | None:
    """Return φ of □◇φ with co-safe φ, or ``None`` for any other formula."""
    if tree[0] != "G" or tree[1][0] != "F":
        return None
    part: Tree = tree[1][1]
    return part if _is_co_safe(part) else None


def _is_co_safe(tree: Tree) -> bool:
    operator, *operands = tree
    if operator == "atom":
        return True
    return operator in _CO_SAFE and all(_is_co_safe(operand) for operand in operands)


def count_fulfilled(part: Tree, word: Sequence[Letter]) -> list[int]:
    """Return the indices at which ◇φ, begun anew after each one, is fulfilled.

    Args:
        part: φ, co-safe.
        word: letters in order.

    Cost: O(n·log n) evaluations of a letter between two fulfilments n letters apart.
    """
    ends: list[int] = []
    start = 0
    while (length := _least_length(("F", part), word[start:])) is not None:
        start += length
        ends.append(start - 1)
    return ends


def _least_length(tree: Tree, word: Sequence[Letter]) -> int | None:
    """Return the length of the shortest prefix that fulfils the formula however it goes on.

    Every longer prefix does so too, hence the doubling and halving.
    """
    low, high = 0, 1
    while not _holds(tree, word[:high]):
        if high >= len(word):
            return None
        low, high = high, min(2 * high, len(word))
    while high - low > 1:
        middle = (low + high) // 2
        low, high = (low, middle) if _holds(tree, word[:middle]) else (middle, high)
    return high


def _holds(tree: Tree, word: Sequence[Letter]) -> bool:
    """Whether the formula holds at the word's begin, whatever follows its end."""
    return bool(word) and _values(tree, word)[0]


def _values(tree: Tree, word: Sequence[Letter]) -> list[bool]:
    """Return the formula's value at each letter; what the end leaves open is false."""
    operator, *operands = tree
    if operator == "atom":
        return [operands[0] in letter for letter in word]
    if operator in {"true", "false"}:
        return [operator == "true"] * len(word)
    columns = [_values(operand, word) for operand in operands]
    if operator == "!":
        return [not value for value in columns[0]]
    if operator == "X":
        return [*columns[0][1:], False]
    step = _STEPS[operator]
    values: list[bool] = []
    later = False
    for row in zip(*(reversed(column) for column in columns), strict=True):
        later = step(later, *row)
        values.append(later)
    return values[::-1]


_STEPS: dict[str, Callable[..., bool]] = {
    "&": lambda _, left, right: left and right,
    "|": lambda _, left, right: left or right,
    "F": lambda later, value: value or later,
    "U": lambda later, left, right: right or (left and later),
    "M": lambda later, left, right: right and (left or later),
}
