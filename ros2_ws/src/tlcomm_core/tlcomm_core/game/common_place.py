"""The cheapest place for everybody to meet at, chosen exactly.

``cheapest_common_place``  the least potential over all common places and admissible times
"""

from dataclasses import dataclass
from itertools import pairwise
from typing import Final

import numpy as np
from numpy.typing import NDArray

from tlcomm_core.game.problem import Profile, RoundProblem

__all__ = ["cheapest_common_place"]

# Intervals of the window, each with a bound of its own: so many that few places are left over.
_INTERVALS: Final = 64
# A lower bound and the sum that it bounds are added up in different orders.
_BOUND_TOLERANCE_S: Final = 1e-6


def cheapest_common_place(problem: RoundProblem) -> Profile | None:
    """Return the common place and the candidates of least potential.

    Among equal potentials the lowest place wins, there the earliest communication time, then each
    agent's lowest candidate. The arithmetic is elementary, so equal inputs give equal outcomes on
    every machine.

    Args:
        problem: at least one agent.

    Returns:
        A team strategy with one location for all; None if no place is admissible for all.

    Source: Eq. (9) and "Optimization of Initial Strategy" in Section IV-B3 of the paper. For a
        place z and a bound τ on the arrivals, the best h of agent i is the one with t ≤ τ and the
        least δ − t, and Φ = N·max(τ, r·T_c) + Σ_i min(δ − t); the least over all arrivals τ is
        exact.
    Cost: O(N·H·Z + N·I·Z) for bounds on I intervals of τ at each place, then O(N·H) for each of
        the intervals that these leave.
    """
    opens_s, closes_s = problem.window_s
    edges_s = np.linspace(0.0, closes_s - opens_s, _INTERVALS + 1)
    bounds = _Bounds(problem, edges_s)
    least_s = float(bounds.attained_s.min())
    if not np.isfinite(least_s):
        return None
    interval, place = np.nonzero(bounds.bound_s <= least_s + _BOUND_TOLERANCE_S)
    bound_s = bounds.bound_s[interval, place]
    places, slot = np.unique(place, return_inverse=True)
    tables = _Tables(problem, places)
    best = _Meeting(np.inf, 0, 0.0)
    for left in np.argsort(bound_s, kind="stable").tolist():
        if bound_s[left] > best.potential_s + _BOUND_TOLERANCE_S:
            break
        first_s, last_s = edges_s[interval[left] : interval[left] + 2].tolist()
        best = min(best, tables.cheapest(int(slot[left]), first_s, last_s))
    return Profile(
        location=(int(places[best.slot]),) * len(problem.agents),
        candidate=tables.best_candidates(best),
    )


@dataclass(order=True, frozen=True, slots=True)
class _Meeting:
    """A meeting of all at one place, with its Φ; the best is the least.

    Attributes:
        potential_s: Φ.
        slot: which of the places left over, which are in ascending order.
        latest_s: τ.
    """

    potential_s: float
    slot: int
    latest_s: float


class _Bounds:
    """Bounds on Φ at each place for each of I intervals of τ; times count from r·T_c.

    Attributes:
        bound_s: [I, Z] no τ of the interval, ends included, has a lower Φ.
        attained_s: [I, Z] Φ for the upper end; +inf where somebody can't be by then.
    """

    def __init__(self, problem: RoundProblem, edges_s: NDArray[np.float64]) -> None:
        self._edges_s = edges_s[:, None]
        shape = (len(edges_s) - 1, len(problem.locations_m))
        self.bound_s = np.zeros(shape)
        self.attained_s = np.zeros(shape)
        # Written over for each agent: fresh memory would cost more than the sums.
        self._gain_s = np.empty((len(edges_s), shape[1]))
        self._extra_s = np.empty_like(self._gain_s)
        opens_s, _ = problem.window_s
        for own in problem.candidates:
            self._sort(own.arrival_s - opens_s, own.extra_s)
            self._add()
        self.attained_s += len(problem.candidates) * self._edges_s[1:]

    def _sort(self, since_s: NDArray[np.float64], extra_s: NDArray[np.float64]) -> None:
        """Keep the least δ − t and the least δ of an agent in each interval at each place.

        What is there when the window opens comes before the intervals.
        """
        count, places = self._gain_s.shape
        closes_s = float(self._edges_s[-1, 0])
        finite_s = np.minimum(since_s, closes_s)
        row = np.maximum(np.ceil(finite_s * ((count - 1) / closes_s)), 0.0).astype(np.intp)
        cell = row * places + np.arange(places)
        gain_s = extra_s - finite_s
        for least_s, values_s in ((self._gain_s, gain_s), (self._extra_s, extra_s)):
            least_s.fill(np.inf)
            flat_s = least_s.reshape(-1)
            # No two of a candidate's entries share a cell.
            for cells, candidate_s in zip(cell, values_s, strict=True):
                flat_s[cells] = np.minimum(flat_s[cells], candidate_s)

    def _add(self) -> None:
        """Add what the agent adds to Φ.

        For any τ of an interval it waits from the lower end on, with a candidate before that, or
        has at least the detour of one in it.
        """
        for before_s, here_s in pairwise(self._gain_s):
            np.minimum(before_s, here_s, out=here_s)
        self.attained_s += self._gain_s[1:]
        added_s = self._gain_s[:-1]
        added_s += self._edges_s[:-1]
        np.minimum(added_s, self._extra_s[1:], out=added_s)
        self.bound_s += added_s


class _Tables:
    """All agents' candidates at each of P places, K = Σ_i H_i in all; times count from r·T_c."""

    def __init__(self, problem: RoundProblem, places: NDArray[np.intp]) -> None:
        opens_s, closes_s = problem.window_s
        heights = [len(own.task_index) for own in problem.candidates]
        self._owner = np.repeat(np.arange(len(heights)), heights)
        self._starts = np.cumsum([0, *heights[:-1]])
        # [P, K] t and δ − t; +inf where inadmissible.
        self._since_s = _columns([own.arrival_s for own in problem.candidates], places) - opens_s
        extra_s = _columns([own.extra_s for own in problem.candidates], places)
        self._gain_s = extra_s - np.minimum(self._since_s, closes_s - opens_s)

    def cheapest(self, slot: int, first_s: float, last_s: float) -> _Meeting:
        """Return the cheapest meeting at a place for the τ of an interval, the earliest of equals.

        The bound τ rises from the lower end over the arrivals that better an agent's best
        candidate, while each agent keeps the best so far.
        """
        since_s, gain_s = self._since_s[slot], self._gain_s[slot]
        early_s = np.where(since_s <= first_s, gain_s, np.inf)
        least_s = np.minimum.reduceat(early_s, self._starts)
        is_better = (since_s > first_s) & (since_s <= last_s) & (gain_s < least_s[self._owner])
        later = np.flatnonzero(is_better)
        later = later[np.argsort(since_s[later], kind="stable")]
        latest_s = np.append(first_s, since_s[later])
        # One row for N·τ and one for each agent; added up in this order on every machine.
        parts_s = np.full((len(least_s) + 1, len(latest_s)), np.inf)
        parts_s[0] = len(least_s) * latest_s
        parts_s[1:, 0] = least_s
        parts_s[1 + self._owner[later], np.arange(1, len(latest_s))] = gain_s[later]
        np.minimum.accumulate(parts_s[1:], axis=1, out=parts_s[1:])
        potential_s = np.add.accumulate(parts_s, axis=0)[-1]
        best = int(np.argmin(potential_s))
        return _Meeting(float(potential_s[best]), slot, float(latest_s[best]))

    def best_candidates(self, meeting: _Meeting) -> tuple[int, ...]:
        """Return each agent's candidate at a place that arrives by τ with the least δ − t."""
        in_time = self._since_s[meeting.slot] <= meeting.latest_s
        gain_s = np.where(in_time, self._gain_s[meeting.slot], np.inf)
        return tuple(int(np.argmin(own_s)) for own_s in np.split(gain_s, self._starts[1:]))


def _columns(tables_s: list[NDArray[np.float64]], places: NDArray[np.intp]) -> NDArray[np.float64]:
    """Return some places' entries of all tables, [P, K]."""
    return np.concatenate([table_s[:, places].T for table_s in tables_s], axis=1)
