"""An agent of a team that stays together: its members lead by turns.

``TurnBrain``  a team's brain whose meetings are the breaks between turns

A round is a turn (``convoy``, ``turn_rounds``). Everybody goes to the meeting at the leader's next
step; the leader does the step there before it counts as arrived, while the others wait for its
offer. So the team needs no windows. An action that fails is begun anew while the others wait, as
often as the scenario allows.
"""

import math
from dataclasses import replace

from tlcomm_core.agent.brain import TeamBrain
from tlcomm_core.agent.settings import Settings
from tlcomm_core.agent.turn_rounds import TurnRounds
from tlcomm_core.game.offer import MemberOffer
from tlcomm_core.game.strategy import Strategy, TeamStrategy

__all__ = ["TurnBrain"]


class TurnBrain(TeamBrain):
    """One agent of a team that takes turns."""

    def __init__(self, settings: Settings, turns: TurnRounds) -> None:
        """Be ready for the first odometry.

        Args:
            settings: with ``turns`` for its rounds.
            turns: tells everybody's part.
        """
        super().__init__(settings)
        self._turns = turns

    def _offer(self, now_s: float) -> MemberOffer:
        """Return no more of the plan than a turn may be about."""
        offer = super()._offer(now_s)
        return replace(offer, stops=offer.stops[: self._itinerary.steps_to_action])

    def _agree(self, strategy: TeamStrategy, own: Strategy, departure_s: float) -> None:
        """Go as all others reckon with; but no hour is too late for the step."""
        meeting = self._meeting
        assert meeting is not None
        parts = self._turns.parts(strategy.round, meeting.over_s, meeting.negotiation.offers)
        part = next(part for part in parts if part.strategy.agent == own.agent)
        last = self._itinerary.done + part.steps
        self._itinerary.agree(replace(own, task_index=last), math.inf, part.way)
        self._itinerary.heed_map(self._journey.pose, departure_s)
