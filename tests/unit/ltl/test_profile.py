"""What a formula is."""

import pytest

from tlcomm_core.ltl import LassoWord, TemporalClass, Verdict, parse, profile


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("F (a & F b)", TemporalClass.CO_SAFETY),
        ("a U b", TemporalClass.CO_SAFETY),
        ("G !d", TemporalClass.SAFETY),
        ("!F d", TemporalClass.SAFETY),
        ("a & X b", TemporalClass.BOUNDED),
        ("G F (a & F b)", TemporalClass.RECURRENCE),
        ("F G a", TemporalClass.OTHER),
        ("G !d & F a", TemporalClass.OTHER),
    ],
)
def test_the_class_is_read_off_the_syntax(text: str, expected: TemporalClass) -> None:
    """Negations are taken into account."""
    assert profile(parse(text)).temporal_class is expected


def test_a_contradiction_names_its_parts() -> None:
    """And nothing satisfies it or leaves it open."""
    found = profile(parse("G F p & F q & G !p"))
    assert [str(part) for part in found.conflict] == ["G F p", "G !p"]
    assert (found.satisfying, found.undecided) == (None, None)
    assert found.violating is not None


def test_a_recurring_contradiction_leaves_nothing_open() -> None:
    """Its automaton can go on for ever, but never accepts."""
    assert profile(parse("G F (a & X b & X !b)")).undecided is None


def test_a_valid_formula_is_violated_by_no_word() -> None:
    """Nor has it a conflict."""
    found = profile(parse("F a | G !a"))
    assert (found.violating, found.undecided, found.conflict) == (None, None, ())
    assert found.satisfying is not None


def test_an_open_word_comes_with_what_is_presumed() -> None:
    """A promise that isn't kept yet, and a rule that isn't broken yet."""
    promise, rule = (profile(parse(text)).undecided for text in ("a & F b", "G !d"))
    assert promise is not None
    assert rule is not None
    assert (promise.letters, promise.verdict) == ((frozenset("a"),), Verdict.PRESUMABLY_FALSE)
    assert (rule.letters, rule.verdict) == ((frozenset(),), Verdict.PRESUMABLY_TRUE)


def test_with_many_atoms_the_automaton_gives_the_words() -> None:
    """Twenty letters, one atom each, since all subsets can't be tried; each atom returns."""
    text = " & ".join(f"G F a{index}" for index in range(20))
    found = profile(parse(text))
    assert found.satisfying is not None
    assert sorted(found.satisfying.loop, key=sorted) == sorted(
        (frozenset({f"a{index}"}) for index in range(20)), key=sorted
    )
    assert (found.satisfying.stem, found.violating) == ((), LassoWord((), (frozenset(),)))
