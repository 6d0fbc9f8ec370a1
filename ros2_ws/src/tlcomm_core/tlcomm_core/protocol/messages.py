"""What agents say to each other, as values; each carries its ticket.

``PlanOffer``         who is here, since when, and what it plans
``Proposal``          a whole team strategy on its way through the team
``BestResponse``      σ* and strategy on their way through the team
``Word``              either of these two: what a minimum consensus exchanges
``Confirmation``      who holds the equilibrium
``Message``           any of the four: what is said of a round
``EstimateExchange``  what the sender takes the field to be
``Measurement``       what a member has measured, in it
``TeamMessage``       whatever is said
"""

from collections.abc import Iterable
from dataclasses import dataclass, replace
from typing import Self

from tlcomm_core.game.best_response import priority
from tlcomm_core.game.offer import MemberOffer
from tlcomm_core.game.strategy import Strategy

__all__ = [
    "BestResponse",
    "Confirmation",
    "EstimateExchange",
    "Measurement",
    "Message",
    "PlanOffer",
    "Proposal",
    "TeamMessage",
    "Word",
]


@dataclass(frozen=True, slots=True)
class PlanOffer:
    """Offers flooded through neighbours during the meeting of ``round`` − 1.

    Attributes:
        sender: who says or relays it.
        round: the round that is being planned.
        known: agents whose offers the sender holds, sorted.
        offers: those that it passes on here.
    """

    sender: str
    round: int
    known: tuple[str, ...]
    offers: tuple[MemberOffer, ...]


@dataclass(frozen=True, slots=True)
class Proposal:
    """The team strategy of least potential seen so far, one hop further.

    Attributes:
        sender: who says it.
        round: the round that is being planned.
        iteration: number of the comparison; proposals are compared once, in the first.
        hop: how many exchanges the minimum has been through.
        candidate: who proposed it.
        potential_s: its Φ.
        bound_s: no team strategy in what the agents heard so far have searched has a lower Φ;
            −inf where nothing is proven.
        strategies: one per agent, sorted by agent.
    """

    sender: str
    round: int
    iteration: int
    hop: int
    candidate: str
    potential_s: float
    bound_s: float
    strategies: tuple[Strategy, ...]

    @property
    def priority(self) -> tuple[float, str]:
        """The sort key: the least potential first, among equals the first name."""
        return self.potential_s, self.candidate

    @property
    def claim(self) -> tuple[object, ...]:
        """What stays the same on the way."""
        return self.iteration, self.potential_s, self.strategies

    def joined(self, heard: Iterable["Word"]) -> Self:
        """Return this proposal with what is proven by all: each bound holds for its share."""
        bounds_s = [word.bound_s for word in heard if isinstance(word, Proposal)]
        return replace(self, bound_s=min([self.bound_s, *bounds_s]))


@dataclass(frozen=True, slots=True)
class BestResponse:
    """The smallest change seen so far, one hop further.

    Attributes:
        sender: who says it.
        round: the round that is being planned.
        iteration: k of Algorithm 1.
        hop: how many exchanges the minimum has been through.
        candidate: i*, the agent whose change is the smallest seen so far.
        change_s: its σ*, at most 0.
        strategy: the strategy that it would switch to.
    """

    sender: str
    round: int
    iteration: int
    hop: int
    candidate: str
    change_s: float
    strategy: Strategy

    @property
    def priority(self) -> tuple[float, str]:
        """The sort key: the least change first, among equals the first name."""
        return priority(self.change_s, self.candidate)

    @property
    def claim(self) -> tuple[object, ...]:
        """What stays the same on the way."""
        return self.iteration, self.change_s, self.strategy

    def joined(self, heard: Iterable["Word"]) -> Self:  # noqa: ARG002
        """Return this response: others add nothing to it."""
        return self


Word = Proposal | BestResponse


@dataclass(frozen=True, slots=True)
class Confirmation:
    """The sender holds the equilibrium, and knows of these others that they do.

    Attributes:
        sender: who says it.
        round: the round that was planned.
        iteration: k at which no change was left.
        digest: of the strategies, 64 bits: equal for equal team strategies.
        confirmed: agents known to have confirmed, sorted; the sender among them.
    """

    sender: str
    round: int
    iteration: int
    digest: int
    confirmed: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class Measurement:
    """What a member has measured, and when."""

    agent: str
    value: float
    time_ns: int


@dataclass(frozen=True, slots=True)
class EstimateExchange:
    """What the sender takes the field to be.

    Attributes:
        sender: who says it.
        step: number of the exchange, on the team's common grid of time.
        neighbours: how many agents the sender hears.
        asks: whether neighbours are to repeat what they said last, since some of it was lost.
        value: its estimate.
        known: the newest measurement that it knows of each member, sorted by agent; none if the
            team comes to one estimate by consensus.
    """

    sender: str
    step: int
    neighbours: int
    asks: bool
    value: float
    known: tuple[Measurement, ...] = ()


Message = PlanOffer | Word | Confirmation
TeamMessage = Message | EstimateExchange
