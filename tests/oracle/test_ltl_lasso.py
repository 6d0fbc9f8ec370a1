"""Automata against the direct semantics of LTL on ultimately periodic words.

The semantics here is computed by fixpoints over the positions of a word u v v v …, from the
definitions alone; nothing of the translation is used.
"""

import random
from collections.abc import Callable
from dataclasses import dataclass

import pytest

from tlcomm_core.ltl import (
    BuchiAutomaton,
    Formula,
    Operator,
    atom,
    is_co_safe,
    restarted,
    tableau_automaton,
    translate,
)

ATOMS = ("a", "b", "c")
INNER = [operator for operator in Operator if operator.arity]
CO_SAFE = [
    Operator.NEXT,
    Operator.EVENTUALLY,
    Operator.AND,
    Operator.OR,
    Operator.UNTIL,
    Operator.STRONG_RELEASE,
]

Truth = list[bool]


@dataclass(frozen=True)
class Lasso:
    """The word whose letters run through and then repeat from ``loop`` on."""

    letters: tuple[frozenset[str], ...]
    loop: int

    def after(self, position: int) -> int:
        """Return the next position."""
        return position + 1 if position + 1 < len(self.letters) else self.loop


def satisfied_at(formula: Formula, word: Lasso) -> Truth:
    """Return at which positions the rest of the word satisfies the formula."""
    if formula.operator is Operator.ATOM:
        return [formula.name in letter for letter in word.letters]
    return OPERATORS[formula.operator](word, *(satisfied_at(c, word) for c in formula.children))


def fixpoint(word: Lasso, now: Truth, stay: Truth, *, start: bool) -> Truth:
    """Solve z = now or (stay and X z), from below (start false) or from above (start true)."""
    z = [start] * len(word.letters)
    while True:
        fresh = [now[i] or (stay[i] and z[word.after(i)]) for i in range(len(z))]
        if fresh == z:
            return z
        z = fresh


def both(left: Truth, right: Truth) -> Truth:
    """Return the positions where both hold."""
    return [x and y for x, y in zip(left, right, strict=True)]


def constant(*, value: bool) -> Callable[[Lasso], Truth]:
    """Return the semantics of a constant."""
    return lambda word: [value] * len(word.letters)


OPERATORS: dict[Operator, Callable[..., Truth]] = {
    Operator.TRUE: constant(value=True),
    Operator.FALSE: constant(value=False),
    Operator.NOT: lambda _, x: [not v for v in x],
    Operator.AND: lambda _, x, y: both(x, y),
    Operator.OR: lambda _, x, y: [p or q for p, q in zip(x, y, strict=True)],
    Operator.IMPLIES: lambda _, x, y: [q or not p for p, q in zip(x, y, strict=True)],
    Operator.IFF: lambda _, x, y: [p == q for p, q in zip(x, y, strict=True)],
    Operator.NEXT: lambda w, x: [x[w.after(i)] for i in range(len(x))],
    Operator.EVENTUALLY: lambda w, x: fixpoint(w, x, [True] * len(x), start=False),
    Operator.ALWAYS: lambda w, x: fixpoint(w, [False] * len(x), x, start=True),
    Operator.UNTIL: lambda w, x, y: fixpoint(w, y, x, start=False),
    Operator.WEAK_UNTIL: lambda w, x, y: fixpoint(w, y, x, start=True),
    Operator.RELEASE: lambda w, x, y: fixpoint(w, both(x, y), y, start=True),
    Operator.STRONG_RELEASE: lambda w, x, y: fixpoint(w, both(x, y), y, start=False),
}


def accepts(automaton: BuchiAutomaton, word: Lasso) -> bool:
    """Return whether some run on the word takes accepting edges for ever."""
    edges: dict[tuple[int, int], list[tuple[tuple[int, int], bool]]] = {}
    pending = [(automaton.initial, 0)]
    while pending:
        node = pending.pop()
        if node in edges:
            continue
        state, position = node
        edges[node] = [
            ((target, word.after(position)), accepting)
            for target, accepting in automaton.successors(state, word.letters[position])
        ]
        pending += [target for target, _ in edges[node]]
    return any(
        accepting and reaches(edges, target, node)
        for node, row in edges.items()
        for target, accepting in row
    )


def reaches(
    edges: dict[tuple[int, int], list[tuple[tuple[int, int], bool]]],
    start: tuple[int, int],
    goal: tuple[int, int],
) -> bool:
    """Return whether a path leads from one node to another."""
    seen = {start}
    pending = [start]
    while pending:
        node = pending.pop()
        if node == goal:
            return True
        fresh = {target for target, _ in edges[node]} - seen
        seen |= fresh
        pending += fresh
    return False


def seeded(seed: int | str) -> random.Random:
    """Return a generator that gives the same cases in every run."""
    return random.Random(seed)  # noqa: S311  nothing secret


def random_formula(rng: random.Random, depth: int, operators: list[Operator]) -> Formula:
    """Return a formula at most ``depth`` operators deep."""
    if depth == 0 or rng.random() < 0.1:
        leaf = rng.choice([*ATOMS, *ATOMS, "true", "false"])
        if leaf in ATOMS:
            return atom(leaf)
        return Formula(Operator.TRUE if leaf == "true" else Operator.FALSE)
    operator = rng.choice(operators)
    children = (random_formula(rng, depth - 1, operators) for _ in range(operator.arity))
    return Formula(operator, tuple(children))


def random_word(rng: random.Random) -> Lasso:
    """Return a word of up to 7 different positions."""
    length = rng.randint(1, 7)
    letters = tuple(frozenset(name for name in ATOMS if rng.random() < 0.5) for _ in range(length))
    return Lasso(letters, rng.randrange(length))


@pytest.mark.parametrize("seed", range(10))
def test_automata_accept_exactly_the_words_that_satisfy(seed: int) -> None:
    """On 80 x 8 random pairs a formula's automaton accepts a word exactly if it satisfies it,
    and so does the negation's: every word is in exactly one of the two.
    """
    rng = seeded(seed)
    for _ in range(80):
        formula = random_formula(rng, 4, INNER)
        automaton = translate(formula)
        opposite = translate(Formula(Operator.NOT, (formula,)))
        for _ in range(8):
            word = random_word(rng)
            expected = satisfied_at(formula, word)[0]
            assert accepts(automaton, word) == expected, (str(formula), word)
            assert accepts(opposite, word) != expected, (str(formula), word)


@pytest.mark.parametrize("operator", INNER, ids=lambda operator: operator.name)
def test_every_operator_inside_every_other(operator: Operator) -> None:
    """Each operator over each pair of operators means what the semantics says."""
    rng = seeded(operator.name)
    leaves = (atom("a"), atom("b"), atom("c"))
    for inner in INNER:
        child = Formula(inner, leaves[: inner.arity])
        for children in ((child, leaves[2]), (leaves[2], child)):
            formula = Formula(operator, children[: operator.arity])
            automaton = tableau_automaton(formula)
            for _ in range(12):
                word = random_word(rng)
                expected = satisfied_at(formula, word)[0]
                assert accepts(automaton, word) == expected, (str(formula), word)


@pytest.mark.parametrize("seed", range(4))
def test_restarted_automata_recognise_always_eventually(seed: int) -> None:
    """As a language, the restarted automaton of a co-safe formula φ is that of G F φ."""
    rng = seeded(1000 + seed)
    for _ in range(40):
        formula = random_formula(rng, 3, CO_SAFE)
        assert is_co_safe(formula)
        automaton = restarted(formula)
        whole = Formula(Operator.ALWAYS, (Formula(Operator.EVENTUALLY, (formula,)),))
        for _ in range(10):
            word = random_word(rng)
            expected = satisfied_at(whole, word)[0]
            assert accepts(automaton, word) == expected, (str(formula), word)


@pytest.mark.parametrize("seed", range(4))
def test_emptiness_means_that_no_word_satisfies(seed: int) -> None:
    """An automaton is empty only if no word tried satisfies the formula, and the automata of a
    formula and of its negation are never both empty.
    """
    rng = seeded(2000 + seed)
    for _ in range(60):
        formula = random_formula(rng, 3, INNER)
        empty = translate(formula).is_empty()
        negated = Formula(Operator.NOT, (formula,))
        assert not (empty and translate(negated).is_empty())
        if empty:
            assert not any(satisfied_at(formula, random_word(rng))[0] for _ in range(50))
