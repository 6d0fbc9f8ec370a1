"""Endless words that show what a formula allows.

- ``LassoWord``      a stem, and a loop for ever after
- ``accepted_word``  a word that an automaton accepts
- ``live_states``    the states from which an automaton accepts some word
- ``word_text``      letters as text
"""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass

from tlcomm_core.ltl.automaton import BuchiAutomaton, Transition, strong_components
from tlcomm_core.ltl.guard import Guard

__all__ = ["LassoWord", "Letter", "accepted_word", "live_states", "word_text"]

Letter = frozenset[str]

_Edge = tuple[int, Transition]


@dataclass(frozen=True, slots=True)
class LassoWord:
    """The word that reads ``stem`` once and ``loop`` for ever.

    Attributes:
        stem: letters, each the set of atoms that are true.
        loop: the same, at least one.
    """

    stem: tuple[Letter, ...]
    loop: tuple[Letter, ...]

    def __str__(self) -> str:
        """Return the letters as text, the loop in parentheses."""
        parts = [word_text(self.stem)] if self.stem else []
        return " ; ".join([*parts, f"({word_text(self.loop)}) for ever"])

    def shortened(self) -> "LassoWord":
        """Return the same word, told with the fewest letters.

        The loop goes round once, and begins as early as it can.
        """
        stem, loop = self.stem, self.loop
        lengths = range(1, len(loop) + 1)
        once = next(n for n in lengths if loop == loop[:n] * (len(loop) // n))
        loop = loop[:once]
        while stem and stem[-1] == loop[-1]:
            stem, loop = stem[:-1], (loop[-1], *loop[:-1])
        return LassoWord(stem, loop)


def word_text(letters: Iterable[Letter]) -> str:
    """Return letters as text: atoms joined by ``&``, ``–`` where none is true."""
    return " ; ".join(" & ".join(sorted(letter)) or "–" for letter in letters)


def accepted_word(
    automaton: BuchiAutomaton, starts: Iterable[int] | None = None
) -> LassoWord | None:
    """Return a word that the automaton accepts, None if there is none.

    The stem is a shortest way to an accepting edge on a cycle, the loop a shortest way round;
    every letter makes as few atoms true as one of its guard's shortest cubes demands.

    Args:
        automaton: the automaton.
        starts: the states to begin from; by default the initial one.

    Cost: linear in the automaton.
    """
    edges = _passable(automaton)
    component = strong_components([[edge.target for edge in row] for row in edges])

    def closes(source: int, edge: Transition) -> bool:
        return edge.accepting and component[source] == component[edge.target]

    stem = _way(edges, [automaton.initial] if starts is None else starts, closes)
    if stem is None:
        return None
    begin, first = stem[-1]
    back = (
        [] if first.target == begin else _way(edges, [first.target], lambda _, e: e.target == begin)
    )
    assert back is not None
    return LassoWord(_letters(stem[:-1]), _letters([stem[-1], *back]))


def live_states(automaton: BuchiAutomaton) -> frozenset[int]:
    """Return the states from which some word is accepted.

    Cost: linear in the automaton.
    """
    edges = _passable(automaton)
    component = strong_components([[edge.target for edge in row] for row in edges])
    sources: list[list[int]] = [[] for _ in edges]
    live = set()
    for state, row in enumerate(edges):
        for edge in row:
            sources[edge.target].append(state)
            if edge.accepting and component[state] == component[edge.target]:
                live.add(state)
    pending = list(live)
    while pending:
        fresh = [source for source in sources[pending.pop()] if source not in live]
        live.update(fresh)
        pending += fresh
    return frozenset(live)


def _passable(automaton: BuchiAutomaton) -> list[list[Transition]]:
    """Return the edges that some letter allows."""
    return [[edge for edge in row if edge.guard.cubes] for row in automaton.transitions]


def _way(
    edges: Sequence[Sequence[Transition]],
    starts: Iterable[int],
    ends: Callable[[int, Transition], bool],
) -> list[_Edge] | None:
    """Return a shortest path that begins in one of some states and ends with a certain edge."""
    queue = list(starts)
    into: dict[int, _Edge | None] = dict.fromkeys(queue)
    for state in queue:
        for edge in edges[state]:
            if ends(state, edge):
                return [*_path(into, state), (state, edge)]
            if edge.target not in into:
                into[edge.target] = (state, edge)
                queue.append(edge.target)
    return None


def _path(into: dict[int, _Edge | None], state: int) -> list[_Edge]:
    path = []
    while (last := into[state]) is not None:
        path.append(last)
        state = last[0]
    return path[::-1]


def _letters(path: Iterable[_Edge]) -> tuple[Letter, ...]:
    return tuple(_letter(edge.guard) for _, edge in path)


def _letter(guard: Guard) -> Letter:
    """Return a letter that passes and makes few atoms true."""
    least = min(guard.cubes, key=lambda cube: (len(cube.required), sorted(cube.required)))
    return least.required
