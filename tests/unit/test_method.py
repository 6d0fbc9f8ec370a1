"""Methods of coordination by name, and what each promises and decides."""

import pytest

from tlcomm_core.errors import InputError
from tlcomm_core.game.solver import BEST_RESPONSE, COALITION, EXACT
from tlcomm_core.method import Method, parse_method


def test_each_is_found_by_its_name() -> None:
    """The names are those that users type."""
    assert [parse_method(own) for own in ("team", "all-time")] == [Method.TEAM, Method.ALL_TIME]


def test_an_unknown_one_is_named() -> None:
    """The message says which there are."""
    with pytest.raises(InputError, match=r"'mesh' isn't one of team, static, .*, oracle"):
        parse_method("mesh")


def test_some_meet_in_windows() -> None:
    """Their rounds are windows; pairs and turns are counted by themselves, and nobody's not."""
    windowed = {own for own in Method if own.meets_in_windows}
    assert windowed == {Method.TEAM, Method.STATIC, Method.ORACLE}


def test_the_choice_of_a_solver_is_the_teams_only() -> None:
    """The yardstick and pairs are solved exactly; where nothing is sought, nobody proposes."""
    assert Method.TEAM.solver(COALITION) is COALITION
    assert Method.ORACLE.solver(COALITION) is EXACT
    assert Method.PAIRWISE.solver(COALITION) is EXACT
    assert Method.STATIC.solver(COALITION) is BEST_RESPONSE
