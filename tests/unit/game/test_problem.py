"""Profiles and the values behind them."""

from collections.abc import Callable

from tlcomm_core.game.problem import Choice, Profile, RoundProblem
from tlcomm_core.game.strategy import Strategy

MakeProblem = Callable[..., RoundProblem]


def test_indices_become_exchanged_values(make_problem: MakeProblem) -> None:
    """A strategy holds the place, the plan index (not the row), the arrival and the detour."""
    problem = make_problem(
        [(0.0, 0.0), (1.0, 2.0)], 1.0, a=[[(61.0, 1.0), (62.0, 2.0)]], b=[[None, (63.0, 3.0)]]
    )
    assert problem.strategies(Profile((1, 1), (0, 0))) == (
        Strategy("a", 1.0, 2.0, 7, 62.0, 2.0),
        Strategy("b", 1.0, 2.0, 7, 63.0, 3.0),
    )
    assert problem.agents == ("a", "b")


def test_a_switch_changes_one_agent() -> None:
    """Switching replaces that agent's indices and leaves the original profile alone."""
    profile = Profile((1, 2, 3), (4, 5, 6))
    assert profile.switched(1, Choice(8, 9)) == Profile((1, 8, 3), (4, 9, 6))
    assert profile.choice(1) == Choice(2, 5)
