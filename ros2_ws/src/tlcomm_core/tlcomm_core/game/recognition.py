"""A peer's team strategy, looked up in one's own tables.

``recognise``  the profile that it is, if it is admissible and costs what is claimed
"""

from collections.abc import Sequence
from typing import Final

import numpy as np

from tlcomm_core.game.potential import potential
from tlcomm_core.game.problem import Candidates, Profile, RoundProblem
from tlcomm_core.game.strategy import Strategy

__all__ = ["POTENTIAL_TOLERANCE_S", "recognise"]

POTENTIAL_TOLERANCE_S: Final = 1e-6
"""What two machines' sums of the same times may differ by."""


def recognise(
    problem: RoundProblem, strategies: Sequence[Strategy], potential_s: float
) -> Profile | None:
    """Return the profile that values from outside are, or ``None`` if they aren't one.

    Args:
        problem: the round.
        strategies: any values, as received.
        potential_s: the Φ that is claimed for them.

    Returns:
        The profile, if all agents are there in their order, each with a candidate of its own and
        its times, at places that the rules allow, and if Φ is as claimed; ``None`` otherwise.
    """
    if tuple(strategy.agent for strategy in strategies) != problem.agents:
        return None
    locations: list[int] = []
    rows: list[int] = []
    for own, strategy in zip(problem.candidates, strategies, strict=True):
        location = problem.links.place_at(strategy.x_m, strategy.y_m)
        row = None if location is None else _row(own, location, strategy)
        if location is None or row is None:
            return None
        locations.append(location)
        rows.append(row)
    opens_s, _ = problem.window_s
    is_as_claimed = abs(potential(strategies, opens_s) - potential_s) <= POTENTIAL_TOLERANCE_S
    if is_as_claimed and problem.is_admissible(locations):
        return Profile(tuple(locations), tuple(rows))
    return None


def _row(own: Candidates, location: int, strategy: Strategy) -> int | None:
    """Return the row of an agent's candidates with the strategy's h, if the times are the same."""
    row = int(np.searchsorted(own.task_index, strategy.task_index))
    if row == len(own.task_index) or own.task_index[row] != strategy.task_index:
        return None
    off_s = max(
        abs(float(own.arrival_s[row, location]) - strategy.arrival_s),
        abs(float(own.extra_s[row, location]) - strategy.extra_travel_s),
    )
    return row if off_s <= POTENTIAL_TOLERANCE_S else None
