"""How a team that meets plans its next meeting: one agent's state machine.

``Negotiation``  from the arrival at a place of meeting to the agreement on the next one
``Phase``        where it stands
``Rounds``       what it needs of the world: the round problem that offers pose

The phases, in order; each ends by what was *heard*, never by a guess about others:

GATHERING   Everyone floods its offer. Who holds all members' offers knows that the team is
            present, and t_c. All then pose the same round problem and compute the same S⁰.
            (``gathering``)
IMPROVING   Over the meeting graph, which is known to all from the offers' places: everyone's
            proposal, if the solver makes any, and Algorithm 1. (``meeting_graph``, ``improving``,
            ``consensus``)
CONFIRMING  The search is over; everyone floods that it holds the result. (``confirming``)
AGREED      All confirmations are known: the team strategy is held as agreed.

If no window that may be planned has an admissible meeting, which all find alike, nothing is
improved: the team stays until the round is given up (``team.OnInfeasible``).

Who hasn't confirmed a round until D_c into its window (``Team.confirmable_until_s``) gives it up
for good: it says and hears nothing of that round any more.

Which messages matter in which phase (rows: what is heard of the round being planned):

              GATHERING      IMPROVING      CONFIRMING     AGREED
PlanOffer     learn, relay   answer         answer         answer
Proposal and
BestResponse  keep           exchange       late           answer
Confirmation  keep           keep           learn, relay   answer

*keep*: a neighbour whose phase ended may be one ahead, since what ended it may reach this agent
only later; what it says is taken in when the own phase follows. *answer*: the sender may lack what
ends its phase or its repetitions, so that is told once more. Of another round: late or early. From
outside the team: foreign. Whatever is malformed or contradicts what was heard before changes
nothing.

Safety: an agent confirms one team strategy per round only, and holds it as agreed only when all
members have confirmed the same; so no two agents ever hold different strategies for one round. More
than that, all that is confirmed for a round is the same strategy, since each agent gets it from the
same offers by the same exchanges. And where anybody agrees, nobody has given up or ever will.
To confirm is to promise to be there: where each goes if it never learns whether all have
confirmed, and why the team meets again, is said in ``whereabouts``.

Liveness: what a neighbour may still need is repeated, at first after ``retry_s`` and then ever more
rarely up to a bound, until its messages show that it is past needing it. An offer or a confirmation
is shown by being relayed, an exchange of the consensus by the neighbour's next one. So while the
team stays connected, each phase ends. Who sees that all its neighbours hold all confirmations is
*settled* and falls silent; a neighbour that can't see the same of it still repeats its last
exchanges, and that it answers.
"""

import math
from collections.abc import Sequence
from enum import Enum
from typing import Final, Protocol

import numpy as np
from numpy.typing import NDArray

from tlcomm_core.errors import InfeasibleRoundError
from tlcomm_core.game.offer import MemberOffer, busy_until
from tlcomm_core.game.problem import RoundProblem
from tlcomm_core.game.strategy import TeamStrategy
from tlcomm_core.protocol.actions import Action, CountIgnored, HoldStrategy, SendMessage
from tlcomm_core.protocol.confirming import Confirming
from tlcomm_core.protocol.gathering import Gathering
from tlcomm_core.protocol.improving import Improving
from tlcomm_core.protocol.meeting_graph import meeting_graph
from tlcomm_core.protocol.messages import (
    BestResponse,
    Confirmation,
    Message,
    PlanOffer,
    Proposal,
    Word,
)
from tlcomm_core.protocol.reception import Reception
from tlcomm_core.protocol.team import OnInfeasible, Team

__all__ = ["Negotiation", "Phase", "Rounds"]

# A neighbour is one phase ahead at the most; it says one thing per kind and exchange there.
_KEPT_PER_SENDER: Final = 4


class Phase(Enum):
    """Where a negotiation stands."""

    GATHERING = "gathering"
    IMPROVING = "improving"
    CONFIRMING = "confirming"
    AGREED = "agreed"


class Rounds(Protocol):
    """What a negotiation needs to know of the world."""

    def is_sound(self, offer: MemberOffer) -> bool:
        """Return whether a round problem can be posed with a peer's offer."""

    def sightings(self, offers: Sequence[MemberOffer]) -> tuple[NDArray[np.bool_], ...]:
        """Return masks [N, N] of which members see each other, from the surest to the least sure.

        None if their radios needn't see.
        """

    def problem(
        self, round_: int, departure_s: float, offers: Sequence[MemberOffer]
    ) -> RoundProblem:
        """Return the round problem that the members' offers, sorted by agent, pose."""


class Negotiation:
    """One agent's part in planning one round.

    ``hear`` only takes in; ``proceed`` says whatever follows. So however many messages arrive at
    one instant, and in whatever order, one answer is given to all of them.
    """

    def __init__(self, own: MemberOffer, round_: int, team: Team, rounds: Rounds) -> None:
        """Prepare to plan a round.

        Args:
            own: this agent's offer, made at the meeting before.
            round_: the round to plan, r ≥ 1.
            team: the team.
            rounds: poses round problems.
        """
        self._own = own.agent
        self._round = round_
        self._team = team
        self._rounds = rounds
        self._gathering = Gathering(own, round_, team, rounds.is_sound)
        self._improving: Improving | None = None
        self._confirming: Confirming | None = None
        self._agreed: TeamStrategy | None = None
        self._meeting_s: float | None = None
        self._neighbours: frozenset[str] = frozenset()
        self._kept: list[Word | Confirmation] = []
        self._ignored: list[CountIgnored] = []
        self._retry_s = team.retry_s
        self._next_need_s = math.inf
        self._is_given_up = False
        self._obstacle: str | None = None

    @property
    def round(self) -> int:
        """The round that is being planned."""
        return self._round

    @property
    def phase(self) -> Phase:
        """Where the negotiation stands."""
        if self._agreed is not None:
            return Phase.AGREED
        if self._confirming is not None:
            return Phase.CONFIRMING
        return Phase.GATHERING if self._improving is None else Phase.IMPROVING

    @property
    def is_alone(self) -> bool:
        """Whether no other member has been heard of."""
        return len(self._gathering.offers) == 1

    @property
    def offers(self) -> tuple[MemberOffer, ...]:
        """The offers held, sorted by agent: all members' once the team is known to be present."""
        return self._gathering.offers

    @property
    def meeting_s(self) -> float | None:
        """t_c of the meeting under way, once the whole team is known to be present."""
        return self._meeting_s

    @property
    def agreed(self) -> TeamStrategy | None:
        """The team strategy, once all are known to have confirmed it."""
        return self._agreed

    @property
    def confirmed(self) -> TeamStrategy | None:
        """The team strategy that this agent has confirmed, once it has."""
        return None if self._confirming is None else self._confirming.strategy

    @property
    def is_settled(self) -> bool:
        """Whether no neighbour can need anything any more."""
        return self._confirming is not None and self._confirming.is_shown_complete_by(
            self._neighbours
        )

    @property
    def obstacle(self) -> str | None:
        """Why there is no admissible meeting in the round's window, if there is none."""
        return self._obstacle

    @property
    def is_given_up(self) -> bool:
        """Whether it was too late to confirm: this agent will have no part in the round."""
        return self._is_given_up

    @property
    def awaited(self) -> str | None:
        """A neighbour without whose word nothing goes on, whatever others say; ``None`` if unknown.

        Whoever takes messages may leave the others' until this one's has come.
        """
        if self._improving is None or self._confirming is not None or self._is_given_up:
            return None
        return self._improving.awaited

    @property
    def next_need_s(self) -> float:
        """When ``proceed`` must be called again, whatever is heard until then; may be inf."""
        return self._next_need_s

    def hear(self, message: Message) -> tuple[Action, ...]:
        """Take in a message; what follows from it is said by ``proceed``."""
        reception = self._receive(message)
        return () if reception is Reception.ACCEPTED else (CountIgnored(reception.value),)

    def proceed(self, now_s: float) -> tuple[Action, ...]:
        """Go as far as what was heard allows, and repeat what may have been lost.

        Raises:
            InfeasibleRoundError: no admissible meeting exists, and the team is to stop then.
        """
        if self._give_up(now_s):
            return ()
        was_agreed = self._agreed is not None
        messages = self._advance()
        if messages:
            self._retry_s = self._team.retry_s
        elif now_s >= self._next_need_s:
            messages = self._repetitions()
        if messages:
            self._next_need_s = now_s + self._retry_s
        if self.is_settled:
            self._next_need_s = math.inf
        actions: list[Action] = [*self._ignored, *(SendMessage(message) for message in messages)]
        self._ignored = []
        if self._agreed is not None and not was_agreed:
            actions.append(HoldStrategy(self._agreed))
        return tuple(actions)

    def _give_up(self, now_s: float) -> bool:
        """Give the round up if it is too late to confirm; return whether it is given up."""
        if self._confirming is None and now_s >= self._team.confirmable_until_s(self._round):
            self._is_given_up = True
            self._next_need_s = math.inf
        return self._is_given_up

    def _receive(self, message: Message) -> Reception:
        if message.sender not in self._team.members or message.sender == self._own:
            return Reception.FOREIGN
        if message.round != self._round or self._is_given_up:
            return Reception.EARLY if message.round > self._round else Reception.LATE
        match message:
            case PlanOffer():
                return self._gathering.hear(message)
            case Proposal() | BestResponse():
                if self._improving is None:
                    return self._keep(message)
                return self._answer_if_repeated(message, self._improving.hear(message))
            case Confirmation():
                return self._confirming.hear(message) if self._confirming else self._keep(message)

    def _answer_if_repeated(self, message: Word, reception: Reception) -> Reception:
        """Once settled, show so to a neighbour that still repeats what it said last."""
        if self._confirming is None or reception not in (Reception.LATE, Reception.DUPLICATE):
            return reception
        if not self.is_settled or message.sender not in self._neighbours:
            return Reception.LATE
        self._confirming.answer()
        return Reception.ACCEPTED

    def _keep(self, message: Word | Confirmation) -> Reception:
        if message in self._kept:
            return Reception.DUPLICATE
        if sum(kept.sender == message.sender for kept in self._kept) >= _KEPT_PER_SENDER:
            return Reception.OVERFLOWING
        self._kept.append(message)
        return Reception.ACCEPTED

    def _take_kept(self) -> None:
        kept, self._kept = self._kept, []
        for message in kept:
            reception = self._receive(message)
            if reception is not Reception.ACCEPTED:
                self._ignored.append(CountIgnored(reception.value))

    def _advance(self) -> list[Message]:
        messages: list[Message] = []
        if (offer := self._gathering.owed()) is not None:
            messages.append(offer)
        if self._meeting_s is None and self._gathering.is_complete:
            self._meeting_s = self._gathering.meeting_s
            self._improving = self._begin_improving(self._meeting_s + self._team.duration_s)
            if self._improving is not None:
                self._take_kept()
        if self._improving is not None and self._confirming is None:
            messages += self._improving.owed()
            if (result := self._improving.result) is not None:
                self._confirming = Confirming(
                    self._own, self._team.members, self._round, self._improving.iteration, result
                )
                self._take_kept()
        if self._confirming is not None:
            if (confirmation := self._confirming.owed()) is not None:
                messages.append(confirmation)
            if self._confirming.is_complete:
                self._agreed = self._confirming.strategy
        return messages

    def _begin_improving(self, departure_s: float) -> Improving | None:
        """Begin to plan the first window that the team can meet in, of those that it may plan.

        All hold the same offers, so all find the same windows impossible.

        Raises:
            InfeasibleRoundError: there is none, and the team is to stop then.
        """
        for round_ in range(self._round, self._round + self._team.most_windows):
            try:
                return self._improving_for(round_, departure_s)
            except InfeasibleRoundError as error:
                busy = busy_until(
                    self._gathering.offers, departure_s, self._team.opens_s(round_ + 1)
                )
                reason = f"{error}; {busy}" if busy else str(error)
                if self._team.on_infeasible is OnInfeasible.STOP:
                    raise InfeasibleRoundError(reason) from error
                self._obstacle = self._obstacle or reason
        return None

    def _improving_for(self, round_: int, departure_s: float) -> Improving:
        offers = self._gathering.offers
        links, exchanges = meeting_graph(offers, self._team, self._rounds.sightings(offers))
        names = [offer.agent for offer in offers]
        own = names.index(self._own)
        self._neighbours = frozenset(names[i + j - own] for i, j in links if own in (i, j))
        return Improving(
            self._own,
            self._round,
            self._rounds.problem(round_, departure_s, offers),
            self._neighbours,
            exchanges,
            self._team.solver,
            self._team.max_iterations,
        )

    def _repetitions(self) -> list[Message]:
        # What isn't lost but slow to be answered must not be said over and over. Members may take
        # most of a window to arrive, a neighbour much less to go one exchange on.
        is_gathering = self._improving is None
        most_s = self._team.patience_s if is_gathering else self._team.longest_retry_s
        self._retry_s = min(2.0 * self._retry_s, most_s)
        if self._improving is None:
            return [self._gathering.repetition()]
        if self._confirming is None:
            return [*self._offers_lacking(self._improving), *self._improving.unsuperseded]
        return [*self._improving.unsuperseded, self._confirming.repetition()]

    def _offers_lacking(self, improving: Improving) -> list[Message]:
        """Return the offers without which a neighbour can't follow into this phase."""
        if improving.is_begun_by_all:
            return []
        offer = self._gathering.lacking(self._neighbours)
        return [] if offer is None else [offer]
