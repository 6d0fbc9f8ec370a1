"""Words that an automaton accepts."""

import pytest

from support.lasso_semantics import holds
from tlcomm_core.ltl import LassoWord, accepted_word, parse, read_hoa, tableau_automaton, word_text
from tlcomm_core.ltl.word import live_states


@pytest.mark.parametrize(
    "text", ["G F a & G F b", "a & X (b & X c)", "F G !a & F a", "a U (b U c)", "true", "!a & G b"]
)
def test_the_word_satisfies_the_formula(text: str) -> None:
    """By LTL's direct semantics."""
    word = accepted_word(tableau_automaton(parse(text)))
    assert word is not None
    assert holds(parse(text), word.stem, word.loop)


def test_an_empty_automaton_accepts_no_word() -> None:
    """Nor has it a state from which one is accepted."""
    automaton = tableau_automaton(parse("G a & F !a"))
    assert accepted_word(automaton) is None
    assert live_states(automaton) == frozenset()


def test_the_shortest_word_comes_with_few_atoms() -> None:
    """Two letters of which the second repeats; what may be false is."""
    word = accepted_word(tableau_automaton(parse("a & X G b & (c | true)")))
    assert word == LassoWord((frozenset("a"),), (frozenset("b"),))


def test_words_are_readable() -> None:
    """Letters by semicolons, the loop marked."""
    assert word_text([frozenset("ba"), frozenset()]) == "a & b ; –"
    assert str(LassoWord((), (frozenset("a"),))) == "(a) for ever"
    assert str(LassoWord((frozenset(),), (frozenset("a"),))) == "– ; (a) for ever"


def test_an_accepting_edge_on_no_cycle_is_passed_by() -> None:
    """Only what can be taken again and again makes a loop."""
    text = 'HOA: v1 Start: 0 AP: 1 "a" Acceptance: 1 Inf(0) --BODY-- '
    rows = "State: 0 [t] 1 {0} State: 1 [t] 1 [0] 2 State: 2 [!0] 2 {0} --END--"
    word = accepted_word(read_hoa(text + rows))
    assert word == LassoWord((frozenset(), frozenset("a")), (frozenset(),))


@pytest.mark.parametrize(
    ("stem", "loop", "shortened"),
    [
        ("", "abab", ("", "ab")),
        ("ab", "ab", ("", "ab")),
        ("cab", "dab", ("c", "abd")),
        ("b", "ab", ("", "ba")),
        ("a", "aba", ("", "aab")),
        ("aa", "a", ("", "a")),
    ],
)
def test_a_word_is_told_with_the_fewest_letters(
    stem: str, loop: str, shortened: tuple[str, str]
) -> None:
    """The loop goes round once and begins as early as it can."""

    def letters(text: str) -> tuple[frozenset[str], ...]:
        return tuple(map(frozenset, text))

    word = LassoWord(letters(stem), letters(loop)).shortened()
    assert (word.stem, word.loop) == tuple(map(letters, shortened))
