"""Limits of size: what is too large is refused in words."""

import pytest

from tlcomm_core.errors import IntractableTaskError
from tlcomm_core.ltl import parse, translate
from tlcomm_core.ltl.graph import MAX_EDGES, MAX_STATES, check_size


def test_the_limit_itself_is_allowed() -> None:
    """One state or edge more than the limits is refused, the limits themselves aren't."""
    check_size(MAX_STATES, MAX_EDGES)
    for states, edges in ((MAX_STATES + 1, 0), (0, MAX_EDGES + 1)):
        with pytest.raises(IntractableTaskError, match="automaton needs more than"):
            check_size(states, edges)


@pytest.mark.parametrize(
    "text",
    [
        " & ".join(f"(G F a{i} -> G F b{i})" for i in range(20)),
        " <-> ".join(f"F a{i}" for i in range(20)),
        " <-> ".join(f"(a{i} U b{i})" for i in range(20)),
        " & ".join(f"F a{i}" for i in range(20)),
        "G F (" + " & ".join(f"F (a{i} & X F b{i})" for i in range(20)) + ")",
        "G (a -> " + "X " * 15 + "b)",
    ],
    ids=["fairness", "nested iff", "iff of until", "visits", "co-safe", "counter"],
)
def test_exponential_formulas_are_refused(text: str) -> None:
    """Formulas whose automata are exponential end in an error that states the limit."""
    with pytest.raises(IntractableTaskError, match=r"more than \d+ (states|steps)"):
        translate(parse(text))
