"""Actions with conditions."""

import numpy as np
import pytest

from tlcomm_core.errors import LocalMisuseError
from tlcomm_core.planning.repertoire import Condition, Repertoire

DURATIONS_S = {"collect": 4.0, "check": 1.0, "measure": 2.0}
AFTER_BOTH = {"measure": Condition(after=frozenset({"collect", "check"}))}


def test_without_conditions_there_is_nothing_to_remember() -> None:
    """Everything is possible everywhere, always."""
    repertoire = Repertoire(DURATIONS_S, {})
    assert repertoire.memories == 1
    assert repertoire.possible_in(frozenset()).all()
    assert repertoire.possible_after(np.array([0])).all()
    assert (repertoire.memory_after(np.array([0])) == 0).all()


def test_an_action_waits_for_all_that_it_comes_after_and_then_anew() -> None:
    """In any order, repeated or not; and its own performance uses them up."""
    repertoire = Repertoire(DURATIONS_S, AFTER_BOTH)
    assert repertoire.memories == 4
    memory, possible = 0, []
    for action in (1, 1, 2, 3, 2):
        memory = int(repertoire.memory_after(np.array([memory]))[0, action])
        possible.append(bool(repertoire.possible_after(np.array([memory]))[0, 3]))
    assert possible == [False, False, True, False, False]
    assert repertoire.possible_after(np.arange(4))[:, :3].all()


def test_a_place_allows_what_is_possible_in_one_of_its_regions() -> None:
    """To idle is possible everywhere."""
    repertoire = Repertoire(DURATIONS_S, {"check": Condition(at=frozenset({"r1", "r2"}))})
    assert repertoire.possible_in(frozenset({"r2", "p"})).tolist() == [True] * 4
    assert repertoire.possible_in(frozenset({"p"})).tolist() == [True, True, False, True]


def test_an_unknown_action_is_a_mistake_of_ours() -> None:
    """Scenarios that name one are refused before."""
    with pytest.raises(LocalMisuseError, match="'measure' comes after unknown 'collet'"):
        Repertoire(DURATIONS_S, {"measure": Condition(after=frozenset({"collet"}))})
