"""Functions from letters to numbers, as shared decision diagrams.

- ``DecisionDiagrams``   a table of diagrams over one fixed order of atoms

A node is an index; equal functions have equal indices, so that comparing two functions costs one
comparison. Children always have smaller indices than their parents.

Source: Bryant, "Graph-based algorithms for Boolean function manipulation", 1986, with more than
two terminals.
"""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass

__all__ = ["DecisionDiagrams"]


@dataclass(frozen=True, slots=True)
class _Leaf:
    value: int


@dataclass(frozen=True, slots=True)
class _Branch:
    atom: int
    if_false: int
    if_true: int


class DecisionDiagrams:
    """A table of shared, reduced, ordered decision diagrams with integer values."""

    def __init__(self) -> None:
        """Begin with no function."""
        self._nodes: list[_Leaf | _Branch] = []
        self._index: dict[_Leaf | _Branch, int] = {}

    def leaf(self, value: int) -> int:
        """Return the function that is ``value`` on every letter."""
        return self._intern(_Leaf(value))

    def branch(self, atom: int, if_false: int, if_true: int) -> int:
        """Return the function that is one of two others, depending on an atom.

        Both must read atoms after ``atom`` only.
        """
        if if_false == if_true:
            return if_false
        return self._intern(_Branch(atom, if_false, if_true))

    def leaves(self, root: int) -> Iterator[int]:
        """Yield the values that the function takes, each once, those of more false atoms first."""
        seen: set[int] = set()
        stack = [root]
        while stack:
            index = stack.pop()
            if index in seen:
                continue
            seen.add(index)
            node = self._nodes[index]
            if isinstance(node, _Leaf):
                yield node.value
            else:
                stack += (node.if_true, node.if_false)

    def relabelled(
        self, roots: Iterable[int], values: Sequence[int]
    ) -> tuple["DecisionDiagrams", list[int]]:
        """Return a new table and these functions in it, with value v replaced by ``values[v]``.

        Cost: linear in the size of the whole table.
        """
        table = DecisionDiagrams()
        fresh: list[int] = []
        for node in self._nodes:
            if isinstance(node, _Leaf):
                fresh.append(table.leaf(values[node.value]))
            else:
                fresh.append(table.branch(node.atom, fresh[node.if_false], fresh[node.if_true]))
        return table, [fresh[root] for root in roots]

    def paths(self, root: int) -> Iterator[tuple[int, int]]:
        """Yield (literals, value) for every path, literals as bits.

        Bit 2i requires atom i, bit 2i + 1 forbids it. The paths' literals exclude each other and
        together cover every letter.
        """
        stack = [(root, 0)]
        while stack:
            index, literals = stack.pop()
            node = self._nodes[index]
            if isinstance(node, _Leaf):
                yield literals, node.value
            else:
                stack.append((node.if_true, literals | 1 << (2 * node.atom)))
                stack.append((node.if_false, literals | 1 << (2 * node.atom + 1)))

    def _intern(self, node: _Leaf | _Branch) -> int:
        index = self._index.setdefault(node, len(self._nodes))
        if index == len(self._nodes):
            self._nodes.append(node)
        return index
