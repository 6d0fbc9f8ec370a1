"""The optimum of Problem 2 with a certificate.

``MOST_AGENTS``    of how many agents it is found in reasonable time
``MOST_DECISIONS`` how many decisions on single agents are reasonable
``Share``          which part of the communication times to search
``Optimum``        the best team strategy found, and what is proven about it
``solve_exactly``  branch and bound over the communication time
"""

import heapq
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from itertools import pairwise
from typing import Final

import numpy as np
from numpy.typing import NDArray

from tlcomm_core.game.problem import Profile, RoundProblem
from tlcomm_core.game.search.adjustment import adjusted_places
from tlcomm_core.game.search.bounded_costs import BoundedCosts
from tlcomm_core.game.search.centre_bound import centre_bounds, reach
from tlcomm_core.game.search.limits import Limits, contested
from tlcomm_core.game.search.placement import cheapest_placement

__all__ = ["MOST_AGENTS", "MOST_DECISIONS", "WHOLE", "Optimum", "Share", "solve_exactly"]

MOST_AGENTS: Final = 10
"""Each further agent triples the time and doubles the memory."""

MOST_DECISIONS: Final = 100
"""How often a search decides on single agents, where rules forbid the cheapest placements, before
it leaves a gap: each decision only rules out a few of all placements."""

# Two sums of the same costs in different orders may differ by this much.
_ROUNDING_S: Final = 1e-7


# Neighbouring communication times have similar potentials: small pieces dealt out in turn make
# shares of equal promise.
_PIECES_PER_SHARE: Final = 4


@dataclass(frozen=True, slots=True)
class Share:
    """Which part of the communication times to search.

    Attributes:
        index: whose share, from 0.
        count: number of shares that together are the whole.
    """

    index: int
    count: int


WHOLE: Final = Share(0, 1)


@dataclass(frozen=True, slots=True)
class Optimum:
    """The best team strategy found.

    Attributes:
        profile: the team strategy.
        potential_s: its Φ.
        bound_s: no team strategy with a communication time in the share has a lower Φ than this;
            equal to ``potential_s`` but for rounding when the search ran to its end.
        placements: how many times the cheapest placement was computed.
    """

    profile: Profile
    potential_s: float
    bound_s: float
    placements: int

    @property
    def gap_s(self) -> float:
        """How much better another team strategy could be at the most."""
        return max(0.0, self.potential_s - self.bound_s)


def solve_exactly(
    problem: RoundProblem,
    start: Profile,
    share: Share = WHOLE,
    tolerance: float = 0.0,
    is_over: Callable[[], bool] = lambda: False,
    most_decisions: int = MOST_DECISIONS,
) -> Optimum:
    """Return the team strategy of least potential, or the best until interrupted.

    For a bound τ on the arrivals the problem falls apart: Φ = N·max(τ, r·T_c) + Σ_i c_i(z_i) with
    c_i(z) = min δ − t over the candidates h with t ≤ τ, and the cheapest connected placement for
    these costs is P(τ), which falls as τ rises. So N·τ_lower + P(τ_upper) bounds Φ from below for
    all τ of an interval. Intervals are taken the most promising first: a quick bound on P
    (``centre_bound``), then P itself at the upper end, then both halves, until no bound is left
    below the best potential found.

    Rules beside connectivity are left out of P, but that no link is shorter than the separation;
    so the bounds hold. Where P is attained by a placement that the rules forbid, the search goes on
    with one agent bound to its place there, and with that agent banned from it. Separations cost
    few such decisions, as a bound of single links already holds most of them; resilience costs many
    more, and then the search may end with a gap.

    Args:
        problem: a round of few agents: time and memory grow like 3^N and 2^N.
        start: an admissible team strategy, such as an equilibrium; the better, the faster.
        share: the part of the communication times to search; the least of all shares' results is
            the optimum, and the least of their bounds its certificate.
        tolerance: what is at most this share of Φ better isn't searched for, in [0, 1).
        is_over: asked before each step of the search; ends it early, with a gap.
        most_decisions: after so many on single agents it ends with a gap, too.

    Source: Problem 2 of the paper, Eq. (5) and (8).
    """
    search = _Search(problem, start, share, tolerance, most_decisions)
    while search.is_open and not is_over():
        search.branch()
    return search.optimum


@dataclass(order=True, slots=True)
class _Interval:
    """Communication times not yet ruled out, by their indices in the sorted arrivals.

    Attributes:
        bound_s: no Φ in it is less.
        first: index of its lower end.
        last: of its upper end.
        cost_s: P for the upper end, or less.
        limits: what it holds for.
        is_placed: whether its cost is that of a placement, for its upper end or a later time.
        dispute: an agent to decide on, with its place in a forbidden placement that attains P for
            the whole interval; None if there is none.
    """

    bound_s: float
    first: int
    last: int
    cost_s: float
    limits: Limits = field(compare=False)
    is_placed: bool = field(compare=False)
    dispute: tuple[int, int] | None = field(compare=False, default=None)


class _Search:
    """Branch and bound over the communication time; times count from r·T_c."""

    def __init__(
        self,
        problem: RoundProblem,
        start: Profile,
        share: Share,
        tolerance: float,
        most_decisions: int,
    ) -> None:
        self._decisions_left = most_decisions
        self._placements = _Placements(problem)
        self._times_s = self._placements.times_s
        self._team = len(problem.candidates)
        self._best = start
        self._best_s = self._placements.potential_s(start)
        self._wanted = 1.0 - tolerance
        self._count = 0
        self._open: list[_Interval] = []
        # The least bound of what was left out: with a tolerance, it may be below the best.
        self._left_out_s = np.inf
        if len(self._times_s):
            self._measure(0, len(self._times_s) - 1, Limits())
        if share.count > 1:
            self._keep(share)

    @property
    def is_open(self) -> bool:
        """Whether something better may still be found."""
        if not self._open or self._open[0].bound_s >= self._wanted_s:
            return False
        return self._open[0].dispute is None or self._decisions_left > 0

    @property
    def optimum(self) -> Optimum:
        """What is known now."""
        open_s = self._open[0].bound_s if self._open else np.inf
        bound_s = min(self._best_s, open_s, self._left_out_s)
        return Optimum(self._best, self._best_s, bound_s, self._count)

    def branch(self) -> None:
        """Look closer at the most promising interval."""
        interval = heapq.heappop(self._open)
        last = self._last_of_use(interval)
        if last < interval.first:
            return
        if interval.dispute is not None:
            self._decisions_left -= 1
            for limits in interval.limits.decide(*interval.dispute):
                self._examine(interval.first, last, limits)
        elif interval.is_placed and interval.first < last:
            self._halve(interval, last)
        else:
            self._examine(interval.first, last, interval.limits)

    @property
    def _wanted_s(self) -> float:
        """What a bound must be below to be of interest."""
        return self._best_s * self._wanted - _ROUNDING_S

    def _halve(self, interval: _Interval, last: int) -> None:
        first, times_s = interval.first, self._times_s
        middle_s = (times_s[first] + times_s[last]) / 2.0
        middle = int(np.searchsorted(times_s, middle_s, side="right")) - 1
        self._measure(first, middle, interval.limits)
        if middle < last:
            self._push(middle + 1, last, interval.cost_s, interval.limits, is_placed=True)

    def _keep(self, share: Share) -> None:
        """Leave only this share of all that is open."""
        times_s = self._times_s
        whole, self._open = self._open, []
        for interval in whole:
            beyond = self._last_of_use(interval) + 1
            pieces = share.count * _PIECES_PER_SHARE
            ends_s = np.linspace(times_s[interval.first], times_s[beyond - 1], pieces + 1)
            cuts = np.searchsorted(times_s, ends_s[1:-1]).tolist()
            spans = list(pairwise([interval.first, *cuts, beyond]))
            for first, following in spans[share.index :: share.count]:
                if first < following:
                    self._measure(first, following - 1, interval.limits)

    def _last_of_use(self, interval: _Interval) -> int:
        """Return the last time of an interval at which the best one found can be beaten."""
        latest_s = (self._wanted_s - interval.cost_s) / self._team
        last = min(interval.last, int(np.searchsorted(self._times_s, latest_s)) - 1)
        if last < interval.last:
            following_s = float(self._team * self._times_s[last + 1] + interval.cost_s)
            self._left_out_s = min(self._left_out_s, following_s)
        return last

    def _measure(self, first: int, last: int, limits: Limits) -> None:
        """Find a quick bound for an interval."""
        cost_s = self._placements.bound(self._times_s[last], limits)
        self._push(first, last, cost_s, limits, is_placed=False)

    def _examine(self, first: int, last: int, limits: Limits) -> None:
        """Compute the cheapest placement for the interval's upper end."""
        self._count += 1
        room_s = self._best_s - self._team * self._times_s[first]
        cost_s, profile = self._placements.cheapest(self._times_s[last], room_s, limits)
        if profile is None:
            return
        # The same placement serves every bound from its own latest arrival on.
        meeting_s = self._placements.meeting_s(profile)
        own = int(np.clip(np.searchsorted(self._times_s, meeting_s), first, last))
        adjusted = self._placements.adjusted(profile, self._times_s[last])
        if adjusted is not None:
            self._take(adjusted)
        if adjusted != profile:
            agent = self._placements.contested(profile, limits)
            if agent is not None:
                dispute = (agent, profile.location[agent])
                self._push(own, last, cost_s, limits, is_placed=True, dispute=dispute)
        if own > first:
            self._push(first, own - 1, cost_s, limits, is_placed=True)

    def _take(self, profile: Profile) -> None:
        """Keep an admissible team strategy if it is the best so far."""
        potential_s = self._placements.potential_s(profile)
        if potential_s < self._best_s:
            self._best, self._best_s = profile, potential_s

    def _push(
        self,
        first: int,
        last: int,
        cost_s: float,
        limits: Limits,
        *,
        is_placed: bool,
        dispute: tuple[int, int] | None = None,
    ) -> None:
        bound_s = float(self._team * self._times_s[first] + cost_s)
        if bound_s < self._wanted_s:
            interval = _Interval(bound_s, first, last, cost_s, limits, is_placed, dispute)
            heapq.heappush(self._open, interval)
        else:
            self._left_out_s = min(self._left_out_s, bound_s)


class _Placements:
    """The cheapest placements for bounded arrivals; times count from r·T_c.

    Attributes:
        times_s: the arrivals that may be the communication time, ascending; the first is the
            earliest time at which everybody can be anywhere.
    """

    def __init__(self, problem: RoundProblem) -> None:
        self._problem = problem
        self._costs = BoundedCosts(problem)
        self._neighbourhood = problem.links.neighbourhood_apart(problem.rules.separation_m)
        self.times_s = self._costs.times_s()

    def bound(self, latest_s: float, limits: Limits) -> float:
        """Return a bound on P(τ) from below that is quick to find."""
        return float(centre_bounds(self._at(latest_s, limits), self._neighbourhood).min())

    def cheapest(
        self, latest_s: float, room_s: float, limits: Limits
    ) -> tuple[float, Profile | None]:
        """Return P(τ) for a bound τ and what attains it, if P(τ) is less than ``room_s``."""
        costs_s = self._at(latest_s, limits)
        is_centre = centre_bounds(costs_s, self._neighbourhood) < room_s
        inside = reach(is_centre, len(costs_s), self._neighbourhood)
        kept = np.flatnonzero(inside & np.isfinite(costs_s).any(axis=0))
        if not len(kept):
            return np.inf, None
        placement = cheapest_placement(costs_s[:, kept], self._neighbourhood.among(kept))
        if not placement.cost < room_s:
            return np.inf, None
        locations = kept[list(placement.locations)].tolist()
        return placement.cost, self._costs.profile(locations, latest_s)

    def adjusted(self, profile: Profile, latest_s: float) -> Profile | None:
        """Return a placement that the rules allow, near to one that they needn't, if one is found.

        It is the same if they do.
        """
        wanted = profile.location
        costs_s = self._costs.at(latest_s)
        places = adjusted_places(self._problem, costs_s, wanted, self._order(wanted))
        return None if places is None else self._costs.profile(places, latest_s)

    def _order(self, places: Sequence[int]) -> list[int]:
        """Return the agents of a connected placement, each but the first linked to one before."""
        order = [0]
        for agent in order:
            near = self._problem.links.near(places[agent]).tolist()
            order += [
                other for other, place in enumerate(places) if place in near and other not in order
            ]
        return order

    def contested(self, profile: Profile, limits: Limits) -> int | None:
        """Return the agent to decide on in a forbidden placement; None if all are decided on."""
        return contested(self._problem.links, self._problem.rules, profile.location, limits)

    def potential_s(self, profile: Profile) -> float:
        """Return Φ."""
        return self._costs.potential_s(profile)

    def meeting_s(self, profile: Profile) -> float:
        """Return t_c."""
        return self._costs.meeting_s(profile)

    def _at(self, latest_s: float, limits: Limits) -> NDArray[np.float64]:
        """Return c_i(z; τ) within the limits, [N, Z]."""
        rules, links = self._problem.rules, self._problem.links
        return limits.applied(self._costs.at(latest_s), links, rules.separation_m)
