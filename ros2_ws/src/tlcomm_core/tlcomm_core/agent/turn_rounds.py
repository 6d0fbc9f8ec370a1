"""What a team that takes turns does next, from offers.

``TurnRounds``  the negotiation's ``Rounds`` for such a team
"""

from collections.abc import Sequence

import numpy as np

from tlcomm_core.agent.approach import Approaches
from tlcomm_core.agent.charts import Charts
from tlcomm_core.agent.convoy import Part, contraction, is_together, turn
from tlcomm_core.agent.rounds import MeetingRounds
from tlcomm_core.game.links import Links
from tlcomm_core.game.offer import MemberOffer
from tlcomm_core.game.problem import Candidates, RoundProblem
from tlcomm_core.protocol.turns import TurnTeam

__all__ = ["TurnRounds"]


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
        return contraction(offers, Approaches(travel, self._team), departure_s, travel)
