"""How far a word has brought a task: what is settled, what is owed, what was counted.

``Progress``   the outcome
``WORDS``      the four verdicts in words
``follow``     a task's progress along a word

The verdict is the runtime monitor's. So are the passes through accepting transitions; for □◇φ the
audit has a count of its own, in ``formula``.
"""

from collections.abc import Iterable, Sequence
from contextlib import suppress
from dataclasses import dataclass
from typing import Final

from tlcomm_core.errors import IntractableTaskError
from tlcomm_core.ltl import BuchiAutomaton, Formula, Monitor, RunMonitor, Verdict, translate
from tlcomm_tools.audit.words import Letter

__all__ = ["WORDS", "Progress", "follow"]

WORDS: Final = {
    Verdict.TRUE: "fulfilled",
    Verdict.PRESUMABLY_TRUE: "kept",
    Verdict.PRESUMABLY_FALSE: "pending",
    Verdict.FALSE: "violated",
}


@dataclass(frozen=True, slots=True)
class Progress:
    """A task's outcome on a finite word.

    Attributes:
        verdict: *fulfilled* or *violated*: whatever may follow; *kept*: nothing is owed if nothing
            follows; *pending*: something is; ``None`` where it can't be told.
        settled: number of letters after which it was fulfilled or violated, else ``None``.
        passes: the letters, counted from 0, that took accepting transitions of the task's
            automaton; ``None`` where the automaton leaves that open.
    """

    verdict: str | None
    settled: int | None
    passes: tuple[int, ...] | None

    @property
    def violated(self) -> int | None:
        """Number of letters after which nothing could satisfy the task any more."""
        return self.settled if self.verdict == WORDS[Verdict.FALSE] else None


def follow(task: Formula | BuchiAutomaton, word: Sequence[Letter]) -> Progress:
    """Return the progress of a formula, or of an automaton given instead, along a word."""
    try:
        runs = RunMonitor(task if isinstance(task, BuchiAutomaton) else translate(task))
    except IntractableTaskError:
        # It could be planned for the letters of its system alone; what else may follow is open.
        return Progress(None, None, None)
    watching: Monitor | RunMonitor = runs
    if isinstance(task, Formula):
        # Where it is the negation that has no small automaton, the runs are all there is.
        with suppress(IntractableTaskError):
            watching = Monitor(task)
    _read(word, {id(own): own for own in (runs, watching)}.values())
    verdict = watching.verdict
    return Progress(
        verdict=None if verdict is None else WORDS[verdict],
        settled=watching.final_after,
        passes=runs.passes,
    )


def _read(word: Sequence[Letter], monitors: Iterable[Monitor | RunMonitor]) -> None:
    for monitor in monitors:
        for letter in word:
            monitor.read(letter)
