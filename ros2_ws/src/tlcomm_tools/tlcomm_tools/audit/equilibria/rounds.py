"""Which plans an agreement was made with.

``AgreedRound``    an agreement with all that it was made from
``agreed_rounds``  those of a run, and what is lacking of others
"""

from collections.abc import Iterator
from dataclasses import dataclass

from tlcomm_core.agent.actions import TaskEventKind
from tlcomm_core.game.offer import MemberOffer
from tlcomm_core.game.strategy import TeamStrategy
from tlcomm_core.method import Method
from tlcomm_core.records import OfferRecord
from tlcomm_tools.audit.evidence import Evidence

__all__ = ["AgreedRound", "agreed_rounds"]


@dataclass(frozen=True, slots=True)
class AgreedRound:
    """An agreement with all that it was made from.

    Attributes:
        held: what was agreed on.
        offers: the plans of its members, in their order.
        departure_s: when they were to leave the meeting at which it was made.
    """

    held: TeamStrategy
    offers: tuple[MemberOffer, ...]
    departure_s: float

    @property
    def map_ns(self) -> int:
        """From when on the map holds that it was made on: the oldest that anybody offered with."""
        return min(offer.map_ns for offer in self.offers)


def agreed_rounds(method: Method, evidence: Evidence) -> Iterator[AgreedRound | str]:
    """Yield each team strategy that anybody holds; in place of one, what its records lack."""
    offers: dict[str, list[OfferRecord]] = {}
    for offer in evidence.records.offers:
        offers.setdefault(offer.agent, []).append(offer)
    first_ns: dict[TeamStrategy, int] = {}
    for record in evidence.records.strategies:
        first_ns.setdefault(record.strategy, record.stamp_ns)
    for held, agreed_ns in first_ns.items():
        made = {name: _before(offers.get(name, []), held, agreed_ns) for name in held.members}
        yield _agreed(method, evidence, held, agreed_ns, made)


def _before(offers: list[OfferRecord], held: TeamStrategy, agreed_ns: int) -> OfferRecord | None:
    """Return an agent's last offer before an agreement, unless it is for a later round."""
    for record in reversed(offers):
        if record.stamp_ns <= agreed_ns and record.round <= held.round:
            return record
    return None


def _agreed(
    method: Method,
    evidence: Evidence,
    held: TeamStrategy,
    agreed_ns: int,
    made: dict[str, OfferRecord | None],
) -> AgreedRound | str:
    records = [own for own in made.values() if own is not None]
    # A team that skips a window agrees on the one after that which it had offered for.
    planned = max((own.round for own in records), default=held.round)
    lacking = [name for name, own in made.items() if own is None or own.round != planned]
    if lacking or held.round - planned > (method is not Method.PAIRWISE):
        names = ", ".join(lacking or held.members)
        return f"round {held.round}: what {names} planned isn't recorded"
    window = planned - 1
    if method is Method.PAIRWISE:
        window = _window_at(evidence, held.members[0], agreed_ns)
    communication = evidence.scenario.communication
    starts_s = max(window * communication.period_s, *(own.offer.arrival_s for own in records))
    offers = tuple(own.offer for own in records)
    return AgreedRound(held, offers, starts_s + communication.duration_s)


def _window_at(evidence: Evidence, agent: str, time_ns: int) -> int:
    """Return the window of the meeting that an agent has last come to."""
    for record in reversed(evidence.events_of(agent)):
        if record.stamp_ns <= time_ns and record.event.kind is TaskEventKind.MEETING_REACHED:
            return record.event.round
    return 0
