"""What is known about a formula after a finite part of an endless word.

- ``Verdict``   true, presumably true, presumably false, false
- ``Monitor``   reads letters, tells the verdict, counts satisfactions, and shows words as proof
"""

from collections.abc import Iterable
from enum import Enum
from typing import Final

from tlcomm_core.ltl.automaton import BuchiAutomaton
from tlcomm_core.ltl.finite import FiniteReading
from tlcomm_core.ltl.formula import Formula, Operator
from tlcomm_core.ltl.good_prefix import restarted
from tlcomm_core.ltl.normal_form import is_co_safe, recurring
from tlcomm_core.ltl.translation import translate
from tlcomm_core.ltl.word import LassoWord, accepted_word, live_states

__all__ = ["Monitor", "Verdict"]


class Verdict(Enum):
    """The four values; the value is the word for reports."""

    TRUE = "true"
    PRESUMABLY_TRUE = "presumably true"
    PRESUMABLY_FALSE = "presumably false"
    FALSE = "false"

    @property
    def is_final(self) -> bool:
        """Whether no further letter can change it."""
        return self in {Verdict.TRUE, Verdict.FALSE}


class Monitor:
    """Reads a word letter by letter and tells what that says about a formula.

    The verdict is *true* if every continuation satisfies the formula, *false* if none does;
    otherwise it is presumed from the letters read so far as if none followed. Before the first
    letter, nothing having been done yet, that is *presumably false*.

    Attributes:
        formula: what is watched.

    Source: Bauer, Leucker and Schallhart, "Comparing LTL semantics for runtime verification",
        2010 (RV-LTL); the automata of φ and ¬φ as in their "Runtime verification for LTL and
        TLTL", 2011.
    Cost: the two translations, ¬φ's being the dearer one for the usual tasks; then per letter
        linear in the automata's states, and that of ``FiniteReading``.
    """

    def __init__(self, formula: Formula) -> None:
        """Translate the formula and its negation; no letter is read."""
        self.formula: Final = formula
        self._for = _Track(translate(formula))
        self._against = _Track(translate(Formula(Operator.NOT, (formula,))))
        self._presumed = FiniteReading(formula)
        self._count = _Count.of(formula)
        self._letters_read = 0
        self._final_after = self._settled_now()

    @property
    def letters_read(self) -> int:
        """How many letters were read."""
        return self._letters_read

    @property
    def final_after(self) -> int | None:
        """After how many letters the verdict became final; None if it isn't.

        The word's first that many letters are then a shortest good or bad prefix.
        """
        return self._final_after

    @property
    def satisfactions(self) -> int | None:
        """How often φ was satisfied, begun anew each time, if the formula is G F φ, φ co-safe."""
        return None if self._count is None else self._count.satisfactions

    @property
    def verdict(self) -> Verdict:
        """What the letters read so far say."""
        if not self._for.states:
            return Verdict.FALSE
        if not self._against.states:
            return Verdict.TRUE
        if self._presumed.is_satisfied:
            return Verdict.PRESUMABLY_TRUE
        return Verdict.PRESUMABLY_FALSE

    def read(self, letter: Iterable[str]) -> Verdict:
        """Read one more letter, given as the atoms that are true, and return the verdict."""
        true = frozenset(letter)
        self._letters_read += 1
        if self._count is not None:
            self._count.read(true)
        if self._final_after is None:
            self._for.read(true)
            self._against.read(true)
            self._presumed.read(true)
            self._final_after = self._settled_now()
        return self.verdict

    def satisfying(self) -> LassoWord | None:
        """Return a continuation with which the word satisfies the formula; None if none does."""
        return self._for.continuation()

    def violating(self) -> LassoWord | None:
        """Return a continuation with which the word violates the formula; None if none does."""
        return self._against.continuation()

    def _settled_now(self) -> int | None:
        is_open = self._for.states and self._against.states
        return None if is_open else self._letters_read


class _Track:
    """The states in which an automaton may be, without those from which nothing is accepted."""

    def __init__(self, automaton: BuchiAutomaton) -> None:
        self._automaton = automaton
        self._live = live_states(automaton)
        self.states = self._live & {automaton.initial}

    def read(self, letter: frozenset[str]) -> None:
        """Follow all transitions that a letter takes."""
        self.states = self._live & {
            target
            for state in self.states
            for target, _ in self._automaton.successors(state, letter)
        }

    def continuation(self) -> LassoWord | None:
        """Return a word that is accepted from here; None if none is."""
        return accepted_word(self._automaton, sorted(self.states))


class _Count:
    """The satisfactions of φ, each begun after the last."""

    def __init__(self, recurring_part: Formula) -> None:
        self._automaton = restarted(recurring_part)
        self._state = self._automaton.initial
        self.satisfactions = 0

    @classmethod
    def of(cls, formula: Formula) -> "_Count | None":
        """Return the count for G F φ with co-safe φ, else None."""
        repeated = recurring(formula)
        return cls(repeated) if repeated is not None and is_co_safe(repeated) else None

    def read(self, letter: frozenset[str]) -> None:
        """Follow the transition that a letter takes, and count it if it accepts."""
        ((self._state, accepting),) = self._automaton.successors(self._state, letter)
        self.satisfactions += accepting
