"""Linear temporal logic formulas as immutable, interned trees.

- ``Operator``      the kinds of node
- ``Formula``       a node; equal formulas are the same object
- ``TRUE``, ``FALSE``, ``atom``   the leaves
- ``subformulas``   every distinct subformula, children first
- ``atoms``         the names that a formula reads
- ``conjunction``   of several formulas
- ``to_text``       text that the parser reads back, with as few parentheses as it needs

Nothing here recurses, so a formula's depth is bounded by memory alone.
"""

from collections.abc import Iterable, Iterator
from enum import Enum
from hashlib import blake2b
from threading import Lock
from typing import Final, NoReturn
from weakref import WeakValueDictionary

from tlcomm_core.errors import LocalMisuseError

__all__ = ["FALSE", "TRUE", "Formula", "Operator", "atom", "atoms", "subformulas", "to_text"]


class Operator(Enum):
    """The kinds of node; the value is how the operator is printed."""

    TRUE = "true"
    FALSE = "false"
    ATOM = "atom"
    NOT = "!"
    NEXT = "X"
    EVENTUALLY = "F"
    ALWAYS = "G"
    AND = "&"
    OR = "|"
    IMPLIES = "->"
    IFF = "<->"
    UNTIL = "U"
    RELEASE = "R"
    WEAK_UNTIL = "W"
    STRONG_RELEASE = "M"

    @property
    def arity(self) -> int:
        """Number of operands: 0, 1 or 2."""
        if self in _LEAVES:
            return 0
        return 1 if self in _UNARY else 2


_LEAVES: Final = frozenset({Operator.TRUE, Operator.FALSE, Operator.ATOM})
_UNARY: Final = frozenset({Operator.NOT, Operator.NEXT, Operator.EVENTUALLY, Operator.ALWAYS})

# Binding strength of the binary operators; a unary operator binds tighter than all of them.
_STRENGTH: Final = {
    Operator.IMPLIES: 1,
    Operator.IFF: 1,
    Operator.OR: 2,
    Operator.AND: 3,
    Operator.UNTIL: 4,
    Operator.RELEASE: 4,
    Operator.WEAK_UNTIL: 4,
    Operator.STRONG_RELEASE: 4,
}
_UNARY_STRENGTH: Final = 5
_LEFT_ASSOCIATIVE: Final = frozenset({Operator.AND, Operator.OR})


class Formula:
    """One node of a formula.

    Building the same formula twice gives the same object, so ``==`` and ``is`` mean the same and
    cost one comparison. The hash depends on the content alone, not on the process, so sets of
    formulas iterate alike in every run.

    Attributes:
        operator: the kind of node.
        children: the operands, left to right.
        name: the atom's name, empty for every other kind.
        digest: a content hash of 128 bits; a total order that is the same in every run.
    """

    __slots__ = ("__weakref__", "_hash", "children", "digest", "name", "operator")

    operator: Operator
    children: tuple["Formula", ...]
    name: str
    digest: bytes
    _hash: int

    def __new__(  # noqa: PYI034  there are no subclasses
        cls, operator: Operator, children: tuple["Formula", ...] = (), name: str = ""
    ) -> "Formula":
        """Return the one node with this content.

        Raises:
            LocalMisuseError: the number of operands doesn't fit, or an atom has no name.
        """
        if len(children) != operator.arity or bool(name) != (operator is Operator.ATOM):
            message = f"malformed node: {operator!r} with {len(children)} operands, name {name!r}"
            raise LocalMisuseError(message)
        key = (operator, children, name)
        with _TABLE_LOCK:
            node = _TABLE.get(key)
            if node is None:
                node = _make(operator, children, name)
                _TABLE[key] = node
        return node

    def __setattr__(self, attribute: str, value: object) -> NoReturn:
        """Refuse: a formula never changes."""
        message = f"a formula is immutable; {attribute!r} can't become {value!r}"
        raise AttributeError(message)

    def __hash__(self) -> int:
        """Return the content hash."""
        return self._hash

    def __str__(self) -> str:
        """Return parseable text."""
        return to_text(self)

    def __repr__(self) -> str:
        """Return the text in quotes."""
        return f"Formula({to_text(self)!r})"

    def __reduce__(self) -> tuple[object, ...]:
        """Pickle as a flat list of nodes, so that reading back interns and never recurses."""
        order = list(subformulas(self))
        place = {node: index for index, node in enumerate(order)}
        rows = [(n.operator, tuple(place[c] for c in n.children), n.name) for n in order]
        return _rebuild, (rows,)

    def __copy__(self) -> "Formula":
        """Return this formula: there is only one."""
        return self

    def __deepcopy__(self, memo: dict[int, object]) -> "Formula":
        """Return this formula: there is only one."""
        return self


_TABLE: Final[WeakValueDictionary[tuple[Operator, tuple[Formula, ...], str], Formula]] = (
    WeakValueDictionary()
)
_TABLE_LOCK: Final = Lock()


def _make(operator: Operator, children: tuple[Formula, ...], name: str) -> Formula:
    content = b"".join([operator.value.encode(), b" ", *(child.digest for child in children)])
    digest = blake2b(content + name.encode("utf-8", "surrogatepass"), digest_size=16).digest()
    node = object.__new__(Formula)
    for attribute, value in (
        ("operator", operator),
        ("children", children),
        ("name", name),
        ("digest", digest),
        ("_hash", int.from_bytes(digest[:7], "big")),
    ):
        object.__setattr__(node, attribute, value)
    return node


def _rebuild(rows: list[tuple[Operator, tuple[int, ...], str]]) -> Formula:
    nodes: list[Formula] = []
    for operator, places, name in rows:
        nodes.append(Formula(operator, tuple(nodes[place] for place in places), name))
    return nodes[-1]


TRUE: Final = Formula(Operator.TRUE)
FALSE: Final = Formula(Operator.FALSE)


def atom(name: str) -> Formula:
    """Return the atomic proposition called ``name``."""
    return Formula(Operator.ATOM, (), name)


def subformulas(formula: Formula) -> Iterator[Formula]:
    """Yield every distinct subformula once, children before parents, the formula itself last."""
    entered: set[Formula] = set()
    stack = [(formula, False)]
    while stack:
        node, children_done = stack.pop()
        if children_done:
            yield node
        elif node not in entered:
            entered.add(node)
            stack.append((node, True))
            stack.extend((child, False) for child in reversed(node.children))


def atoms(formula: Formula) -> tuple[str, ...]:
    """Return the names of the atoms in the order of their first appearance."""
    return tuple(node.name for node in subformulas(formula) if node.operator is Operator.ATOM)


def conjunction(parts: Iterable[Formula]) -> Formula:
    """Return the conjunction of some formulas, joined from the left; of none, true."""
    members = iter(parts)
    whole = next(members, TRUE)
    for part in members:
        whole = Formula(Operator.AND, (whole, part))
    return whole


def to_text(formula: Formula) -> str:
    """Return text that parses back to the same formula, with minimal parentheses.

    Cost: linear in the text.
    """
    parts: list[str] = []
    stack: list[Formula | str] = [formula]
    while stack:
        item = stack.pop()
        if isinstance(item, str):
            parts.append(item)
        else:
            stack.extend(reversed(_pieces(item)))
    return "".join(parts)


def _pieces(node: Formula) -> list[Formula | str]:
    operator, children = node.operator, node.children
    if operator is Operator.ATOM:
        return [node.name]
    if operator.arity == 0:
        return [operator.value]
    if operator.arity == 1:
        sign = operator.value if operator is Operator.NOT else f"{operator.value} "
        return [sign, *_wrapped(children[0], _UNARY_STRENGTH)]
    strength = _STRENGTH[operator]
    left_associative = operator in _LEFT_ASSOCIATIVE
    return [
        *_wrapped(children[0], strength if left_associative else strength + 1),
        f" {operator.value} ",
        *_wrapped(children[1], strength + 1 if left_associative else strength),
    ]


def _wrapped(child: Formula, least_strength: int) -> list[Formula | str]:
    strength = _STRENGTH.get(child.operator, _UNARY_STRENGTH)
    return [child] if strength >= least_strength else ["(", child, ")"]
