"""Never claims that spin makes of LTL formulas.

- ``spin_state_count``   the number of states of one
- ``to_spin``            a formula in spin's syntax
"""

import re
from subprocess import PIPE, TimeoutExpired, run
from typing import Final

from tlcomm_core.ltl import Formula, Operator, subformulas

__all__ = ["spin_state_count", "to_spin"]

_SIGNS: Final = {
    Operator.NOT: "!",
    Operator.EVENTUALLY: "<> ",
    Operator.ALWAYS: "[] ",
    Operator.AND: "&&",
    Operator.OR: "||",
    Operator.IMPLIES: "->",
    Operator.IFF: "<->",
    Operator.UNTIL: "U",
    Operator.RELEASE: "V",
}


def to_spin(formula: Formula) -> str:
    """Return text that spin reads; W and M, which it lacks, become V and U."""
    texts: dict[Formula, str] = {}
    for node in subformulas(formula):
        parts = [texts[child] for child in node.children]
        match node.operator:
            case Operator.ATOM:
                texts[node] = node.name
            case Operator.TRUE | Operator.FALSE:
                texts[node] = node.operator.value
            case Operator.WEAK_UNTIL:
                texts[node] = f"({parts[1]} V ({parts[0]} || {parts[1]}))"
            case Operator.STRONG_RELEASE:
                texts[node] = f"({parts[1]} U ({parts[0]} && {parts[1]}))"
            case operator if len(parts) == 1:
                texts[node] = f"({_SIGNS[operator]}{parts[0]})"
            case operator:
                texts[node] = f"({parts[0]} {_SIGNS[operator]} {parts[1]})"
    return texts[formula]


def spin_state_count(formula: Formula, limit_s: float = 10.0) -> int | None:
    """Return the number of states of spin's never claim.

    None if the formula has X, which spin is usually built without, or if it takes too long.
    """
    if any(node.operator is Operator.NEXT for node in subformulas(formula)):
        return None
    try:
        done = run(
            ["spin", "-f", to_spin(formula)], stdout=PIPE, check=True, text=True, timeout=limit_s
        )
    except TimeoutExpired:
        return None
    return len(re.findall(r"^\w+:", done.stdout, re.MULTILINE))
