"""Round problems from offers, on the map that all know.

``MeetingRounds``  the negotiation's ``Rounds``
"""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from tlcomm_core.agent.charts import Charts
from tlcomm_core.agent.sightings import links_on, sightings
from tlcomm_core.errors import LocalMisuseError
from tlcomm_core.game.candidates import candidates
from tlcomm_core.game.links import Links
from tlcomm_core.game.offer import MemberOffer, offer_flaw
from tlcomm_core.game.problem import Candidates, RoundProblem
from tlcomm_core.protocol.team import Team
from tlcomm_core.workspace.atlas import Atlas
from tlcomm_core.workspace.travel import Motion, TravelTimes

__all__ = ["MeetingRounds"]


class MeetingRounds:
    """Poses round problems: every member's candidates, from its offer and the common map.

    All members must pose the *same* problem, although the map may change while they meet and some
    may learn of it later than others. So each offer says which map it was made with, and the round
    is planned on the oldest of these. Whoever holds all offers takes the same oldest map; it knows
    that map, or the offer wouldn't have been sound to it; and maps from one time are equal for all.
    What the problem depends on beside that is in the offers. So the problems are equal.

    The plan in an offer may rely on a later map than the round's: what the round's map doesn't let
    anybody reach isn't admissible. What a later map has closed since, agents find out on the way,
    and cope with.
    """

    def __init__(self, charts: Charts, team: Team, segment_allowance_s: float) -> None:
        """Use maps on which every member's controller loses the same per segment.

        Args:
            charts: the maps that the agent knows, now and later.
            team: the team.
            segment_allowance_s: the allowance that travel times are computed with.
        """
        self._charts = charts
        self._team = team
        self._allowance_s = segment_allowance_s
        self._linked: tuple[Atlas, Links] | None = None

    def is_sound(self, offer: MemberOffer) -> bool:
        """Return whether candidates can be computed from a peer's offer."""
        atlas, avoided = self._charts.atlas(offer.map_ns), frozenset(offer.avoided)
        if atlas is None or not atlas.knows(avoided):
            return False
        return offer_flaw(offer, atlas.grid_avoiding(avoided)) is None

    def sightings(self, offers: Sequence[MemberOffer]) -> tuple[NDArray[np.bool_], ...]:
        """Return masks of which members see each other, from the surest to the least sure."""
        return sightings(self._atlas_of(offers).grid, self._team, offers)

    def problem(
        self, round_: int, departure_s: float, offers: Sequence[MemberOffer]
    ) -> RoundProblem:
        """Return the round problem that the members' sound offers, sorted by agent, pose."""
        atlas = self._atlas_of(offers)
        window_s = self._team.window_s(round_)
        return RoundProblem(
            round=round_,
            window_s=window_s,
            links=self._links_on(atlas),
            candidates=tuple(
                self._candidates(offer, departure_s, window_s, atlas) for offer in offers
            ),
            rules=self._team.rules,
        )

    def _candidates(
        self, offer: MemberOffer, departure_s: float, window_s: tuple[float, float], atlas: Atlas
    ) -> Candidates:
        travel = self._travel_of(offer, atlas)
        own = candidates(offer, departure_s, window_s, travel, self._team.margin_s)
        if not self._team.rules.keeps_places:
            return own
        here = atlas.grid.location_at(offer.x_m, offer.y_m)
        assert here is not None, "a sound offer is made where an agent can be"
        return own.only_at(here)

    def _atlas_of(self, offers: Sequence[MemberOffer]) -> Atlas:
        """Return travel times on the oldest map that sound offers were made with."""
        map_ns = min(offer.map_ns for offer in offers)
        atlas = self._charts.atlas(map_ns)
        if atlas is None:
            raise LocalMisuseError(f"an offer was made with an unknown map, that from {map_ns} ns")
        return atlas

    def _links_on(self, atlas: Atlas) -> Links:
        """Return the links on a map, the same object while rounds are planned on the same map."""
        if self._linked is None or self._linked[0] is not atlas:
            self._linked = (atlas, links_on(atlas.grid, self._team))
        return self._linked[1]

    def _travel_of(self, offer: MemberOffer, atlas: Atlas) -> TravelTimes:
        motion = Motion(offer.linear_mps, offer.angular_radps, self._allowance_s)
        return atlas.travel(motion, frozenset(offer.avoided))
