"""Brains on ideal vehicles that talk to each other, with whatever is cut.

``Troop``  the team; time jumps to the next need or delivery
"""

import heapq
import itertools
import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

from support.hall import LoneAgent
from tlcomm_core.agent.actions import TaskEvent, TaskEventKind
from tlcomm_core.method import Method
from tlcomm_core.protocol.messages import Message

__all__ = ["Troop"]

_LATENCY_S = 0.005
_RANGE_M = 1.0


@dataclass
class Troop:
    """Agents of the hall.

    Attributes:
        names: which.
        is_cut: whether a message is lost on its way, by time, receiver and message.
        method: of coordination.
        agents: their brains and vehicles, by name.
        now_s: the time.
    """

    names: Sequence[str]
    is_cut: Callable[[float, str, Message], bool] = lambda _time_s, _receiver, _message: False
    method: Method = Method.TEAM
    agents: dict[str, LoneAgent] = field(default_factory=dict)
    now_s: float = 0.0

    def __post_init__(self) -> None:
        """Let all stand at their starts."""
        self._order = itertools.count()
        self._air: list[tuple[float, int, str, Message]] = []
        self._heard = dict.fromkeys(self.names, 0)
        count = len(self.names)
        self.agents = {name: LoneAgent(name, count, method=self.method) for name in self.names}
        for name in self.names:
            self.agents[name].act()
            self._send(name)

    def run(self, until_s: float) -> None:
        """Let time pass."""
        while (next_s := self._next_s()) <= until_s:
            self.now_s = next_s
            heard: dict[str, list[Message]] = {name: [] for name in self.names}
            while self._air and self._air[0][0] <= self.now_s:
                _, _, receiver, message = heapq.heappop(self._air)
                heard[receiver].append(message)
            for name, agent in self.agents.items():
                agent.advance_to(self.now_s)
                if heard[name]:
                    agent.hear(heard[name])
                self._send(name)
        for agent in self.agents.values():
            agent.advance_to(until_s)
        self.now_s = until_s

    def events(self, *kinds: TaskEventKind) -> dict[str, list[tuple[float, TaskEvent]]]:
        """Return each agent's events of some kinds, with their times."""
        return {
            name: [(t, event) for t, event in agent.events if event.kind in kinds]
            for name, agent in self.agents.items()
        }

    def _next_s(self) -> float:
        needs_s = [agent.brain.next_need_s for agent in self.agents.values()]
        return min([*needs_s, *(entry[0] for entry in self._air[:1]), math.inf])

    def _send(self, sender: str) -> None:
        """Put on the air what an agent has said since the last time, to whoever is in range."""
        own = self.agents[sender]
        fresh = own.sent[self._heard[sender] :]
        self._heard[sender] += len(fresh)
        for message in fresh:
            for name, other in self.agents.items():
                distance_m = own.pose.distance_m(other.pose.x_m, other.pose.y_m)
                is_near = name != sender and distance_m <= _RANGE_M
                if is_near and not self.is_cut(self.now_s, name, message):
                    entry = (self.now_s + _LATENCY_S, next(self._order), name, message)
                    heapq.heappush(self._air, entry)
