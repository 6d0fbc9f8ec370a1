"""Verdicts of a monitor on words of which one knows them."""

import pytest

from support.lasso_semantics import holds
from tlcomm_core.ltl import Monitor, Verdict, parse

SHORT = {
    "T": Verdict.TRUE,
    "t": Verdict.PRESUMABLY_TRUE,
    "f": Verdict.PRESUMABLY_FALSE,
    "F": Verdict.FALSE,
}


@pytest.mark.parametrize(
    ("text", "word", "verdicts"),
    [
        ("F a", "-b-a-", "fffTT"),
        ("G !a", "-b-a-", "tttFF"),
        ("G (a -> F b)", "-aab-", "tfftt"),
        ("G F a", "-a-a", "ftft"),
        ("F G a", "-aa-", "fttf"),
        ("a U b", "aab", "ffT"),
        ("a U b", "a-b", "fFF"),
        ("a W b", "aa-", "ttF"),
        ("X X a", "--a", "ffT"),
        ("G a | F b", "a-b", "tfT"),
        ("true", "-", "T"),
        ("G F a & F G !a", "a", "F"),
    ],
)
def test_verdicts(text: str, word: str, verdicts: str) -> None:
    """Final where every or no continuation satisfies, else presumed as if the word ended."""
    monitor = Monitor(parse(text))
    found = [monitor.read(set(letter) - {"-"}) for letter in word]
    assert found == [SHORT[verdict] for verdict in verdicts]
    assert monitor.letters_read == len(word)


@pytest.mark.parametrize(
    ("text", "word", "expected"),
    [("F a", "-a-", 2), ("G a", "aa", None), ("false", "", 0), ("a U b", "-b", 1)],
)
def test_the_letter_that_settles_it_is_known(text: str, word: str, expected: int | None) -> None:
    """The shortest good or bad prefix is the word up to there."""
    monitor = Monitor(parse(text))
    for letter in word:
        monitor.read(set(letter) - {"-"})
    assert monitor.final_after == expected
    assert monitor.verdict.is_final == (expected is not None)


def test_satisfactions_are_counted_from_the_last_one_on() -> None:
    """For G F (a & F b), a then b counts once, however often a came before."""
    monitor = Monitor(parse("G F (a & F b)"))
    counts = []
    for letter in "baabbab":
        monitor.read(letter)
        counts.append(monitor.satisfactions)
    assert counts == [0, 0, 0, 1, 1, 1, 2]


def test_other_formulas_have_no_count() -> None:
    """Only G F of a co-safe formula is satisfied again and again."""
    assert Monitor(parse("F a")).satisfactions is None
    assert Monitor(parse("G F (a & G b)")).satisfactions is None


def test_continuations_prove_what_is_open() -> None:
    """Not yet: one way to satisfy and one to violate; once settled, only one of them."""
    formula = parse("G (a -> F b)")
    monitor = Monitor(formula)
    monitor.read("a")
    good, bad = monitor.satisfying(), monitor.violating()
    assert good is not None
    assert bad is not None
    assert holds(formula, [frozenset("a"), *good.stem], good.loop)
    assert not holds(formula, [frozenset("a"), *bad.stem], bad.loop)
    settled = Monitor(parse("G a"))
    settled.read("b")
    assert settled.satisfying() is None
    assert settled.violating() is not None
