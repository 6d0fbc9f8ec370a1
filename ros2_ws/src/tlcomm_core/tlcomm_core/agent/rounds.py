"""Round problems from offers, on this agent's map.

``MeetingRounds``  the negotiation's ``Rounds``
"""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from tlcomm_core.agent.sightings import links_on, sightings
from tlcomm_core.game.candidates import candidates
from tlcomm_core.game.offer import MemberOffer, offer_flaw
from tlcomm_core.game.problem import RoundProblem
from tlcomm_core.protocol.team import Team
from tlcomm_core.workspace.atlas import Atlas
from tlcomm_core.workspace.travel import Motion, TravelTimes

__all__ = ["MeetingRounds"]


class MeetingRounds:
    """Poses round problems: every member's candidates, from its offer and the common map."""

    def __init__(self, atlas: Atlas, team: Team, segment_allowance_s: float) -> None:
        """Use a map on which every member's controller loses the same per segment.

        Args:
            atlas: the map.
            team: the team.
            segment_allowance_s: the allowance that travel times are computed with.
        """
        self._atlas = atlas
        self._team = team
        self._allowance_s = segment_allowance_s
        self._links = links_on(atlas.grid, team)

    def is_sound(self, offer: MemberOffer) -> bool:
        """Return whether candidates can be computed from a peer's offer."""
        avoided = frozenset(offer.avoided)
        if not self._atlas.knows(avoided):
            return False
        return offer_flaw(offer, self._atlas.grid_avoiding(avoided)) is None

    def sightings(self, offers: Sequence[MemberOffer]) -> tuple[NDArray[np.bool_], ...]:
        """Return masks of which members see each other, from the surest to the least sure."""
        return sightings(self._atlas.grid, self._team, offers)

    def problem(
        self, round_: int, departure_s: float, offers: Sequence[MemberOffer]
    ) -> RoundProblem:
        """Return the round problem that the members' offers, sorted by agent, pose."""
        window_s = self._team.window_s(round_)
        return RoundProblem(
            round=round_,
            window_s=window_s,
            links=self._links,
            candidates=tuple(
                candidates(
                    offer, departure_s, window_s, self._travel_of(offer), self._team.margin_s
                )
                for offer in offers
            ),
            rules=self._team.rules,
        )

    def _travel_of(self, offer: MemberOffer) -> TravelTimes:
        motion = Motion(offer.linear_mps, offer.angular_radps, self._allowance_s)
        return self._atlas.travel(motion, frozenset(offer.avoided))
