"""Words as proof of what a formula is, against LTL's direct semantics."""

import random
from collections.abc import Iterator
from itertools import product

import pytest

from support.lasso_semantics import holds
from tlcomm_core.ltl import (
    Formula,
    LassoWord,
    Monitor,
    Operator,
    Profile,
    atom,
    conjunction,
    parse,
    profile,
)

LETTERS = [frozenset(), frozenset("a"), frozenset("b"), frozenset("ab")]
INNER = [operator for operator in Operator if operator.arity]
MOST_LETTERS = 2
CHANGE = parse("G F a & G F !a")


def random_formula(rng: random.Random, depth: int) -> Formula:
    """Return a formula at most that many operators deep, over two atoms."""
    if depth == 0 or rng.random() < 0.1:
        return atom(rng.choice("ab"))
    operator = rng.choice(INNER)
    return Formula(operator, tuple(random_formula(rng, depth - 1) for _ in range(operator.arity)))


def random_task(rng: random.Random) -> Formula:
    """Return a conjunction of a few formulas, to which only longer words may be common."""
    parts = [random_formula(rng, rng.randint(1, 3)) for _ in range(rng.randint(1, 3))]
    return conjunction(parts + rng.choice([[], [CHANGE]]))


def words() -> Iterator[LassoWord]:
    """Yield all lasso words of few letters."""
    for count in range(1, MOST_LETTERS + 1):
        for letters in product(LETTERS, repeat=count):
            for begin in range(count):
                yield LassoWord(letters[:begin], letters[begin:])


def effort(word: LassoWord) -> tuple[int, int]:
    """Return what is to be least: letters, then true atoms."""
    letters = (*word.stem, *word.loop)
    return len(letters), sum(map(len, letters))


ALL = sorted(words(), key=effort)


def check_word(formula: Formula, word: LassoWord | None, *, expected: bool) -> None:
    """Check that a word does what it shows, and that no easier one does."""
    if word is not None:
        assert holds(formula, word.stem, word.loop) is expected, str(formula)
    easier = next((w for w in ALL if holds(formula, w.stem, w.loop) is expected), None)
    if easier is not None:
        assert word is not None, str(formula)
        assert effort(word) == effort(easier), str(formula)


def check_open_word(formula: Formula, found: Profile) -> None:
    """Check that nothing is settled after it, and everything after easier letters."""
    easier = len(LETTERS)
    if found.undecided is not None:
        (letter,) = found.undecided.letters
        monitor = Monitor(formula)
        assert monitor.read(letter) is found.undecided.verdict
        good, bad = monitor.satisfying(), monitor.violating()
        assert good is not None
        assert bad is not None
        assert holds(formula, [letter, *good.stem], good.loop)
        assert not holds(formula, [letter, *bad.stem], bad.loop)
        easier = [len(other) < len(letter) for other in LETTERS].count(True)
    for letter in LETTERS[:easier]:
        later = {holds(formula, [letter, *word.stem], word.loop) for word in ALL}
        assert len(later) == 1, str(formula)


@pytest.mark.parametrize("seed", range(8))
def test_every_word_shows_what_it_is_said_to(seed: int) -> None:
    """It satisfies, violates or leaves open the formula, with as few letters and atoms as can."""
    rng = random.Random(seed)  # noqa: S311  nothing secret
    for _ in range(25):
        formula = random_task(rng)
        found = profile(formula)
        check_word(formula, found.satisfying, expected=True)
        check_word(formula, found.violating, expected=False)
        check_open_word(formula, found)
        assert bool(found.conflict) == (found.satisfying is None)


def test_the_random_formulas_cover_the_cases() -> None:
    """Among them are contradictions and valid ones, and some whose words are long."""
    rng = random.Random(0)  # noqa: S311  nothing secret
    found = [profile(random_task(rng)) for _ in range(60)]
    assert sum(one.satisfying is None for one in found) > 2
    assert sum(one.violating is None for one in found) > 0
    assert sum(one.undecided is None for one in found) > 5
    satisfying = [effort(one.satisfying) for one in found if one.satisfying is not None]
    assert sum(letters > 1 for letters, _ in satisfying) > 5
