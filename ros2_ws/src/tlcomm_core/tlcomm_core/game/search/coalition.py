"""Near-optimal team strategies of teams of any size.

``propose``  what one agent proposes to its team

For a bound τ on the arrivals, the cheapest connected placement is wanted (``bounded_costs``). A
spanning tree of the meeting graph gives one (``tree_programme``). The tree is improved by joining
parts of it elsewhere (``reattachment``) and small coalitions anew (``regrouping``). Bounds are
searched as for the optimum (``exact``), the most promising first; but what a tree costs takes the
place of what any placement must cost, so that nothing is proven.

Each agent has bounds of its own, so that a larger team searches more finely. Work is counted, not
timed: a proposal is a function of the round alone.
"""

import heapq
from collections.abc import Iterable
from dataclasses import dataclass, field
from itertools import pairwise
from typing import Final

import numpy as np

from tlcomm_core.game.best_response import Scope, best_response
from tlcomm_core.game.links import Neighbourhood
from tlcomm_core.game.problem import Profile, RoundProblem
from tlcomm_core.game.search.adjustment import adjusted_places
from tlcomm_core.game.search.bounded_costs import BoundedCosts
from tlcomm_core.game.search.reattachment import reattach
from tlcomm_core.game.search.regrouping import regroup
from tlcomm_core.game.search.spanning_tree import Edge, grown_tree
from tlcomm_core.game.search.tree_programme import TreeProgramme

__all__ = ["propose"]

# Times nearer than this are one.
_RESOLUTION_S: Final = 1e-6


@dataclass(frozen=True, slots=True)
class _Effort:
    """How much work is put into a part of the search.

    Attributes:
        halvings: of intervals, at the most.
        size: members of a coalition; 1 for no coalitions.
    """

    halvings: int
    size: int


@dataclass(frozen=True, slots=True)
class _Plan:
    """How an agent searches.

    Attributes:
        parts: of its share of the window, whose bounds are glanced at.
        glance: at these.
        finalists: of them, how many are looked at closely.
        close_look: at these.
    """

    parts: int
    glance: _Effort
    finalists: int
    close_look: _Effort


# A coalition of everybody, which is the best for its bound, is what few enough agents can afford.
_WHOLE_TEAM: Final = _Plan(parts=8, glance=_Effort(6, 1), finalists=3, close_look=_Effort(2, 8))
# A large team tries many bounds, however few each of its agents does.
_TEAM_PARTS: Final = 300
_LEAST_PARTS: Final = 2


def propose(problem: RoundProblem, start: Profile, searcher: int) -> Profile:
    """Return a team strategy that no agent wants to leave alone, and no worse than a given one.

    Args:
        problem: the round.
        start: an admissible team strategy.
        searcher: index of the agent that searches.

    Source: beyond the paper; its Problem 2 and Eq. (5) and (8).
    Cost: O(N·H·Z + N²·Z·log N·D) for each of a fixed number of bounds; O(N·Z) memory beside the
        candidates.
    """
    costs = BoundedCosts(problem)
    neighbourhood = problem.links.neighbourhood_apart(problem.rules.separation_m)
    rng = np.random.default_rng((problem.round, searcher))
    plan = _plan(costs.team)
    glance = _Search(problem, costs, neighbourhood, plan.glance, rng)
    glance.run(_share(problem, costs, searcher, plan.parts))
    close_look = _Search(problem, costs, neighbourhood, plan.close_look, rng)
    close_look.run(trial.interval for trial in heapq.nsmallest(plan.finalists, glance.trials))
    found = (trial.profile for trial in close_look.trials)
    return settled(problem, min((start, *found), key=costs.potential_s))


def _plan(team: int) -> _Plan:
    """Return how an agent of a team of this size searches."""
    if team <= _WHOLE_TEAM.close_look.size:
        return _WHOLE_TEAM
    parts = max(_LEAST_PARTS, min(_WHOLE_TEAM.parts, _TEAM_PARTS // team))
    return _Plan(
        parts=parts,
        glance=_Effort(parts // 2, 1),
        finalists=max(1, parts // 4),
        close_look=_Effort(1, 5),
    )


def settled(problem: RoundProblem, profile: Profile) -> Profile:
    """Return the equilibrium that agents reach who respond in turns, each to those before.

    Args:
        problem: the round.
        profile: an admissible team strategy.
    """
    team = len(problem.candidates)
    strategies = list(problem.strategies(profile))
    content, agent = 0, 0
    while content < team:
        others = strategies[:agent] + strategies[agent + 1 :]
        response = best_response(problem, agent, profile.choice(agent), others, Scope.EVERYWHERE)
        content += 1
        if response.change_s < 0.0:
            content = 1
            profile = profile.switched(agent, response.choice)
            strategies[agent] = problem.strategy(agent, response.location, response.candidate)
        agent = (agent + 1) % team
    return profile


@dataclass(order=True, frozen=True, slots=True)
class _Interval:
    """Bounds not tried yet.

    Attributes:
        estimate_s: what a team strategy might cost for one of them.
        first_s: later than this.
        last_s: not later than this.
        cost_s: what the placement costs for a later bound.
        edges: the tree for it; ``None`` if none has been found.
    """

    estimate_s: float
    first_s: float
    last_s: float
    cost_s: float = field(compare=False, default=-np.inf)
    edges: tuple[Edge, ...] | None = field(compare=False, default=None)


@dataclass(order=True, frozen=True, slots=True)
class _Trial:
    """A team strategy found for the upper end of an interval, with its Φ."""

    potential_s: float
    interval: _Interval
    profile: Profile = field(compare=False)


class _Search:
    """A search over bounds; times count from r·T_c.

    Attributes:
        trials: what was found.
    """

    def __init__(
        self,
        problem: RoundProblem,
        costs: BoundedCosts,
        neighbourhood: Neighbourhood,
        effort: _Effort,
        rng: np.random.Generator,
    ) -> None:
        self.trials: list[_Trial] = []
        self._problem = problem
        self._costs = costs
        self._neighbourhood = neighbourhood
        self._effort = effort
        self._rng = rng
        self._open: list[_Interval] = []
        self._best_s = np.inf

    def run(self, intervals: Iterable[_Interval]) -> None:
        """Try the upper ends of some intervals, then halve the most promising ones."""
        for interval in intervals:
            self._try(interval)
        for _ in range(self._effort.halvings):
            if not self._open or self._open[0].estimate_s >= self._best_s:
                break
            self._halve(heapq.heappop(self._open))

    def _halve(self, whole: _Interval) -> None:
        middle_s = (whole.first_s + whole.last_s) / 2.0
        self._try(self._interval(whole.first_s, middle_s, whole.cost_s, whole.edges))
        self._leave_open(self._interval(middle_s, whole.last_s, whole.cost_s, whole.edges))

    def _try(self, interval: _Interval) -> None:
        """Improve the tree for the upper end; what is before its last arrival stays open."""
        programme = self._programme(interval)
        if programme is None:
            return
        programme = reattach(programme, self._neighbourhood)
        if self._effort.size > 1:
            programme = regroup(programme, self._neighbourhood, self._effort.size, self._rng)
        cost_s, edges, locations = programme.cost(), programme.edges, programme.locations()
        tried = self._interval(interval.first_s, interval.last_s, cost_s, edges)
        earlier_s = self._costs.meeting_s(self._costs.profile(locations, tried.last_s))
        self._leave_open(self._interval(tried.first_s, earlier_s - _RESOLUTION_S, cost_s, edges))
        places = adjusted_places(self._problem, programme.costs, locations, programme.order)
        if places is not None:
            profile = self._costs.profile(places, tried.last_s)
            potential_s = self._costs.potential_s(profile)
            self._best_s = min(self._best_s, potential_s)
            self.trials.append(_Trial(potential_s, tried, profile))

    def _programme(self, interval: _Interval) -> TreeProgramme | None:
        """Return the programme for the upper end, if there is one, with the tree at hand."""
        costs = self._costs.at(interval.last_s)
        edges = interval.edges
        if edges is None:
            common = int(np.argmin(costs.sum(axis=0)))
            edges = grown_tree(costs, self._neighbourhood, common)
        if edges is None:
            return None
        programme = TreeProgramme(costs, self._neighbourhood, edges)
        return programme if np.isfinite(programme.cost()) else None

    def _interval(
        self, first_s: float, last_s: float, cost_s: float, edges: tuple[Edge, ...] | None
    ) -> _Interval:
        estimate_s = self._costs.team * first_s + cost_s
        return _Interval(estimate_s, first_s, last_s, cost_s, edges)

    def _leave_open(self, interval: _Interval) -> None:
        if interval.last_s > interval.first_s + _RESOLUTION_S:
            heapq.heappush(self._open, interval)


def _share(
    problem: RoundProblem, costs: BoundedCosts, searcher: int, parts: int
) -> list[_Interval]:
    """Return an agent's share of the window: of all agents' parts, equally long, every N-th."""
    opens_s, closes_s = problem.window_s
    ends_s = np.linspace(costs.earliest_s, closes_s - opens_s, parts * costs.team + 1).tolist()
    intervals = [_Interval(0.0, *ends) for ends in pairwise(ends_s)]
    return intervals[searcher :: costs.team]
