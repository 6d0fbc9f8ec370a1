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

from tlcomm_core.game.adjustment import adjusted_places
from tlcomm_core.game.bounded_costs import BoundedCosts
from tlcomm_core.game.limits import Limits, contested
from tlcomm_core.game.placement import cheapest_placement
from tlcomm_core.game.problem import Profile, RoundProblem

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
    is_over: Callable[[], bool] = lambda: False,
    most_decisions: int = MOST_DECISIONS,
) -> Optimum:
    """Return the team strategy of least potential, or the best until interrupted.

    For a bound τ on the arrivals the problem falls apart: Φ = N·max(τ, r·T_c) + Σ_i c_i(z_i) with
    c_i(z) = min δ − t over the candidates h with t ≤ τ, and the cheapest connected placement for
    these costs is P(τ), which falls as τ rises. So N·τ_lower + P(τ_upper) bounds Φ from below for
    all τ of an interval; intervals are halved, the most promising first, until no bound is left
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
        is_over: asked before each step of the search; ends it early, with a gap.
        most_decisions: after so many on single agents it ends with a gap, too.

    Source: Problem 2 of the paper, Eq. (5) and (8).
    """
    search = _Search(problem, start, share, most_decisions)
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
        placement_s: P for the upper end, or less.
        limits: what it holds for.
        dispute: an agent to decide on, with its place in a forbidden placement that attains P for
            the whole interval; None if it is to be halved.
    """

    bound_s: float
    first: int
    last: int
    placement_s: float
    limits: Limits = field(compare=False)
    dispute: tuple[int, int] | None = field(compare=False)

    @property
    def origin(self) -> tuple[float, Limits, tuple[int, int] | None]:
        """What a part of it shares with it."""
        return self.placement_s, self.limits, self.dispute


class _Search:
    """Branch and bound over the communication time; times count from r·T_c."""

    def __init__(
        self, problem: RoundProblem, start: Profile, share: Share, most_decisions: int
    ) -> None:
        self._decisions_left = most_decisions
        self._costs = _Costs(problem)
        self._best = start
        self._best_s = self._costs.potential_s(start)
        self._placements = 0
        self._open: list[_Interval] = []
        last = len(self._costs.times_s) - 1
        if last >= 0:
            self._examine(0, last, Limits())
        if share.count > 1:
            self._keep(share)

    @property
    def is_open(self) -> bool:
        """Whether something better may still be found."""
        if not self._open or self._open[0].bound_s >= self._best_s - _ROUNDING_S:
            return False
        return self._open[0].dispute is None or self._decisions_left > 0

    @property
    def optimum(self) -> Optimum:
        """What is known now."""
        bound_s = min(self._best_s, self._open[0].bound_s) if self._open else self._best_s
        return Optimum(self._best, self._best_s, bound_s, self._placements)

    def branch(self) -> None:
        """Halve the most promising interval, or decide on an agent there."""
        interval = heapq.heappop(self._open)
        times_s = self._costs.times_s
        last = self._last_of_use(interval)
        if last < interval.first:
            return
        if interval.dispute is not None:
            self._decisions_left -= 1
            for limits in interval.limits.decide(*interval.dispute):
                self._examine(interval.first, last, limits)
            return
        middle_s = (times_s[interval.first] + times_s[last]) / 2.0
        middle = int(np.searchsorted(times_s, middle_s, side="right")) - 1
        self._examine(interval.first, middle, interval.limits)
        if middle < last:
            self._push(middle + 1, last, interval.placement_s, interval.limits)

    def _keep(self, share: Share) -> None:
        """Leave only this share of all that is open."""
        times_s = self._costs.times_s
        whole, self._open = self._open, []
        for interval in whole:
            beyond = self._last_of_use(interval) + 1
            pieces = share.count * _PIECES_PER_SHARE
            ends_s = np.linspace(times_s[interval.first], times_s[beyond - 1], pieces + 1)
            cuts = np.searchsorted(times_s, ends_s[1:-1]).tolist()
            spans = list(pairwise([interval.first, *cuts, beyond]))
            for first, following in spans[share.index :: share.count]:
                if first < following:
                    self._push(first, following - 1, *interval.origin)

    def _last_of_use(self, interval: _Interval) -> int:
        """Return the last time of an interval at which the best one found can be beaten."""
        room_s = self._best_s - _ROUNDING_S - interval.placement_s
        latest = int(np.searchsorted(self._costs.times_s, room_s / self._costs.team))
        return min(interval.last, latest - 1)

    def _examine(self, first: int, last: int, limits: Limits) -> None:
        """Compute the cheapest placement for the interval's upper end."""
        times_s, team = self._costs.times_s, self._costs.team
        self._placements += 1
        room_s = self._best_s - team * times_s[first]
        placement_s, profile = self._costs.placement(times_s[last], room_s, limits)
        if profile is None:
            return
        # The same placement serves every bound from its own latest arrival on.
        own = max(first, int(np.searchsorted(times_s, self._costs.meeting_s(profile))))
        adjusted = self._costs.adjusted(profile, times_s[last])
        if adjusted is not None:
            self._take(adjusted)
        if adjusted != profile and (agent := self._costs.contested(profile, limits)) is not None:
            self._push(own, last, placement_s, limits, (agent, profile.location[agent]))
        if own > first:
            self._push(first, own - 1, placement_s, limits)

    def _take(self, profile: Profile) -> None:
        """Keep an admissible team strategy if it is the best so far."""
        potential_s = self._costs.potential_s(profile)
        if potential_s < self._best_s:
            self._best, self._best_s = profile, potential_s

    def _push(
        self,
        first: int,
        last: int,
        placement_s: float,
        limits: Limits,
        dispute: tuple[int, int] | None = None,
    ) -> None:
        bound_s = float(self._costs.team * self._costs.times_s[first] + placement_s)
        if bound_s < self._best_s - _ROUNDING_S:
            interval = _Interval(bound_s, first, last, placement_s, limits, dispute)
            heapq.heappush(self._open, interval)


class _Costs:
    """The agents' costs for bounded arrivals; times count from r·T_c.

    Attributes:
        team: N.
        times_s: the arrivals that may be the communication time, ascending; the first is the
            earliest time at which everybody can be anywhere.
    """

    def __init__(self, problem: RoundProblem) -> None:
        self._problem = problem
        self._bounded = BoundedCosts(problem)
        self._neighbourhood = problem.links.neighbourhood_apart(problem.rules.separation_m)
        self.team = self._bounded.team
        opens_s, _ = problem.window_s
        since_s = np.concatenate([own.arrival_s.ravel() for own in problem.candidates]) - opens_s
        earliest_s = self._bounded.earliest_s
        later_s = since_s[np.isfinite(since_s) & (since_s > earliest_s)]
        self.times_s = np.unique(np.append(later_s, earliest_s))

    def placement(
        self, latest_s: float, room_s: float, limits: Limits
    ) -> tuple[float, Profile | None]:
        """Return P(τ) for a bound τ and what attains it, if P(τ) is less than ``room_s``."""
        links, separation_m = self._problem.links, self._problem.rules.separation_m
        costs_s = limits.applied(self._bounded.at(latest_s), links, separation_m)
        least_s = costs_s.min(axis=1)
        if not np.isfinite(least_s).all():
            return np.inf, None
        costs_s[costs_s - least_s[:, None] >= room_s - least_s.sum()] = np.inf
        kept = np.flatnonzero(np.isfinite(costs_s).any(axis=0))
        if not len(kept):
            return np.inf, None
        placement = cheapest_placement(costs_s[:, kept], self._neighbourhood.among(kept))
        if not placement.cost < room_s:
            return np.inf, None
        locations = kept[list(placement.locations)].tolist()
        return placement.cost, self._bounded.profile(locations, latest_s)

    def adjusted(self, profile: Profile, latest_s: float) -> Profile | None:
        """Return a placement that the rules allow, near to one that they needn't, if one is found.

        It is the same if they do.
        """
        wanted = profile.location
        costs_s = self._bounded.at(latest_s)
        places = adjusted_places(self._problem, costs_s, wanted, self._order(wanted))
        return None if places is None else self._bounded.profile(places, latest_s)

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
        return self._bounded.potential_s(profile)

    def meeting_s(self, profile: Profile) -> float:
        """Return t_c."""
        return self._bounded.meeting_s(profile)
