"""A team spread over places around a common centre, where sharing one place isn't allowed.

``cheapest_formation``  the cheapest of the formations around some centres
"""

import heapq
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import islice
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
    reached, team = _reached_by_all(problem), len(problem.candidates)
    grown = (_grow(problem.links, problem.rules, centre, reached, team) for centre in centres)
    formations = islice((places for places in grown if places is not None), _COMPARED)
    search = _Search()
    for places in formations:
        search.add(_Formation.of(problem, places))
    return search.least()


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


class _Search:
    """Branch and bound over formations and bounds τ on the arrivals; times count from r·T_c.

    For a bound τ each agent has a cost at each place of a formation, and the cheapest assignment
    has Φ = N·t_c + its cost, which rises as τ falls. So it serves all bounds down to its own t_c,
    and bounds Φ for all below.
    """

    def __init__(self) -> None:
        self._formations: list[_Formation] = []
        # Bound on Φ, index of the formation, and the interval of τ that it holds for.
        self._open: list[tuple[float, int, float, float]] = []

    def add(self, formation: "_Formation") -> None:
        """Take in a formation."""
        earliest_s = formation.earliest_s
        if earliest_s < np.inf:
            entry = (-np.inf, len(self._formations), earliest_s, np.inf)
            heapq.heappush(self._open, entry)
        self._formations.append(formation)

    def least(self) -> Profile | None:
        """Return the cheapest assignment of all."""
        best_s, best = np.inf, None
        while self._open and self._open[0][0] < best_s:
            _, index, low_s, high_s = heapq.heappop(self._open)
            formation = self._formations[index]
            cost_s, meeting_s, profile = formation.assign(high_s)
            if formation.team * meeting_s + cost_s < best_s:
                best_s, best = formation.team * meeting_s + cost_s, profile
            middle_s = (low_s + meeting_s) / 2.0
            if low_s < middle_s < meeting_s:
                below_s = np.nextafter(meeting_s, -np.inf)
                self._push(index, low_s, middle_s, cost_s)
                self._push(index, np.nextafter(middle_s, np.inf), below_s, cost_s)
        return best

    def _push(self, index: int, low_s: float, high_s: float, cost_s: float) -> None:
        bound_s = self._formations[index].team * low_s + cost_s
        if bound_s < np.inf:
            heapq.heappush(self._open, (bound_s, index, low_s, high_s))


@dataclass(frozen=True, slots=True)
class _Formation:
    """As many places as agents, and what the agents need there; times count from r·T_c.

    Attributes:
        places: the places.
        since_s: [N, H, N] t of each agent, candidate and place; +inf where inadmissible.
        gain_s: the same for δ − t.
    """

    places: tuple[int, ...]
    since_s: NDArray[np.float64]
    gain_s: NDArray[np.float64]

    @classmethod
    def of(cls, problem: RoundProblem, places: tuple[int, ...]) -> Self:
        """Return the agents' times at the places."""
        opens_s, _ = problem.window_s
        columns = list(places)
        rows = max(len(own.task_index) for own in problem.candidates)
        since_s = np.full((len(places), rows, len(places)), np.inf)
        gain_s = since_s.copy()
        for agent, own in enumerate(problem.candidates):
            arrival_s = own.arrival_s[:, columns] - opens_s
            since_s[agent, : len(arrival_s)] = arrival_s
            gain_s[agent, : len(arrival_s)] = own.extra_s[:, columns] - np.where(
                np.isfinite(arrival_s), arrival_s, 0.0
            )
        return cls(places, since_s, gain_s)

    @property
    def team(self) -> int:
        """N."""
        return len(self.places)

    @property
    def earliest_s(self) -> float:
        """When everybody can be anywhere, not before the window opens."""
        return max(0.0, float(self.since_s.min(axis=(1, 2)).max()))

    def assign(self, bound_s: float) -> tuple[float, float, Profile]:
        """Return the cheapest assignment for t ≤ τ: its cost, its t_c and itself.

        Both are +inf, and the profile means nothing, if there is none.
        """
        in_time_s = np.where(self.since_s <= bound_s, self.gain_s, np.inf)
        agents, columns = linear_sum_assignment(_comparable(in_time_s.min(axis=1)))
        candidates = in_time_s.argmin(axis=1)[agents, columns]
        profile = Profile(
            location=tuple(self.places[column] for column in columns.tolist()),
            candidate=tuple(candidates.tolist()),
        )
        cost_s = sum(in_time_s[agents, candidates, columns].tolist())
        meeting_s = float(self.since_s[agents, candidates, columns].max())
        return cost_s, max(0.0, meeting_s) if cost_s < np.inf else np.inf, profile


def _comparable(costs_s: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return costs in whole units, [N, N]; more than all others where there is no way."""
    comparable: NDArray[np.float64] = np.rint(np.minimum(costs_s / _UNIT_S, _NEVER))
    return comparable
