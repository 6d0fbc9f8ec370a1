"""What a team that takes turns does next, from offers.

``TurnRounds``       the negotiation's ``Rounds`` for such a team
``straights``        between which places agents can go straight, and hear each other
``check_straights``  whether all can come together from their starts
"""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray
from scipy.sparse.csgraph import connected_components

from tlcomm_core.agent.charts import Charts
from tlcomm_core.agent.convoy import Part, contraction, is_together, turn
from tlcomm_core.agent.rounds import MeetingRounds
from tlcomm_core.errors import PlanningError
from tlcomm_core.game.links import Links, within_range
from tlcomm_core.game.offer import MemberOffer
from tlcomm_core.game.problem import Candidates, RoundProblem
from tlcomm_core.protocol.team import Team
from tlcomm_core.protocol.turns import TurnTeam
from tlcomm_core.scenario.model import Scenario
from tlcomm_core.workspace.grid import Grid
from tlcomm_core.workspace.sight import sightlines

__all__ = ["TurnRounds", "check_straights", "straights"]


class TurnRounds(MeetingRounds):
    """Poses rounds with a single strategy for each agent, so that there is nothing to improve.

    Members are together after one round, but for what put them off their ways: then round r is the
    turn of member r − 1 modulo N, by name. Otherwise it brings them nearer together; who would have
    had that turn has the one N rounds later.
    """

    def __init__(self, charts: Charts, team: TurnTeam, segment_allowance_s: float) -> None:
        """Use maps as ``MeetingRounds`` does."""
        super().__init__(charts, team, segment_allowance_s)
        self._off_m = team.off_m

    def problem(
        self, round_: int, departure_s: float, offers: Sequence[MemberOffer]
    ) -> RoundProblem:
        """Return the round whose only team strategy is everybody's part."""
        strategies = [part.strategy for part in self.parts(round_, departure_s, offers)]
        places = list(dict.fromkeys((own.x_m, own.y_m) for own in strategies))
        candidates = []
        for own in strategies:
            is_there = np.array([[place == (own.x_m, own.y_m) for place in places]])
            candidates.append(
                Candidates(
                    agent=own.agent,
                    task_index=np.array([own.task_index], dtype=np.int64),
                    arrival_s=np.where(is_there, own.arrival_s, np.inf),
                    extra_s=np.where(is_there, own.extra_travel_s, np.inf),
                )
            )
        return RoundProblem(
            round=round_,
            window_s=self._team.window_s(round_),
            links=Links(np.array(places), self._team.planned_range_m),
            candidates=tuple(candidates),
            rules=self._team.rules,
        )

    def parts(
        self, round_: int, departure_s: float, offers: Sequence[MemberOffer]
    ) -> tuple[Part, ...]:
        """Return everybody's part in a round.

        Args:
            round_: r ≥ 1.
            departure_s: when the members leave the present meeting.
            offers: all members' sound offers, sorted by agent.
        """
        travel = self._travel_of(offers[0], self._atlas_of(offers))
        if is_together(offers, 2.0 * self._off_m):
            # A corner further from the leader than this is one that nobody is at.
            near_m = 3.0 * self._off_m
            return turn(offers, (round_ - 1) % len(offers), departure_s, travel, near_m)
        linked = straights(
            np.array([(offer.x_m, offer.y_m) for offer in offers]), travel.grid, self._team
        )
        return contraction(offers, linked, departure_s, travel)


def straights(places_m: NDArray[np.float64], grid: Grid, team: Team) -> NDArray[np.bool_]:
    """Tell between which places agents can go straight, and hear each other all the way.

    Args:
        places_m: float[N, 2], on the grid.
        grid: the workspace; what it avoids is avoided too.
        team: whose range and radios.

    Returns:
        bool[N, N].
    """
    linked = within_range(places_m, places_m, team.planned_range_m)
    if team.clearance_m is not None:
        linked &= sightlines(grid, places_m[:, None], places_m[None], team.clearance_m)
    closed = _closing_avoided(grid)
    for one, other in np.argwhere(np.triu(linked, k=1)).tolist():
        ends_m = [(x_m, y_m) for x_m, y_m in places_m[[one, other]].tolist()]
        linked[one, other] = linked[other, one] = closed.is_clear(ends_m)
    return linked


def check_straights(scenario: Scenario, team: Team, grid: Grid) -> None:
    """See whether the agents can come together from where they start.

    Args:
        scenario: whose agents.
        team: as for ``straights``.
        grid: as for ``straights``.

    Raises:
        PlanningError: some can't get to the others by free straights between their starts.
    """
    names = list(scenario.agents)
    places_m = np.array([scenario.agents[name].start[:2] for name in names])
    _, labels = connected_components(straights(places_m, grid, team), directed=False)
    for name, (x_m, y_m), label in zip(names, places_m.tolist(), labels.tolist(), strict=True):
        if label != labels[0]:
            raise PlanningError(
                f"agents.{name}.start: free straights of at most {team.planned_range_m:g} m from "
                f"start to start don't lead from {x_m!r}, {y_m!r} to {names[0]!r}; a team that "
                "stays connected must come together that way"
            )


def _closing_avoided(grid: Grid) -> Grid:
    """Return a grid on which cells to be avoided are obstacles."""
    cells = [location for own in grid.avoided.values() for location in own.tolist()]
    if not cells:
        return grid
    centres_m, half_m = grid.locations_m[cells], grid.cell_m / 2.0
    boxes = np.concatenate((grid.boxes, np.hstack((centres_m - half_m, centres_m + half_m))))
    return Grid(grid.size_m, grid.cell_m, boxes, grid.origin_m)
