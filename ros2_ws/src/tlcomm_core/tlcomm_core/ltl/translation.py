"""The Büchi automaton that planning uses for a formula.

- ``translate``   chooses the construction
"""

from tlcomm_core.ltl.automaton import BuchiAutomaton
from tlcomm_core.ltl.formula import Formula
from tlcomm_core.ltl.good_prefix import restarted
from tlcomm_core.ltl.normal_form import is_co_safe, recurring
from tlcomm_core.ltl.tableau import tableau_automaton

__all__ = ["translate"]


def translate(formula: Formula) -> BuchiAutomaton:
    """Return a Büchi automaton of the words that satisfy a formula.

    □◇φ with syntactically co-safe φ (however it is written) becomes φ's good-prefix automaton,
    begun anew after each acceptance, so that a cycle through one accepting transition is one
    satisfaction of φ. Every other formula goes through the tableau. The result's ``kind`` says
    which it was.

    Cost: see ``restarted`` and ``tableau_automaton``.
    """
    repeated = recurring(formula)
    if repeated is not None and is_co_safe(repeated):
        return restarted(repeated)
    return tableau_automaton(formula)
