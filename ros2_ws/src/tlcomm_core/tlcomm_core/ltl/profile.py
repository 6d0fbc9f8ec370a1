"""What a formula is: whether words satisfy or violate it, which ones, and its class.

- ``TemporalClass``  how soon words satisfy or violate it, by its syntax
- ``OpenWord``       a finite word after which nothing is settled
- ``Profile``        all that is known
- ``profile``        finds it out
"""

from dataclasses import dataclass
from enum import Enum

from tlcomm_core.ltl.automaton import BuchiAutomaton
from tlcomm_core.ltl.conflict import known_conflict
from tlcomm_core.ltl.finite import FiniteReading
from tlcomm_core.ltl.formula import Formula, Operator
from tlcomm_core.ltl.guard import Cube
from tlcomm_core.ltl.monitor import Verdict
from tlcomm_core.ltl.normal_form import is_co_safe, recurring
from tlcomm_core.ltl.short_words import shortest_lasso
from tlcomm_core.ltl.translation import translate
from tlcomm_core.ltl.word import LassoWord, Letter, accepted_word, live_states

__all__ = ["OpenWord", "Profile", "TemporalClass", "profile"]


class TemporalClass(Enum):
    """How soon words satisfy or violate a formula, by its syntax; the value is for reports.

    Source: Manna and Pnueli, "A hierarchy of temporal properties", 1990; Kupferman and Vardi,
        "Model checking of safety properties", 2001 (by syntax).
    """

    BOUNDED = "safety and co-safety: settled after some letters"
    CO_SAFETY = "co-safety: satisfied after some letters, if at all"
    SAFETY = "safety: violated after some letters, if at all"
    RECURRENCE = "recurrence: something co-safe again and again"
    OTHER = "neither safety, co-safety nor their recurrence by its syntax"

    @classmethod
    def of(cls, formula: Formula) -> "TemporalClass":
        """Return a formula's class."""
        is_safe = is_co_safe(Formula(Operator.NOT, (formula,)))
        if is_co_safe(formula):
            return cls.BOUNDED if is_safe else cls.CO_SAFETY
        if is_safe:
            return cls.SAFETY
        repeated = recurring(formula)
        return cls.RECURRENCE if repeated is not None and is_co_safe(repeated) else cls.OTHER


@dataclass(frozen=True, slots=True)
class OpenWord:
    """A finite word after which some continuations satisfy a formula, and others violate it.

    Attributes:
        letters: at least one.
        verdict: what is presumed after them.
    """

    letters: tuple[Letter, ...]
    verdict: Verdict


@dataclass(frozen=True, slots=True)
class Profile:
    """What is known about a formula.

    Attributes:
        automaton: the automaton that planning uses.
        temporal_class: the formula's class.
        conflict: conjuncts that exclude each other; none if some word satisfies the formula.
        satisfying: a word that satisfies it; ``None`` if none does.
        violating: a word that violates it; ``None`` if the formula is valid.
        undecided: a word after which the formula is neither; ``None`` if each first letter
            settles it.
    """

    automaton: BuchiAutomaton
    temporal_class: TemporalClass
    conflict: tuple[Formula, ...]
    satisfying: LassoWord | None
    violating: LassoWord | None
    undecided: OpenWord | None


def profile(formula: Formula) -> Profile:
    """Find out what a formula is.

    The words have the fewest letters, then the fewest true atoms. Where there are too many short
    words to read them all, lasso words are those of shortest ways through the automaton instead.

    Raises:
        IntractableTaskError: an automaton, of the formula or its negation, is too large.
    Cost: two translations, ``shortest_lasso`` twice; for a contradiction, ``conflict`` as well.
    """
    negation = Formula(Operator.NOT, (formula,))
    automaton, opposite = translate(formula), translate(negation)
    satisfying = _word(formula, automaton)
    return Profile(
        automaton=automaton,
        temporal_class=TemporalClass.of(formula),
        conflict=known_conflict(formula) if satisfying is None else (),
        satisfying=satisfying,
        violating=_word(negation, opposite),
        undecided=_open_word(formula, automaton, opposite),
    )


def _word(formula: Formula, automaton: BuchiAutomaton) -> LassoWord | None:
    """Return a short word that satisfies a formula, given its automaton."""
    accepted = accepted_word(automaton)
    if accepted is None:
        return None
    short = accepted.shortened()
    return shortest_lasso(formula, len(short.stem) + len(short.loop)) or short


def _open_word(
    formula: Formula, automaton: BuchiAutomaton, opposite: BuchiAutomaton
) -> OpenWord | None:
    """Return one letter, for no word is open whose first letter isn't."""
    letters = [
        one.required | other.required
        for one in _first_cubes(automaton)
        for other in _first_cubes(opposite)
        if one.is_compatible(other)
    ]
    if not letters:
        return None
    letter = min(letters, key=lambda names: (len(names), sorted(names)))
    reading = FiniteReading(formula)
    reading.read(letter)
    is_satisfied = reading.is_satisfied
    verdict = Verdict.PRESUMABLY_TRUE if is_satisfied else Verdict.PRESUMABLY_FALSE
    return OpenWord((letter,), verdict)


def _first_cubes(automaton: BuchiAutomaton) -> list[Cube]:
    """Return the cubes of first letters after which some word is still accepted."""
    live = live_states(automaton)
    edges = automaton.transitions[automaton.initial]
    return [cube for edge in edges if edge.target in live for cube in edge.guard.cubes]
