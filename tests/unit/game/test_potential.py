"""Potentials from exchanged values."""

import numpy as np

from tlcomm_core.game.potential import (
    additional_times,
    communication_time,
    deviation_costs,
    evaluate,
    potential,
)
from tlcomm_core.game.strategy import Strategy


def strategy(agent: str, arrival_s: float, extra_s: float) -> Strategy:
    """Return a strategy of which only the times matter."""
    return Strategy(agent, 0.0, 0.0, 3, arrival_s, extra_s)


EARLY = strategy("a", 50.0, 2.0)
LATE = strategy("b", 70.0, 1.0)


def test_the_last_arrival_sets_the_time_inside_the_window() -> None:
    """t_c is the last arrival."""
    assert communication_time([EARLY, LATE], 60.0) == 70.0


def test_nobody_meets_before_the_window_opens() -> None:
    """t_c is r·T_c when all arrive earlier, and when there is nobody."""
    assert communication_time([EARLY], 60.0) == 60.0
    assert communication_time([], 60.0) == 60.0


def test_additional_times_are_detour_and_wait() -> None:
    """ξ_i = δ_i + (t_c − t_i)."""
    assert additional_times([EARLY, LATE], 60.0) == (22.0, 1.0)
    assert potential([EARLY, LATE], 60.0) == 23.0


def test_costs_count_the_wait_that_an_agent_causes_to_all() -> None:
    """u_i less N·r·T_c and plus r·T_c is δ_i + N·t_c − t_i; inadmissible stays inadmissible."""
    arrival_s = np.array([[50.0, 65.0, 80.0, np.inf]])
    extra_s = np.array([[2.0, 2.0, 0.0, np.inf]])
    costs_s = deviation_costs(arrival_s, extra_s, [LATE], 60.0)
    paper_s = np.array([2 + 2 * 70 - 50, 2 + 2 * 70 - 65, 0 + 2 * 80 - 80, np.inf])
    assert costs_s.tolist() == [(paper_s - 2 * 60 + 60).tolist()]


def test_costs_of_an_agent_alone_are_its_additional_times() -> None:
    """With N = 1, u_i is ξ_i: it waits only for the window."""
    costs_s = deviation_costs(np.array([50.0, 65.0]), np.array([2.0, 3.0]), [], 60.0)
    assert costs_s.tolist() == [12.0, 3.0]


def test_evaluation_sorts_by_agent() -> None:
    """A team strategy lists agents by name and carries its t_c and potential."""
    team = evaluate(1, [LATE, EARLY], 60.0, 4, 30.0)
    assert [s.agent for s in team.strategies] == ["a", "b"]
    assert (team.round, team.iteration) == (1, 4)
    assert (team.communication_s, team.potential_s) == (70.0, 23.0)
    assert team.initial_potential_s == 30.0
