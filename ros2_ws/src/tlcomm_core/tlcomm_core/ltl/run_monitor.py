"""What is known about an automaton's language after a finite part of an endless word.

- ``RunMonitor``   follows the automaton's runs: a verdict, and passes through accepting transitions
"""

from collections.abc import Iterable
from typing import Final

from tlcomm_core.ltl.automaton import BuchiAutomaton, strong_components
from tlcomm_core.ltl.guard import covers_all_letters
from tlcomm_core.ltl.monitor import Verdict
from tlcomm_core.ltl.word import live_states

__all__ = ["RunMonitor"]


class RunMonitor:
    """Reads a word letter by letter and follows the runs that may still be accepting.

    Unlike ``Monitor`` it needs no formula and no complement. *False* is exact: no run is left that
    a continuation makes accepting. *True* is told where every run that goes on from some state
    accepts; that is exact for deterministic automata, and may come late or never for others. In
    between a word is *presumably true* where the only run just took an accepting transition,
    *presumably false* where it took another one; where several runs are possible there is none
    to tell it by.

    Source: Bauer, Leucker and Schallhart, "Comparing LTL semantics for runtime verification",
        2010, for the four values.
    Cost: the making is linear in the automaton, but for ``covers_all_letters``; a letter is
        linear in the states that are possible.
    """

    def __init__(self, automaton: BuchiAutomaton) -> None:
        """Read no letter."""
        self._automaton: Final = automaton
        self._live: Final = live_states(automaton)
        self._assured: Final = _assured_states(automaton)
        self._states = self._live & {automaton.initial}
        self._letters_read = 0
        self._passes: list[int] | None = []
        self._final_after = self._settled_now()

    @property
    def final_after(self) -> int | None:
        """After how many letters the verdict became final; None if it isn't."""
        return self._final_after

    @property
    def passes(self) -> tuple[int, ...] | None:
        """The letters, counted from 0, on which the only run took accepting transitions.

        None once several runs have been possible.
        """
        return None if self._passes is None else tuple(self._passes)

    @property
    def verdict(self) -> Verdict | None:
        """What the letters read so far say; None where several runs leave it open."""
        if not self._states:
            return Verdict.FALSE
        if self._states & self._assured:
            return Verdict.TRUE
        if self._passes is None:
            return None
        is_kept = self._passes[-1:] == [self._letters_read - 1]
        return Verdict.PRESUMABLY_TRUE if is_kept else Verdict.PRESUMABLY_FALSE

    def read(self, letter: Iterable[str]) -> None:
        """Read one more letter, given as the atoms that are true."""
        true = frozenset(letter)
        moves = [
            (target, accepting)
            for state in sorted(self._states)
            for target, accepting in self._automaton.successors(state, true)
            if target in self._live
        ]
        self._note_pass(moves)
        self._states = frozenset(target for target, _ in moves)
        self._letters_read += 1
        if self._final_after is None:
            self._final_after = self._settled_now()

    def _note_pass(self, moves: list[tuple[int, bool]]) -> None:
        if len(moves) > 1:
            self._passes = None
        elif self._passes is not None and moves and moves[0][1]:
            self._passes.append(self._letters_read)

    def _settled_now(self) -> int | None:
        is_open = self._states and not self._states & self._assured
        return None if is_open else self._letters_read


def _assured_states(automaton: BuchiAutomaton) -> frozenset[int]:
    """Return the states from which every run is endless and accepting."""
    rows = [[edge for edge in row if edge.guard.cubes] for row in automaton.transitions]
    lasting = [[edge.target for edge in row if not edge.accepting] for row in rows]
    component = strong_components(lasting)
    size = [0] * len(rows)
    for number in component:
        size[number] += 1
    sources: list[list[int]] = [[] for _ in rows]
    pending = []
    for state, row in enumerate(rows):
        for edge in row:
            sources[edge.target].append(state)
        may_idle = size[component[state]] > 1 or state in lasting[state]
        if may_idle or not covers_all_letters(cube for edge in row for cube in edge.guard.cubes):
            pending.append(state)
    doubtful = set(pending)
    while pending:
        fresh = set(sources[pending.pop()]) - doubtful
        doubtful |= fresh
        pending += fresh
    return frozenset(range(len(rows))) - doubtful
