"""The first phase: who is here, since when, and what everyone plans.

``Gathering``  one agent's part in flooding the members' offers
"""

from collections.abc import Callable, Iterable

from tlcomm_core.game.offer import MemberOffer
from tlcomm_core.protocol.flooding import Flood
from tlcomm_core.protocol.messages import PlanOffer
from tlcomm_core.protocol.reception import Reception
from tlcomm_core.protocol.team import Team

__all__ = ["Gathering"]


class Gathering:
    """One agent's part in flooding the members' offers.

    An offer is made at the place of meeting only, and its maker stays there until D_c after the
    meeting's beginning. So whoever holds the offers of all members knows that the whole team is
    present, and when the last one arrived.
    """

    def __init__(
        self, own: MemberOffer, round_: int, team: Team, is_sound: Callable[[MemberOffer], bool]
    ) -> None:
        """Begin with one's own offer, which is owed to whoever is in range.

        Args:
            own: this agent's offer.
            round_: the round to plan.
            team: the team.
            is_sound: whether a round problem can be posed with a peer's offer.
        """
        self._own = own.agent
        self._round = round_
        self._team = team
        self._is_sound = is_sound
        self._flood: Flood[MemberOffer] = Flood(team.members, own.agent, own)
        self._owed: frozenset[str] = frozenset({own.agent})

    @property
    def is_complete(self) -> bool:
        """Whether the whole team is known to be present."""
        return self._flood.is_complete

    @property
    def offers(self) -> tuple[MemberOffer, ...]:
        """The offers held, sorted by agent."""
        return tuple(self._flood.held[agent] for agent in self._flood.known)

    @property
    def meeting_s(self) -> float:
        """The meeting's beginning t_c by the offers held: final once they are complete."""
        opens_s = self._team.opens_s(self._team.planned_in(self._round))
        return max(opens_s, *(offer.arrival_s for offer in self.offers))

    def hear(self, message: PlanOffer) -> Reception:
        """Take in a neighbour's offers, all of them or none; remember what it lacks."""
        offers = {offer.agent: offer for offer in message.offers}
        held = self._flood.held
        if not self._team.members.issuperset([*message.known, *offers]):
            return Reception.FOREIGN
        if len(offers) != len(message.offers):
            return Reception.MALFORMED
        if any(held.get(agent, offer) != offer for agent, offer in offers.items()):
            return Reception.CONFLICTING
        if not all(self._is_sound(offer) for agent, offer in offers.items() if agent not in held):
            return Reception.MALFORMED
        told = self._flood.learn(message.sender, {*message.known, *offers}, offers)
        if told is None:
            return Reception.DUPLICATE
        self._owed |= told
        return Reception.ACCEPTED

    def owed(self) -> PlanOffer | None:
        """Return what is to be told now: all that was new here or lacking there since the last."""
        if not self._owed:
            return None
        told, self._owed = self._owed, frozenset()
        return self._tell(told)

    def repetition(self) -> PlanOffer:
        """Return what to repeat: what neighbours lack, and at least that one is here."""
        return self._tell(self._flood.lacking_anywhere() | {self._own})

    def lacking(self, neighbours: Iterable[str]) -> PlanOffer | None:
        """Return what to repeat to those who may lack an offer, if anybody may."""
        lacking = self._flood.lacking(*neighbours)
        return self._tell(lacking) if lacking else None

    def _tell(self, agents: frozenset[str]) -> PlanOffer:
        return PlanOffer(
            sender=self._own,
            round=self._round,
            known=self._flood.known,
            offers=tuple(self._flood.held[agent] for agent in sorted(agents)),
        )
