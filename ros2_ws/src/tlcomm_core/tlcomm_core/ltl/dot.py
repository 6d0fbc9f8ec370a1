"""Automata as Graphviz drawings.

- ``to_dot``   the text of a directed graph
"""

from tlcomm_core.ltl.automaton import BuchiAutomaton
from tlcomm_core.ltl.guard import Cube, Guard

__all__ = ["to_dot"]


def to_dot(automaton: BuchiAutomaton, name: str) -> str:
    """Return a drawing of the automaton in the DOT language; accepting edges are bold."""
    lines = [
        f"digraph {_quoted(name)} {{",
        "  rankdir=LR",
        "  node [shape=circle]",
        '  start [shape=point, label=""]',
        f"  start -> {automaton.initial}",
        *(f"  {state}" for state in range(automaton.state_count)),
    ]
    for state, edges in enumerate(automaton.transitions):
        for edge in edges:
            style = ", style=bold, color=firebrick" if edge.accepting else ""
            lines.append(f"  {state} -> {edge.target} [label={_guard(edge.guard)}{style}]")
    return "\n".join([*lines, "}"]) + "\n"


def _guard(guard: Guard) -> str:
    return _quoted(" | ".join(_cube(cube) for cube in guard.cubes) or "false")


def _cube(cube: Cube) -> str:
    literals = (name if positive else f"!{name}" for name, positive in cube.literals())
    return " & ".join(literals) or "true"


def _quoted(text: str) -> str:
    escaped = text.replace("\\", "\\\\").replace('"', '\\"')
    return f'"{escaped}"'
