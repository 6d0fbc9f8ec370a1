"""Why a team meets where and when it does: what each agent pays, and what else it could do.

``Attendance``  one agent's part in a meeting, beside its best alternative
``rationale``   every agent's
"""

from dataclasses import dataclass

import numpy as np

from tlcomm_core.game.potential import additional_times, communication_time, deviation_costs
from tlcomm_core.game.problem import Profile, RoundProblem
from tlcomm_core.game.strategy import Strategy

__all__ = ["Attendance", "rationale"]


@dataclass(frozen=True, slots=True)
class Attendance:
    """One agent's part in a meeting, beside its best alternative.

    Attributes:
        strategy: what the agent does.
        wait_s: how long it waits for the meeting to begin, t_c − t.
        additional_s: ξ, its detour and its wait.
        alternative: the best other strategy that keeps the team connected while the others keep
            theirs; ``None`` if it has no other.
        increase_s: how much that would raise the potential; 0 or more in an equilibrium.
    """

    strategy: Strategy
    wait_s: float
    additional_s: float
    alternative: Strategy | None
    increase_s: float | None


def rationale(problem: RoundProblem, profile: Profile) -> tuple[Attendance, ...]:
    """Return what each agent pays for a meeting, and what else it could do.

    Args:
        problem: the round.
        profile: an admissible team strategy.

    Source: u_i and Φ in Section IV-B2 of the paper.
    """
    strategies = problem.strategies(profile)
    opens_s, _ = problem.window_s
    meeting_s = communication_time(strategies, opens_s)
    attendances = []
    for agent, additional_s in enumerate(additional_times(strategies, opens_s)):
        alternative, increase_s = _alternative(problem, profile, agent)
        wait_s = meeting_s - strategies[agent].arrival_s
        attendances.append(
            Attendance(strategies[agent], wait_s, additional_s, alternative, increase_s)
        )
    return tuple(attendances)


def _alternative(
    problem: RoundProblem, profile: Profile, agent: int
) -> tuple[Strategy | None, float | None]:
    """Return an agent's best switch while the others stay, and what it does to the potential."""
    own, current = problem.candidates[agent], profile.choice(agent)
    strategies = problem.strategies(profile)
    others = strategies[:agent] + strategies[agent + 1 :]
    opens_s, _ = problem.window_s
    costs_s = deviation_costs(own.arrival_s, own.extra_s, others, opens_s)
    present_s = float(costs_s[current.candidate, current.location])
    costs_s[:, ~problem.open_places(problem.places_of(others))] = np.inf
    costs_s[current.candidate, current.location] = np.inf
    row, place = divmod(int(np.argmin(costs_s)), len(problem.links))
    if not np.isfinite(costs_s[row, place]):
        return None, None
    return problem.strategy(agent, place, row), float(costs_s[row, place]) - present_s
