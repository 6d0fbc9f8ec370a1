"""A team spread over places around a common centre, where sharing one place isn't allowed.

``cheapest_formation``  the cheapest of the formations around some centres
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final, Self

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import linear_sum_assignment

from tlcomm_core.game.links import Links
from tlcomm_core.game.problem import Profile, RoundProblem
from tlcomm_core.game.rules import Rules, is_admissible

__all__ = ["cheapest_formation"]

# Formations compared: the centres come in the order of what they promise, and any one will do to
# begin with.
_COMPARED: Final = 32
# Costs are compared in whole units of this: their sums are exact, so the same on every machine.
_UNIT_S: Final = 1e-6
# Stands for what can't be, and is more than any sum of what can: far more than a day each.
_NEVER: Final = 1e13


def cheapest_formation(problem: RoundProblem, centres: Sequence[int]) -> Profile | None:
    """Return the cheapest of the formations around the first centres that have one.

    A formation grows from its centre by the nearest place that all agents can reach and that the
    rules allow beside those taken; among equally near ones the lowest. It is assigned at the least
    potential.

    Args:
        problem: a round whose rules demand a separation.
        centres: places that all agents can reach, the most promising first.

    Returns:
        An admissible team strategy; None if no formation was found.

    Deviates: in the paper everybody begins at one place, Eq. (9).
    Cost: O(Z·log Z + N·Z) to grow, and O(N³) for each assignment.
    """
    reached = _reached_by_all(problem)
    best: tuple[float, Profile] | None = None
    compared = 0
    for centre in centres:
        places = _grow(problem.links, problem.rules, centre, reached, len(problem.candidates))
        if places is None:
            continue
        best = _Assignment.of(problem, places).improve(best)
        compared += 1
        if compared == _COMPARED:
            break
    return None if best is None else best[1]


def _reached_by_all(problem: RoundProblem) -> NDArray[np.bool_]:
    each = [np.isfinite(own.arrival_s).any(axis=0) for own in problem.candidates]
    reached: NDArray[np.bool_] = np.logical_and.reduce(each)
    return reached


def _grow(
    links: Links, rules: Rules, centre: int, reached: NDArray[np.bool_], count: int
) -> tuple[int, ...] | None:
    """Return as many admissible places around a centre; None if they can't be had."""
    offsets_m = links.locations_m - links.locations_m[centre]
    order = np.argsort((offsets_m * offsets_m).sum(axis=1), kind="stable")
    is_open = reached.copy()
    linked = np.zeros(len(links), dtype=np.int64)
    places: list[int] = []
    for taken in range(count):
        wanted = min(taken, 1 + rules.resilience)
        left = order[(is_open & (linked >= wanted))[order]]
        if not len(left):
            return None
        places.append(int(left[0]))
        is_open &= ~links.crowded(places[-1], rules.separation_m)
        linked[links.near(places[-1])] += 1
    return tuple(places) if is_admissible(links, rules, places) else None


@dataclass(frozen=True, slots=True)
class _Assignment:
    """Which agent goes to which of as many places; times count from r·T_c.

    Attributes:
        places: of the formation.
        since_s: per agent, [H, N] t at each place; +inf where inadmissible.
        gain_s: the same for δ − t.
    """

    places: tuple[int, ...]
    since_s: tuple[NDArray[np.float64], ...]
    gain_s: tuple[NDArray[np.float64], ...]

    @classmethod
    def of(cls, problem: RoundProblem, places: tuple[int, ...]) -> Self:
        """Return the agents' times at the places of a formation."""
        opens_s, _ = problem.window_s
        columns = list(places)
        since_s = [own.arrival_s[:, columns] - opens_s for own in problem.candidates]
        gain_s = [
            own.extra_s[:, columns] - np.where(np.isfinite(own_s), own_s, 0.0)
            for own, own_s in zip(problem.candidates, since_s, strict=True)
        ]
        return cls(places, tuple(since_s), tuple(gain_s))

    def improve(self, best: tuple[float, Profile] | None) -> tuple[float, Profile] | None:
        """Return the least potential and what attains it, if less than the best so far.

        For a bound τ on the arrivals, each agent has a cost at each place and the cheapest
        assignment has Φ = N·t_c + its cost; it serves all bounds down to its own t_c. So the bound
        falls from one t_c to the next until no earlier meeting can make up for the cost.
        """
        team = len(self.places)
        earliest_s = max(0.0, *(float(own_s.min()) for own_s in self.since_s))
        bound_s = np.inf
        while True:
            cost_s, profile, meeting_s = self._cheapest(bound_s)
            least_s = team * earliest_s + cost_s
            if least_s == np.inf or (best is not None and least_s >= best[0]):
                return best
            if best is None or team * meeting_s + cost_s < best[0]:
                best = team * meeting_s + cost_s, profile
            if meeting_s <= earliest_s:
                return best
            bound_s = np.nextafter(meeting_s, -np.inf)

    def _cheapest(self, bound_s: float) -> tuple[float, Profile, float]:
        """Return the cheapest assignment for t ≤ τ: its cost, itself and its t_c."""
        costs_s, rows = self._costs(bound_s)
        agents, columns = linear_sum_assignment(_comparable(costs_s))
        candidates = rows[agents, columns].tolist()
        times_s = [
            float(own_s[candidate, column])
            for own_s, candidate, column in zip(self.since_s, candidates, columns, strict=True)
        ]
        profile = Profile(
            location=tuple(self.places[column] for column in columns.tolist()),
            candidate=tuple(candidates),
        )
        return sum(costs_s[agents, columns].tolist()), profile, max(0.0, *times_s)

    def _costs(self, bound_s: float) -> tuple[NDArray[np.float64], NDArray[np.intp]]:
        """Return [N, N] the least δ − t of each agent at each place for t ≤ τ, and its rows."""
        rows, costs_s = [], []
        for since_s, gain_s in zip(self.since_s, self.gain_s, strict=True):
            in_time_s = np.where(since_s <= bound_s, gain_s, np.inf)
            rows.append(np.argmin(in_time_s, axis=0))
            costs_s.append(in_time_s.min(axis=0))
        return np.array(costs_s), np.array(rows)


def _comparable(costs_s: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return costs in whole units, [N, N]; more than all others where there is no way."""
    comparable: NDArray[np.float64] = np.rint(np.minimum(costs_s / _UNIT_S, _NEVER))
    return comparable
