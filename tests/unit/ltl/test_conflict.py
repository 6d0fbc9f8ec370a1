"""Conjuncts, and the ones that exclude each other."""

import pytest

from tlcomm_core.errors import LocalMisuseError
from tlcomm_core.ltl import (
    conflict,
    conjuncts,
    contradiction,
    known_conflict,
    parse,
    smallest_conflict,
)


@pytest.mark.parametrize(
    ("text", "parts"),
    [
        ("a & F b & G c", ["a", "F b", "G c"]),
        ("G (a & (b & c))", ["G a", "G b", "G c"]),
        ("G (a -> b & X (c & d))", ["G (a -> b)", "G (a -> X c)", "G (a -> X d)"]),
        ("!(a | F b)", ["!a", "!F b"]),
        ("!F (a | b)", ["G !a", "G !b"]),
        ("!!(a & b)", ["a", "b"]),
        ("!(a -> b)", ["a", "!b"]),
        ("!X (a | b)", ["X !a", "X !b"]),
        ("F (a & b)", ["F (a & b)"]),
        ("!(a & b)", ["!(a & b)"]),
        ("a & a", ["a"]),
        ("true", ["true"]),
    ],
)
def test_conjunctions_are_taken_apart(text: str, parts: list[str]) -> None:
    """Where that keeps the meaning; the rest stays as it is written."""
    assert [str(part) for part in conjuncts(parse(text))] == parts


@pytest.mark.parametrize(
    ("text", "parts"),
    [
        ("G F a & F b & G !b & G c", ["F b", "G !b"]),
        ("G (c & !b) & F (a & b)", ["G !b", "F (a & b)"]),
        ("false & G F a", ["false"]),
        ("F (a & !a) & b", ["F (a & !a)"]),
        ("G (a -> X b) & F a & G (b -> d) & G !d", ["G (a -> X b)", "F a", "G (b -> d)", "G !d"]),
        ("(a | b) & (a | !b) & (!a | b) & !a & c", ["a | b", "a | !b", "!a"]),
    ],
)
def test_the_parts_that_exclude_each_other(text: str, parts: list[str]) -> None:
    """No more of them than it takes, in the order of the text."""
    assert [str(part) for part in conflict(parse(text))] == parts


def test_the_fewest_parts_are_found() -> None:
    """Deletion from the end would keep three; two are enough."""
    text = "F p & G (p -> q) & G !q & F r & G !r"
    linked = f"{text} & G (q -> !s | r)"
    assert len(conflict(parse(linked))) == 2


def test_fairness_of_others_costs_nothing() -> None:
    """Twenty recurring parts about other atoms are never translated together."""
    text = " & ".join([*(f"G F a{index}" for index in range(20)), "F b", "G !b"])
    assert [str(part) for part in conflict(parse(text))] == ["F b", "G !b"]


def test_a_satisfiable_formula_has_no_conflict() -> None:
    """Asking for it is a bug."""
    with pytest.raises(LocalMisuseError, match="is satisfiable"):
        conflict(parse("F a & G b"))


def test_many_parts_are_left_to_deletion() -> None:
    """Of forty numbers that may not all be there, forty are kept after few questions."""
    parts = [parse(f"a{index}") for index in range(40)]
    questions = []
    found = smallest_conflict(parts, lambda chosen: questions.append(1) or len(chosen) < 40)
    assert found == tuple(parts)
    assert len(questions) == 40


def test_a_conflict_beyond_the_limits_is_the_formula_itself() -> None:
    """Parts whose automaton is too large aren't told apart."""
    names = [f"a{index}" for index in range(12)]
    many = f"{' & '.join(f'F {name}' for name in names)} & G (z -> {' | '.join(names)})"
    formula = parse(f"{many} & (b & !b)")
    assert known_conflict(formula) == (formula,)


@pytest.mark.parametrize(
    ("texts", "sentence"),
    [
        (["a & !a"], "'a & !a' contradicts itself: no word satisfies it"),
        (
            ["F a", "G !a"],
            "'F a' and 'G !a' contradict each other: no word satisfies them all",
        ),
        (
            ["a", "b", "!(a & b)"],
            "'a', 'b' and '!(a & b)' contradict each other: no word satisfies them all",
        ),
    ],
)
def test_a_contradiction_is_one_sentence(texts: list[str], sentence: str) -> None:
    """It quotes each part."""
    assert contradiction([parse(text) for text in texts]) == sentence
