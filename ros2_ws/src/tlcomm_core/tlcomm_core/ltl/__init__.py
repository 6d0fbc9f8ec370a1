"""Linear temporal logic: formulas, their text, and the automata that recognise them.

- ``parse``, ``explain``          text to formula, and what is wrong with a text
- ``Formula``, ``Operator``, ``TRUE``, ``FALSE``, ``atom``, ``atoms``, ``subformulas``, ``to_text``
- ``negation_normal_form``, ``is_co_safe``, ``recurring``
- ``translate``                   the Büchi automaton that planning uses
- ``restarted``, ``good_prefix_automaton``, ``tableau_automaton``   its constructions
- ``BuchiAutomaton``, ``GoodPrefixAutomaton``, ``Construction``, ``Transition``, ``Guard``, ``Cube``
- ``conflict``, ``known_conflict``, ``conjuncts``, ``contradiction``   parts that exclude each other
- ``profile``, ``Profile``, ``OpenWord``, ``TemporalClass``   what a formula is, with words as proof
- ``invariants``, ``forbidden``    what a formula demands of every letter
- ``Monitor``, ``Verdict``        what a finite part of a word says about a formula
- ``RunMonitor``                 the same for an automaton
- ``LassoWord``, ``accepted_word``   endless words as proof
- ``to_hoa``, ``to_dot``          for other tools
- ``read_hoa``                    from other tools
"""

from tlcomm_core.ltl.automaton import BuchiAutomaton, Construction, Transition
from tlcomm_core.ltl.conflict import (
    conflict,
    conjuncts,
    contradiction,
    known_conflict,
    smallest_conflict,
)
from tlcomm_core.ltl.dot import to_dot
from tlcomm_core.ltl.formula import (
    FALSE,
    TRUE,
    Formula,
    Operator,
    atom,
    atoms,
    conjunction,
    subformulas,
    to_text,
)
from tlcomm_core.ltl.good_prefix import GoodPrefixAutomaton, good_prefix_automaton, restarted
from tlcomm_core.ltl.guard import Cube, Guard
from tlcomm_core.ltl.hoa import to_hoa
from tlcomm_core.ltl.hoa_reader import read_hoa
from tlcomm_core.ltl.invariant import forbidden, invariants
from tlcomm_core.ltl.monitor import Monitor, Verdict
from tlcomm_core.ltl.normal_form import is_co_safe, negation_normal_form, recurring
from tlcomm_core.ltl.parser import MAX_LENGTH, MAX_NESTING, explain, parse
from tlcomm_core.ltl.profile import OpenWord, Profile, TemporalClass, profile
from tlcomm_core.ltl.run_monitor import RunMonitor
from tlcomm_core.ltl.tableau import tableau_automaton
from tlcomm_core.ltl.translation import translate
from tlcomm_core.ltl.word import LassoWord, accepted_word, word_text

__all__ = [
    "FALSE",
    "MAX_LENGTH",
    "MAX_NESTING",
    "TRUE",
    "BuchiAutomaton",
    "Construction",
    "Cube",
    "Formula",
    "GoodPrefixAutomaton",
    "Guard",
    "LassoWord",
    "Monitor",
    "OpenWord",
    "Operator",
    "Profile",
    "RunMonitor",
    "TemporalClass",
    "Transition",
    "Verdict",
    "accepted_word",
    "atom",
    "atoms",
    "conflict",
    "conjunction",
    "conjuncts",
    "contradiction",
    "explain",
    "forbidden",
    "good_prefix_automaton",
    "invariants",
    "is_co_safe",
    "known_conflict",
    "negation_normal_form",
    "parse",
    "profile",
    "read_hoa",
    "recurring",
    "restarted",
    "smallest_conflict",
    "subformulas",
    "tableau_automaton",
    "to_dot",
    "to_hoa",
    "to_text",
    "translate",
    "word_text",
]
