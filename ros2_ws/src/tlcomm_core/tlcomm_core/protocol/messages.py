"""What agents say to each other, as values; each carries its ticket.

``PlanOffer``     who is here, since when, and what it plans
``BestResponse``  σ* and strategy on their way through the team
``Confirmation``  who holds the equilibrium
``Message``       any of the three
"""

from dataclasses import dataclass

from tlcomm_core.game.offer import MemberOffer
from tlcomm_core.game.strategy import Strategy

__all__ = ["BestResponse", "Confirmation", "Message", "PlanOffer"]


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


Message = PlanOffer | BestResponse | Confirmation
