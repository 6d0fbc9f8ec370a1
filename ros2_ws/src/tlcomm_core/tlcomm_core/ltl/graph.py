"""Generalized Büchi automata under construction.

- ``Edge``, ``Graph``   states and atoms are numbers, guards are cubes
- ``check_size``        refuses graphs beyond ``MAX_STATES`` and ``MAX_EDGES``
"""

from dataclasses import dataclass
from typing import Final

from tlcomm_core.errors import IntractableTaskError

__all__ = ["MAX_EDGES", "MAX_STATES", "Edge", "Graph", "check_size"]

MAX_STATES: Final = 2_000
MAX_EDGES: Final = 20_000


@dataclass(frozen=True, slots=True, order=True)
class Edge:
    """An edge on the letters that satisfy a cube.

    Attributes:
        literals: bit 2i requires atom i, bit 2i + 1 forbids it; in a grouped graph, the number of
            a guard.
        target: index of the state it leads to.
        marks: bit set of the acceptance marks that it carries.
    """

    literals: int
    target: int
    marks: int


@dataclass(frozen=True, slots=True)
class Graph:
    """A generalized Büchi automaton: a run must carry every mark again and again.

    Attributes:
        rows: per state its edges; state 0 is the initial one.
        mark_count: number of acceptance marks; with none, every run accepts.
    """

    rows: tuple[tuple[Edge, ...], ...]
    mark_count: int


def check_size(states: int, edges: int) -> None:
    """Refuse a graph that has grown too large.

    Raises:
        IntractableTaskError: there are more than ``MAX_STATES`` or ``MAX_EDGES``.
    """
    if states > MAX_STATES or edges > MAX_EDGES:
        raise IntractableTaskError(
            f"the formula's automaton needs more than {MAX_STATES} states or {MAX_EDGES} edges;"
            " split the task or leave out alternatives"
        )
