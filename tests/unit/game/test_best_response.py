"""Single best responses, and the order in which they are taken."""

from collections.abc import Callable

import numpy as np
import pytest

from tlcomm_core.errors import LocalMisuseError
from tlcomm_core.game.best_response import (
    CHANGE_TOLERANCE_S,
    Response,
    Scope,
    Search,
    best_response,
    priority,
)
from tlcomm_core.game.problem import Choice, RoundProblem
from tlcomm_core.game.strategy import Strategy

MakeProblem = Callable[..., RoundProblem]
LINE_M = [(0.0, 0.0), (1.0, 0.0), (2.0, 0.0), (3.0, 0.0)]
HERE = Choice(0, 0)


def other(x_m: float, arrival_s: float = 70.0) -> Strategy:
    """Return the strategy of somebody else on the line."""
    return Strategy("other", x_m, 0.0, 0, arrival_s, 1.0)


def detours(*extra_s: float | None) -> list[list[tuple[float, float] | None]]:
    """Return a table of one row: arrivals at 70 s, detours by place."""
    return [[None if extra is None else (70.0, extra) for extra in extra_s]]


def test_the_ball_reaches_as_far_as_the_range(make_problem: MakeProblem) -> None:
    """Near the present place only what lies within R counts; everywhere, all that connects."""
    problem = make_problem(LINE_M, 1.0, a=detours(5, 4, 1, 0))
    others = [other(1.0)]
    assert best_response(problem, 0, HERE, others, Scope.BALL) == Response(-1.0, 1, 0)
    assert best_response(problem, 0, HERE, others, Scope.EVERYWHERE) == Response(-4.0, 2, 0)


def test_a_bridge_stays_where_it_joins_the_others(make_problem: MakeProblem) -> None:
    """An agent that alone holds two others together doesn't leave, however cheap it is."""
    problem = make_problem(LINE_M, 1.0, a=detours(0, 5, 0, 0))
    response = best_response(problem, 0, Choice(1, 0), [other(0.0), other(2.0)], Scope.EVERYWHERE)
    assert response == Response(0.0, 1, 0)


def test_arriving_after_all_others_costs_the_whole_team(make_problem: MakeProblem) -> None:
    """A detour 4 s shorter isn't worth an arrival 2 s later for a team of three."""
    rows = [[(70.0, 6.0)], [(72.0, 2.0)]]
    problem = make_problem(LINE_M[:1], 1.0, a=rows)
    team = [other(0.0), other(0.0)]
    assert best_response(problem, 0, HERE, team, Scope.BALL) == Response(0.0, 0, 0)
    assert best_response(problem, 0, HERE, team[:1], Scope.BALL) == Response(-2.0, 0, 1)


def test_working_on_beats_waiting(make_problem: MakeProblem) -> None:
    """An agent that would wait does another task first when it is still in time."""
    problem = make_problem(LINE_M[:1], 1.0, a=[[(61.0, 0.0)], [(69.0, 0.0)], [None]])
    assert best_response(problem, 0, HERE, [other(0.0)], Scope.BALL) == Response(-8.0, 0, 1)


@pytest.mark.parametrize(("saving_s", "moves"), [(0.9, False), (1.1, True)])
def test_rounding_is_no_improvement(
    make_problem: MakeProblem, saving_s: float, *, moves: bool
) -> None:
    """A change counts only beyond the tolerance; below, it is 0.0 and nothing moves."""
    problem = make_problem(LINE_M, 1.0, a=detours(1.0, 1.0 - saving_s * CHANGE_TOLERANCE_S, 2, 2))
    response = best_response(problem, 0, HERE, [other(0.0)], Scope.BALL)
    assert (response != Response(0.0, 0, 0)) is moves


def test_ties_go_to_the_lowest_place_then_candidate(make_problem: MakeProblem) -> None:
    """Of four equal switches the first row at the first place is taken."""
    rows = [[(70.0, e) for e in (5.0, 9.0, 1.0)], *[[(70.0, e) for e in (5.0, 1.0, 1.0)]] * 2]
    problem = make_problem(LINE_M[:3], 1.0, a=rows)
    assert best_response(problem, 0, HERE, [other(1.0)], Scope.EVERYWHERE) == Response(-4.0, 1, 1)


def test_nowhere_to_go_means_staying(make_problem: MakeProblem) -> None:
    """Others that no place can join leave the agent where it is."""
    problem = make_problem([*LINE_M, (50.0, 0.0)], 1.0, a=detours(5, 0, 0, 0, 0))
    apart = [other(0.0), other(50.0)]
    assert best_response(problem, 0, HERE, apart, Scope.EVERYWHERE) == Response(0.0, 0, 0)


def test_another_at_no_location_is_a_mistake(make_problem: MakeProblem) -> None:
    """Whoever takes strategies from peers has to look at their places first."""
    problem = make_problem(LINE_M, 1.0, a=detours(5, 0, 0, 0))
    with pytest.raises(LocalMisuseError, match=r"x_m=0\.5.* is at no location"):
        best_response(problem, 0, HERE, [other(0.5)], Scope.BALL)


def test_only_the_own_candidates_are_read(make_problem: MakeProblem) -> None:
    """Others count by their messages: their tables may hold anything."""
    problem = make_problem(LINE_M, 1.0, a=detours(5, 4, 1, 0), b=detours(0, 0, 0, 0))
    garbled = make_problem(LINE_M, 1.0, a=detours(5, 4, 1, 0), b=[[None] * 4])
    garbled.candidates[1].arrival_s[:] = np.nan
    responses = {
        best_response(made, 0, HERE, [other(1.0)], Scope.EVERYWHERE) for made in (problem, garbled)
    }
    assert responses == {Response(-4.0, 2, 0)}


def test_the_least_change_goes_first_and_then_the_first_name() -> None:
    """Priority is by change, among equals by name."""
    keys = [priority(-1.0, "b"), priority(-1.0, "a"), priority(0.0, "0"), priority(-2.0, "c")]
    assert [agent for _, agent in sorted(keys)] == ["c", "a", "b", "0"]


def test_the_search_widens_once_and_ends_when_nothing_is_left() -> None:
    """Moves keep the scope; without one the ball gives way to all places, then it is over."""
    search = Search()
    scopes = []
    for change_s in (-1.0, -0.5, 0.0, -0.25, 0.0):
        scopes.append(search.scope)
        search = search.after(change_s)
    assert scopes == [Scope.BALL] * 3 + [Scope.EVERYWHERE] * 2
    assert search.scope is None
    assert search.is_equilibrium
    assert (search.iteration, search.moves) == (5, 3)


def test_the_search_ends_at_its_limit_without_an_equilibrium() -> None:
    """After K iterations it is over even while agents still move."""
    search = Search(max_iterations=2).after(-1.0).after(-1.0)
    assert (search.scope, search.is_equilibrium, search.moves) == (None, False, 2)
