"""The literature's formulas, and deep random ones, against the direct semantics."""

from random import Random

import pytest

from support.lasso_acceptance import accepts
from support.lasso_semantics import holds
from support.ltl_benchmarks import (
    DWYER,
    ETESSAMI_HOLZMANN,
    SOMENZI_BLOEM,
    random_formula,
    without_next,
)
from support.ltl_size_table import compared
from support.published_sizes import published_sizes
from tlcomm_core.ltl import atoms, parse, tableau_automaton

LITERATURE = (*DWYER, *ETESSAMI_HOLZMANN, *SOMENZI_BLOEM)
# Per formula of ours that Spot's authors write otherwise, their reading of the same source.
AS_PUBLISHED = {
    "G !q | (!q U (q & (F p -> (!p U (s & !p & X (!p U t))))))": (
        "G !q | (!q U (q & F p -> (!p U (s & !p & X (!p U t)))))"
    ),
    "!(F F p <-> F p)": "!(F F p <-> F q)",
    "!(G F p | F G q)": "!(F G p | F G q)",
    "(G (q | X G p) & G (r | X G !p)) | G q | G r": "G (q | X G p) & G (r | X G !p)",
}
Word = tuple[frozenset[str], ...]


def random_word(rng: Random, names: tuple[str, ...]) -> Word:
    """Return up to five letters."""
    return tuple(
        frozenset(name for name in names if rng.random() < 0.5) for _ in range(rng.randint(1, 5))
    )


def assert_means(text: str, rng: Random, words: int) -> None:
    """Compare the automata of a formula and of its negation with the semantics."""
    formula = parse(text)
    automaton, opposite = tableau_automaton(formula), tableau_automaton(parse(f"!({text})"))
    names = atoms(formula)
    for _ in range(words):
        stem, loop = random_word(rng, names), random_word(rng, names)
        expected = holds(formula, stem, loop)
        assert accepts(automaton, stem, loop) is expected, (text, stem, loop)
        assert accepts(opposite, stem, loop) is not expected, (text, stem, loop)


@pytest.mark.parametrize("text", LITERATURE)
def test_the_literatures_formulas_mean_what_they_say(text: str) -> None:
    """On 20 words each, automaton and negation's automaton agree with the semantics."""
    assert_means(text, Random(text), 20)  # noqa: S311  nothing secret


@pytest.mark.parametrize("seed", range(4))
def test_deep_random_formulas_mean_what_they_say(seed: int) -> None:
    """On 8 words each, 20 formulas up to depth 5 over 4 atoms agree with the semantics."""
    rng = Random(seed)  # noqa: S311  nothing secret
    for _ in range(20):
        assert_means(random_formula(rng, 5), rng, 8)


@pytest.mark.parametrize("seed", range(2))
def test_recurrences_beside_other_formulas_mean_what_they_say(seed: int) -> None:
    """Formulas with six conjuncts G F β, which bypass the tableau, agree with the semantics."""
    rng = Random(100 + seed)  # noqa: S311  nothing secret
    targets = ("a", "!a", "b | c", "b & !c", "!b", "c", "d", "!d | a")
    for _ in range(10):
        terms = " & ".join(f"G F ({target})" for target in rng.sample(targets, 6))
        assert_means(f"({random_formula(rng, 3)}) & {terms}", rng, 20)


def test_the_sets_are_complete() -> None:
    """There are 55, 12 and 27 formulas, and the random ones are as many as asked for."""
    assert [len(DWYER), len(ETESSAMI_HOLZMANN), len(SOMENZI_BLOEM)] == [55, 12, 27]
    assert len(set(LITERATURE)) == len(LITERATURE)
    assert len(set(without_next(200))) == 200


def test_sizes_are_published_for_the_formulas_of_the_sets() -> None:
    """The table has a row for each, in the sets' order; four are read otherwise there."""
    assert [row.formula for row in published_sizes()] == [
        AS_PUBLISHED.get(text, text) for text in LITERATURE
    ]


def test_automata_are_not_much_larger_than_those_published() -> None:
    """In each set at most 1.35 times Spot's states; in all no more of either than LTL3BA's."""
    rows = compared()
    for name in {row.published.set_name for row in rows}:
        members = [row for row in rows if row.published.set_name == name]
        spots = sum(row.published.spot.states for row in members)
        assert sum(row.ours.states for row in members) <= 1.35 * spots, name
    assert sum(row.ours.states for row in rows) <= sum(row.published.ltl3ba.states for row in rows)
    assert sum(row.ours.edges for row in rows) <= sum(row.published.ltl3ba.edges for row in rows)
