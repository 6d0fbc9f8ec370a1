"""Automata in the Hanoi Omega-Automata format, version 1.

- ``to_hoa``        the text of an automaton
- ``label_text``    a guard as a label expression
"""

from tlcomm_core.ltl.automaton import BuchiAutomaton
from tlcomm_core.ltl.formula import Formula
from tlcomm_core.ltl.guard import Cube, Guard

__all__ = ["label_text", "to_hoa"]


def to_hoa(automaton: BuchiAutomaton, formula: Formula, name: str | None = None) -> str:
    """Return the automaton in HOA v1, with Büchi acceptance on transitions.

    Args:
        automaton: what to write.
        formula: what it was made from.
        name: the automaton's name; by default the formula's text.

    Source: Babiak et al., "The Hanoi Omega-Automata format", 2015.
    """
    title = str(formula) if name is None else name
    properties = ["trans-labels", "explicit-labels", "trans-acc"]
    if automaton.is_complete():
        properties.append("complete")
    if automaton.is_deterministic():
        properties.append("deterministic")
    lines = [
        "HOA: v1",
        f"name: {_quoted(title)}",
        f"States: {automaton.state_count}",
        f"Start: {automaton.initial}",
        " ".join([f"AP: {len(automaton.atoms)}", *map(_quoted, automaton.atoms)]),
        "acc-name: Buchi",
        "Acceptance: 1 Inf(0)",
        f"properties: {' '.join(properties)}",
        'tool: "tlcomm"',
        f"construction: {_quoted(automaton.kind.value)}",
        "--BODY--",
        *_body(automaton),
        "--END--",
    ]
    return "\n".join(lines) + "\n"


def label_text(guard: Guard, atoms: tuple[str, ...]) -> str:
    """Return a guard as a label expression over the atoms' numbers."""
    number = {name: index for index, name in enumerate(atoms)}
    return " | ".join(_cube_text(cube, number) for cube in guard.cubes) or "f"


def _cube_text(cube: Cube, number: dict[str, int]) -> str:
    literals = sorted((number[name], positive) for name, positive in cube.literals())
    return "&".join(f"{'' if positive else '!'}{index}" for index, positive in literals) or "t"


def _body(automaton: BuchiAutomaton) -> list[str]:
    lines = []
    for state, edges in enumerate(automaton.transitions):
        lines.append(f"State: {state}")
        for edge in edges:
            mark = " {0}" if edge.accepting else ""
            lines.append(f"[{label_text(edge.guard, automaton.atoms)}] {edge.target}{mark}")
    return lines


def _quoted(text: str) -> str:
    escaped = text.replace("\\", "\\\\").replace('"', '\\"')
    return f'"{escaped}"'
