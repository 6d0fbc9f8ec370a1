"""What a formula demands of every letter."""

import itertools

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tlcomm_core.ltl import Monitor, Verdict, forbidden, invariants, parse


@pytest.mark.parametrize(
    ("text", "parts"),
    [
        ("G !d & G F a", ["!d"]),
        ("G (!d & !e)", ["!d", "!e"]),
        ("!F d", ["!d"]),
        ("G (!d & (a -> F b) & G (a | b))", ["!d", "a | b"]),
        ("G (d -> X a)", []),
        ("F G !d", []),
        ("G !d | G a", []),
        ("!d", []),
    ],
)
def test_the_invariants_of_a_formula(text: str, parts: list[str]) -> None:
    """Conjuncts under G that are free of operators of time, however they are written."""
    assert sorted(map(str, invariants(parse(text)))) == sorted(parts)


def test_an_atom_is_forbidden_whatever_else_may_be_true() -> None:
    """What only some company forbids isn't."""
    beside = {"d": {"act"}, "e": {"act"}}
    assert forbidden(parse("G !d & G F e"), beside) == {"d"}
    assert forbidden(parse("G (d -> act)"), beside) == set()
    assert forbidden(parse("G (d -> e)"), beside) == {"d"}
    assert forbidden(parse("G (d -> e)"), {"d": {"e"}}) == set()
    assert forbidden(parse("G (a | e)"), beside) == {"d"}
    assert forbidden(parse("true"), beside) == set()


TIMELESS = st.recursive(
    st.sampled_from(["a", "b", "c", "true"]),
    lambda inner: st.one_of(
        inner.map("!({})".format),
        st.tuples(inner, st.sampled_from(["&", "|", "->", "<->"]), inner).map(
            lambda row: f"({row[0]}) {row[1]} ({row[2]})"
        ),
    ),
    max_leaves=6,
)


@given(TIMELESS)
def test_what_is_forbidden_violates_at_once(text: str) -> None:
    """Each letter with a forbidden atom, whatever is beside it, is a violation by the monitor."""
    formula = parse(f"G ({text})")
    for name in forbidden(formula, {"a": {"b"}, "c": {"a", "b"}}):
        others = {"b"} if name == "a" else {"a", "b"}
        for size in range(len(others) + 1):
            for company in itertools.combinations(sorted(others), size):
                monitor = Monitor(formula)
                assert monitor.read(frozenset({name, *company})) is Verdict.FALSE
