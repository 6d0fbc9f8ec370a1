"""Repeated tasks beside other parts, against a product made by hand.

By hand, each task's restarted automaton reads the word for itself, what is forbidden is looked up
in the letter, and a set remembers which tasks were completed since all of them last were. Words are
those of random walks, so that the order in which tasks can be done differs from case to case.
"""

from collections import deque
from collections.abc import Callable, Hashable, Iterable
from random import Random

import pytest

from support.lasso_acceptance import accepts
from support.lasso_semantics import holds
from support.ltl_benchmarks import random_formula
from tlcomm_core.ltl import BuchiAutomaton, Construction, atoms, parse, restarted, translate
from tlcomm_core.ltl.assembly import assembled
from tlcomm_core.ltl.tableau import tableau_parts

Letter = frozenset[str]
Move = tuple[Hashable, bool]
Walks = list[tuple[Letter, list[int]]]

ATOMS = ("a", "b", "c", "d")
TASKS = [
    (("a & F b",), "c"),
    (("a & F b", "c & F d"), ""),
    (("a & F b", "c"), "d"),
    (("a", "b"), ""),
    (("a", "b", "c"), ""),
    (("a & X b", "b & F c", "a | c"), "d"),
    (("a", "b", "c", "d"), ""),
]


def by_hand(tasks: tuple[str, ...], never: str) -> tuple[Hashable, Callable[..., list[Move]]]:
    """Return the initial state and the moves of the tasks' automata side by side."""
    automata = [restarted(parse(task)) for task in tasks]

    def moves(states: tuple[int, ...], seen: frozenset[int], letter: Letter) -> list[Move]:
        if never in letter:
            return []
        pairs = [a.successors(s, letter)[0] for a, s in zip(automata, states, strict=True)]
        seen |= {task for task, (_, complete) in enumerate(pairs) if complete}
        all_done = len(seen) == len(tasks)
        after = frozenset[int]() if all_done else seen
        return [((tuple(state for state, _ in pairs), after), all_done)]

    start = (tuple(automaton.initial for automaton in automata), frozenset[int]())
    return start, lambda node, letter: moves(*node, letter)


def translated(automaton: BuchiAutomaton) -> tuple[Hashable, Callable[..., Iterable[Move]]]:
    """Return the initial state and the moves of an automaton."""
    return automaton.initial, automaton.successors


def random_walks(rng: Random) -> Walks:
    """Return up to six places with their letters and where one can go from each."""
    places = range(rng.randint(3, 6))
    return [
        (
            frozenset(name for name in ATOMS if rng.random() < 0.3),
            rng.sample(places, rng.randint(1, 2)),
        )
        for _ in places
    ]


def shortest_round(
    walks: Walks, start: Hashable, moves: Callable[..., Iterable[Move]]
) -> int | None:
    """Return the length of the shortest cycle with an accepting edge; None if there is none."""
    rows: dict[Hashable, list[Move]] = {}
    pending: list[tuple[int, Hashable]] = [(0, start)]
    while pending:
        node = pending.pop()
        if node not in rows:
            place, state = node
            rows[node] = [
                ((after, target), accepting)
                for after in walks[place][1]
                for target, accepting in moves(state, walks[after][0])
            ]
            pending += [target for target, _ in rows[node]]
    rounds = [
        1 + steps
        for node, row in rows.items()
        for target, accepting in row
        if accepting and (steps := distance(rows, target, node)) is not None
    ]
    return min(rounds, default=None)


def distance(rows: dict[Hashable, list[Move]], start: Hashable, goal: Hashable) -> int | None:
    """Return the number of edges of a shortest path; None if there is none."""
    steps = {start: 0}
    queue = deque([start])
    while queue:
        node = queue.popleft()
        if node == goal:
            return steps[node]
        for target, _ in rows[node]:
            if target not in steps:
                steps[target] = steps[node] + 1
                queue.append(target)
    return None


@pytest.mark.parametrize(("tasks", "never"), TASKS)
def test_a_round_completes_every_task(tasks: tuple[str, ...], never: str) -> None:
    """On 60 random graphs, the shortest accepting cycle is as long as that of the product by hand,
    and both exist on the same graphs.
    """
    rng = Random(" ".join(tasks))  # noqa: S311  nothing secret
    text = " & ".join(f"G F ({task})" for task in tasks) + (f" & G !{never}" if never else "")
    automaton = translate(parse(text))
    lengths = set()
    for _ in range(60):
        walks = random_walks(rng)
        expected = shortest_round(walks, *by_hand(tasks, never))
        assert shortest_round(walks, *translated(automaton)) == expected, walks
        lengths.add(expected)
    assert len(lengths) > 2


def test_what_is_done_once_leaves_the_rounds_alone() -> None:
    """F d beside a repeated task lengthens no round: a, then b, after d came."""
    automaton = translate(parse("G F (a & F b) & F d"))
    letter = {name: frozenset({name}) for name in ATOMS}
    walks: Walks = [(letter["d"], [1]), (letter["a"], [2]), (letter["b"], [1])]
    without: Walks = [(letter["c"], [1]), *walks[1:]]
    turned: Walks = [
        (letter["c"], [0, 1]),
        (letter["d"], [2]),
        *[(letter["a"], [3]), (letter["b"], [2])],
    ]
    assert shortest_round(turned, *translated(automaton)) == 2
    assert shortest_round(without, *translated(automaton)) is None


@pytest.mark.parametrize("seed", range(3))
def test_for_few_letters_the_words_of_these_letters_are_told_apart(seed: int) -> None:
    """On 10 words of three letters each, 30 conjunctions made for those letters alone agree with
    the semantics.
    """
    rng = Random(seed)  # noqa: S311  nothing secret
    for _ in range(30):
        texts = [f"G (({random_formula(rng, 1)}) -> F ({random_formula(rng, 1)}))" for _ in "123"]
        formula = parse(" & ".join([*texts, random_formula(rng, 2)]))
        names = atoms(formula)
        letters = [frozenset(name for name in names if rng.random() < 0.5) for _ in range(3)]
        parts = tableau_parts(formula, names)
        automaton = assembled(parts, Construction.FOR_LETTERS, letters=letters)
        for _ in range(10):
            stem, loop = (tuple(rng.choices(letters, k=rng.randint(1, 4))) for _ in range(2))
            expected = holds(formula, stem, loop)
            assert accepts(automaton, stem, loop) is expected, (str(formula), stem, loop)
