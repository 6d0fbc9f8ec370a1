"""Numbers of states against spin's never claims, where spin is installed."""

from shutil import which

import pytest

from support.ltl_benchmarks import DWYER, ETESSAMI_HOLZMANN, SOMENZI_BLOEM, without_next
from support.spin import spin_state_count
from tlcomm_core.ltl import parse, tableau_automaton

SETS = {
    "Dwyer": DWYER,
    "Etessami-Holzmann": ETESSAMI_HOLZMANN,
    "Somenzi-Bloem": SOMENZI_BLOEM,
    "random": without_next(60),
}


@pytest.mark.skipif(which("spin") is None, reason="spin isn't installed (apt install spin)")
@pytest.mark.parametrize("name", SETS)
def test_automata_are_no_larger_than_spins(name: str) -> None:
    """In the mean of each set, an automaton has at most 1.15 times the states of spin's."""
    ratios = []
    for text in SETS[name]:
        formula = parse(text)
        states = spin_state_count(formula, limit_s=0.5)
        if states:
            ratios.append(tableau_automaton(formula).state_count / states)
    assert len(ratios) > len(SETS[name]) / 3
    assert sum(ratios) / len(ratios) <= 1.15
