"""The initial team strategy: everybody at one place, chosen exactly, or around one.

A team that keeps its places begins with the best times.

``initial_profile``  S⁰, the least potential over all common places and admissible times
"""

import numpy as np
from numpy.typing import NDArray

from tlcomm_core.errors import InfeasibleRoundError
from tlcomm_core.game.common_place import cheapest_common_place
from tlcomm_core.game.formation import cheapest_formation
from tlcomm_core.game.problem import Profile, RoundProblem
from tlcomm_core.game.standing import cheapest_times

__all__ = ["initial_profile"]


def initial_profile(problem: RoundProblem) -> Profile:
    """Return the common place and the candidates of least potential; or what the rules leave.

    Args:
        problem: at least one agent.

    Returns:
        S⁰, with one location for all; a formation if the rules demand a separation; everybody
        where it stands if they keep the places.

    Raises:
        InfeasibleRoundError: some agents have no admissible candidate, or no place is
            admissible for all.

    Source: Eq. (9) and "Optimization of Initial Strategy" in Section IV-B3 of the paper.
    Deviates: agents that mustn't share a place begin in a formation around one.
    """
    _check_feasible(problem)
    if problem.rules.keeps_places:
        return cheapest_times(problem)
    if problem.rules.separation_m:
        return _spread(problem)
    profile = cheapest_common_place(problem)
    if profile is None:
        raise _no_common_place(problem)
    return profile


def _check_feasible(problem: RoundProblem) -> None:
    stranded = [own.agent for own in problem.candidates if not np.isfinite(own.arrival_s).any()]
    if stranded:
        opens_s, closes_s = problem.window_s
        raise InfeasibleRoundError(
            f"round {problem.round}: no candidate that arrives in time for the window "
            f"[{opens_s!r}, {closes_s!r}) s for {', '.join(stranded)}"
        )


def _no_common_place(problem: RoundProblem) -> InfeasibleRoundError:
    _, closes_s = problem.window_s
    return InfeasibleRoundError(
        f"round {problem.round}: no place that all of {', '.join(problem.agents)} "
        f"reach before {closes_s!r} s"
    )


def _spread(problem: RoundProblem) -> Profile:
    """Return the cheapest formation around the places in the order of what they promise."""
    promise_s = _promises(problem)
    order = np.argsort(promise_s, kind="stable")
    centres = order[np.isfinite(promise_s[order])].tolist()
    if not centres:
        raise _no_common_place(problem)
    profile = cheapest_formation(problem, centres)
    if profile is None:
        raise InfeasibleRoundError(
            f"round {problem.round}: no {len(problem.agents)} places at least "
            f"{problem.rules.separation_m!r} m apart that all of {', '.join(problem.agents)} "
            "reach in time and that are connected as the scenario demands"
        )
    return profile


def _promises(problem: RoundProblem) -> NDArray[np.float64]:
    """Return [Z] a bound on Φ with all at each place; +inf where the team can't meet.

    Nobody meets before the slowest can be there, so each agent adds at least δ and its wait until
    then, if any.
    """
    opens_s, _ = problem.window_s
    since_s = [own.arrival_s - opens_s for own in problem.candidates]
    first_s = np.maximum.reduce([own_s.min(axis=0) for own_s in since_s])
    meeting_s = np.where(np.isfinite(first_s), np.maximum(first_s, 0.0), 0.0)
    promise_s: NDArray[np.float64] = np.zeros(len(problem.locations_m))
    for own, own_s in zip(problem.candidates, since_s, strict=True):
        promise_s += (own.extra_s + np.maximum(meeting_s - own_s, 0.0)).min(axis=0)
    return promise_s
