"""A team of negotiations over a fake network that loses, delays, reorders and duplicates.

``Faults``       how bad the network is
``FakeNetwork``  the team; time jumps to the next arrival, delivery or need
``Entry``        a line of its transcript
"""

import heapq
import itertools
import math
from collections import Counter
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field

import numpy as np

from tlcomm_core.game.offer import MemberOffer
from tlcomm_core.protocol.actions import Action, HoldStrategy, SendMessage
from tlcomm_core.protocol.messages import Message
from tlcomm_core.protocol.negotiation import Negotiation, Rounds
from tlcomm_core.protocol.team import Team

__all__ = ["Entry", "FakeNetwork", "Faults"]

# Many times what any team here needs: messages without end must not hang a test.
_MOST_ENTRIES = 200_000


@dataclass(frozen=True, slots=True)
class Faults:
    """How bad the network is; a message may overtake another by as much as the jitter."""

    loss: float = 0.0
    jitter_s: float = 0.0
    duplication: float = 0.0
    latency_s: float = 0.005


@dataclass(frozen=True, slots=True)
class Entry:
    """What an agent did, when."""

    time_s: float
    agent: str
    action: Action


@dataclass
class FakeNetwork:
    """Agents that arrive at their places, and whoever is in range of whom.

    Attributes:
        offers: the agents, each with its place and time of arrival.
        round: the round that they plan.
        team: their common ground.
        rounds: poses the problem.
        faults: of the network.
        seed: of its dice.
        is_cut: whether a message is lost on purpose, by time, receiver and message.
        range_m: within which they hear each other.
        agents: the negotiations of those that are here, by name.
        agreed_s: when who held a strategy as agreed.
        transcript: all that was done, in order.
    """

    offers: tuple[MemberOffer, ...]
    round: int
    team: Team
    rounds: Rounds
    faults: Faults = Faults()
    seed: int = 0
    is_cut: Callable[[float, str, Message], bool] = lambda _time_s, _receiver, _message: False
    range_m: float = 1.0
    agents: dict[str, Negotiation] = field(default_factory=dict)
    agreed_s: dict[str, float] = field(default_factory=dict)
    transcript: list[Entry] = field(default_factory=list)

    def __post_init__(self) -> None:
        """Let everybody be on the way."""
        self._rng = np.random.default_rng(self.seed)
        self._order = itertools.count()
        self._queue: list[tuple[float, int, str, Message | None]] = []
        self._neighbours = _neighbours(self.offers, self.range_m)
        self._offers: Mapping[str, MemberOffer] = {offer.agent: offer for offer in self.offers}
        self.now_s = -math.inf
        for offer in self.offers:
            self._post(offer.arrival_s, offer.agent, None)

    @property
    def next_s(self) -> float:
        """When something happens next; inf once all is silent."""
        needs_s = [agent.next_need_s for agent in self.agents.values()]
        return min([math.inf, *needs_s, *(entry[0] for entry in self._queue[:1])])

    @property
    def is_agreed(self) -> bool:
        """Whether all hold a strategy as agreed."""
        return len(self.agreed_s) == len(self.offers)

    @property
    def begins_s(self) -> float:
        """When the last agent arrives."""
        return max(offer.arrival_s for offer in self.offers)

    def run(self, until_s: float = math.inf) -> None:
        """Let time pass, up to ``until_s`` or until all is silent."""
        while self.next_s <= until_s and self.next_s < math.inf:
            self.step()

    def run_until_agreed(self, within_s: float) -> None:
        """Let time pass until all hold a strategy, or for some time after the last arrival."""
        while not self.is_agreed and self.next_s <= self.begins_s + within_s:
            self.step()

    def step(self) -> None:
        """Jump to the next event, and do all that is due at that instant."""
        assert len(self.transcript) < _MOST_ENTRIES, "a storm of messages"
        self.now_s = self.next_s
        due = {name for name, agent in self.agents.items() if agent.next_need_s <= self.now_s}
        while self._queue and self._queue[0][0] <= self.now_s:
            _, _, name, message = heapq.heappop(self._queue)
            if self._deliver(name, message):
                due.add(name)
        for name in sorted(due):
            self._record(name, self.agents[name].proceed(self.now_s))
            assert self.agents[name].next_need_s > self.now_s, "needs the instant that just was"

    def leave(self, name: str) -> None:
        """Let an agent go: it neither speaks nor hears any more."""
        del self.agents[name]

    def sent(self) -> Counter[str]:
        """Return how many messages each agent has sent."""
        return Counter(
            entry.agent for entry in self.transcript if isinstance(entry.action, SendMessage)
        )

    def _deliver(self, name: str, message: Message | None) -> bool:
        """Let an agent arrive or hear; return whether it is here."""
        if message is None:
            own = self._offers[name]
            self.agents[name] = Negotiation(own, self.round, self.team, self.rounds)
        elif name in self.agents:
            self._record(name, self.agents[name].hear(message))
        return name in self.agents

    def _record(self, name: str, actions: Iterable[Action]) -> None:
        for action in actions:
            self.transcript.append(Entry(self.now_s, name, action))
            if isinstance(action, SendMessage):
                self._send(name, action.message)
            elif isinstance(action, HoldStrategy):
                assert name not in self.agreed_s, "agreed twice"
                self.agreed_s[name] = self.now_s

    def _send(self, sender: str, message: Message) -> None:
        for receiver in self._neighbours[sender]:
            copies = 1 + (self._rng.random() < self.faults.duplication)
            for _ in range(copies):
                is_lost = self._rng.random() < self.faults.loss
                delay_s = self.faults.latency_s + self._rng.uniform(0.0, self.faults.jitter_s)
                if not is_lost and not self.is_cut(self.now_s, receiver, message):
                    self._post(self.now_s + delay_s, receiver, message)

    def _post(self, time_s: float, name: str, message: Message | None) -> None:
        heapq.heappush(self._queue, (time_s, next(self._order), name, message))


def _neighbours(offers: Iterable[MemberOffer], range_m: float) -> dict[str, tuple[str, ...]]:
    """Return who hears whom, forgiving a place exactly in range its rounding."""
    places = {offer.agent: (offer.x_m, offer.y_m) for offer in offers}
    return {
        one: tuple(
            other
            for other in sorted(places)
            if other != one and math.dist(places[one], places[other]) <= range_m + 1e-9
        )
        for one in places
    }
