"""The potential of a team strategy and one agent's share in it, from the values exchanged.

``communication_time``  t_c
``additional_times``    ξ_i
``potential``           Φ
``deviation_costs``     u_i of one agent's candidates, the others' strategies given
``switch_costs``        the same, given only when the others could meet
``evaluate``            a ``TeamStrategy`` from strategies
"""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from tlcomm_core.game.strategy import Strategy, TeamStrategy

__all__ = [
    "additional_times",
    "communication_time",
    "deviation_costs",
    "evaluate",
    "potential",
    "switch_costs",
]


def communication_time(strategies: Sequence[Strategy], opens_s: float) -> float:
    """Return t_c = max(max_i t_i, r·T_c): the last arrival, but not before the window opens.

    Args:
        strategies: of any agents, possibly none.
        opens_s: r·T_c.
    """
    return max([opens_s, *(strategy.arrival_s for strategy in strategies)])


def additional_times(strategies: Sequence[Strategy], opens_s: float) -> tuple[float, ...]:
    """Return ξ_i = δ_i + (t_c − t_i) for each strategy.

    Source: Eq. (5) of the paper.
    """
    meeting_s = communication_time(strategies, opens_s)
    return tuple(s.extra_travel_s + (meeting_s - s.arrival_s) for s in strategies)


def potential(strategies: Sequence[Strategy], opens_s: float) -> float:
    """Return Φ(S) = Σ_i ξ_i, summed in the order given.

    Source: Section IV-B2 of the paper.
    """
    return sum(additional_times(strategies, opens_s))


def deviation_costs(
    arrival_s: NDArray[np.float64],
    extra_s: NDArray[np.float64],
    others: Sequence[Strategy],
    opens_s: float,
) -> NDArray[np.float64]:
    """Return u_i of one agent's candidates while the others keep their strategies.

    Args:
        arrival_s: t_i of each candidate, of any shape; +inf where inadmissible.
        extra_s: δ_i of the same shape; +inf where ``arrival_s`` is.
        others: the N − 1 others' strategies.
        opens_s: r·T_c.

    Returns:
        u_i = δ_i + N·t_c − t_i of the same shape, fresh; +inf where inadmissible.

    Source: Section IV-B2 of the paper.
    Deviates: times count from the window's opening, which shifts u_i by a constant, so that
        rounding doesn't grow with the age of the run.
    """
    others_s = communication_time(others, opens_s)
    return switch_costs(arrival_s, extra_s, len(others) + 1, others_s, opens_s)


def switch_costs(
    arrival_s: NDArray[np.float64],
    extra_s: NDArray[np.float64],
    team: int,
    others_s: float,
    opens_s: float,
) -> NDArray[np.float64]:
    """Return the same as ``deviation_costs``, knowing of the others only when they could meet.

    Args:
        arrival_s: t_i of each candidate, of any shape; +inf where inadmissible.
        extra_s: δ_i of the same shape; +inf where ``arrival_s`` is.
        team: N.
        others_s: t_c of the others alone.
        opens_s: r·T_c.
    """
    since_s = np.where(np.isfinite(arrival_s), arrival_s - opens_s, 0.0)
    latest_s = np.maximum(since_s, others_s - opens_s)
    costs_s: NDArray[np.float64] = extra_s + team * latest_s - since_s
    return costs_s


def evaluate(
    round_: int,
    strategies: Sequence[Strategy],
    opens_s: float,
    iteration: int,
    initial_potential_s: float,
    bound_s: float | None = None,
) -> TeamStrategy:
    """Return the team strategy made of ``strategies``, sorted by agent, with its t_c and Φ."""
    ordered = tuple(sorted(strategies, key=lambda strategy: strategy.agent))
    return TeamStrategy(
        round=round_,
        iteration=iteration,
        strategies=ordered,
        communication_s=communication_time(ordered, opens_s),
        potential_s=potential(ordered, opens_s),
        initial_potential_s=initial_potential_s,
        bound_s=bound_s,
    )
