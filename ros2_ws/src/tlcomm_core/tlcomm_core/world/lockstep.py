"""Lock step: simulated time goes on when everyone concerned has answered, and then at once.

``LockStep``  conservative time management over a world
``Step``      one instant: what is seen, and who is to act
``Reply``     what an agent answers to having acted
``StopRule``  when a run is over

Each agent answers a tick with the time of its own next need, and with how many team messages it
has sent so far. So the least of all needs, the world's own next change and the next arrival of a
message is the next instant at which anything can happen: time goes there, and only those whose
time has come are ticked. (All are when the map changes. If there is anything to measure, those are
who come into range of each other, and who has read its sensor is ticked again at once.) A message
sent at t arrives at t + latency, so what happens at one instant can't depend on the order in which
agents act at it. Hence a run is a function of the scenario and the seed, whatever the machine's
load, in one process and over ROS alike.

Source: conservative synchronisation with lookahead, K. M. Chandy and J. Misra, "Distributed
    simulation: a case study in design and verification of distributed programs", IEEE Trans.
    Software Engineering, 1979; time management services of IEEE 1516 (HLA).
"""

import heapq
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Final

from tlcomm_core.world.observation import Connectivity, Observation, Occupancy
from tlcomm_core.world.world import World

__all__ = ["LockStep", "Reply", "Step", "StopRule"]


@dataclass(frozen=True, slots=True)
class StopRule:
    """When a run is over: at whichever comes first.

    Attributes:
        meetings: all agents have ended this many meetings (that of round 0 counts); or ``None``.
        until_ns: this time has come; or ``None``.
    """

    meetings: int | None
    until_ns: int | None


@dataclass(frozen=True, slots=True)
class Step:
    """One instant of a run.

    Attributes:
        time_ns: when.
        observations: what the world shows.
        ticked: who is to act, in the order of the agents; may be nobody.
        arrived: per agent, how many of its team messages have arrived by now, since the start.
    """

    time_ns: int
    observations: tuple[Observation, ...]
    ticked: tuple[str, ...]
    arrived: tuple[int, ...]


@dataclass(frozen=True, slots=True)
class Reply:
    """What an agent answers to a tick.

    Attributes:
        next_need_ns: when it must be ticked next at the latest; ``None``: when it hears something.
        team_messages: how many it has sent since the start.
        command: the last velocity (m/s, rad/s) that it commanded in this tick, if any.
        meetings_ended: how many meetings have ended for it.
        measured_at: the region in which it has ended the action that reads the field, or "".
    """

    next_need_ns: int | None
    team_messages: int
    command: tuple[float, float] | None
    meetings_ended: int
    measured_at: str = ""


class LockStep:
    """Conservative time management over a world."""

    def __init__(
        self, world: World, agents: Sequence[str], hop_latency_ns: int, stop: StopRule
    ) -> None:
        """Be ready for t = 0, at which everyone is ticked.

        Args:
            world: at t = 0.
            agents: all agents' names, in the scenario's order.
            hop_latency_ns: time from sending a message to its arrival, > 0.
            stop: when the run is over.
        """
        self._world: Final = world
        self._agents: Final = tuple(agents)
        self._latency_ns: Final = hop_latency_ns
        self._stop: Final = stop
        self._needs_ns: dict[str, int | None] = dict.fromkeys(self._agents, 0)
        self._sent = dict.fromkeys(self._agents, 0)
        self._arrived = dict.fromkeys(self._agents, 0)
        self._meetings_ended = dict.fromkeys(self._agents, 0)
        self._on_air: list[tuple[int, str, int]] = []
        self._edges: tuple[tuple[int, int], ...] = ()
        self._time_ns = 0
        self._is_over = False

    @property
    def meetings_ended(self) -> int:
        """How many meetings have ended for all agents."""
        return min(self._meetings_ended.values())

    @property
    def time_ns(self) -> int:
        """The instant of the last step."""
        return self._time_ns

    def next_step(self) -> Step | None:
        """Go to the next instant; ``None`` when the run is over."""
        if self._is_over:
            return None
        needs_ns = [need for need in self._needs_ns.values() if need is not None]
        arrivals_ns = [entry[0] for entry in self._on_air[:1]]
        time_ns = min([self._world.next_change_ns(), *needs_ns, *arrivals_ns])
        if self._stop.until_ns is not None and time_ns >= self._stop.until_ns:
            time_ns = self._stop.until_ns
            self._is_over = True
        observations = self._world.advance_to(time_ns)
        self._time_ns = time_ns
        listeners = self._arrive(time_ns) | self._newly_linked(observations)
        if any(isinstance(seen, Occupancy) for seen in observations):
            listeners = frozenset(self._agents)
        return Step(
            time_ns=time_ns,
            observations=observations,
            ticked=tuple(name for name in self._agents if self._is_due(name) or name in listeners),
            arrived=tuple(self._arrived.values()),
        )

    def complete(self, replies: Mapping[str, Reply]) -> tuple[Observation, ...]:
        """Take the answers of all agents that were ticked; return what their commands show."""
        observations: list[Observation] = []
        for name in self._agents:
            if name not in replies:
                continue
            reply = replies[name]
            self._needs_ns[name] = reply.next_need_ns
            self._meetings_ended[name] = reply.meetings_ended
            if reply.team_messages > self._sent[name]:
                self._sent[name] = reply.team_messages
                arrival_ns = self._time_ns + self._latency_ns
                heapq.heappush(self._on_air, (arrival_ns, name, reply.team_messages))
            if reply.measured_at:
                observations += self._measured(name, reply.measured_at)
            if reply.command is not None:
                observations += self._world.command(name, *reply.command)
        if self._stop.meetings is not None and self.meetings_ended >= self._stop.meetings:
            self._is_over = True
        return tuple(observations)

    def _is_due(self, name: str) -> bool:
        need_ns = self._needs_ns[name]
        return need_ns is not None and need_ns <= self._time_ns

    def _measured(self, name: str, region: str) -> tuple[Observation, ...]:
        """Let an agent read its sensor; if that shows anything, tick it once more, at once."""
        readings = self._world.measure(name, region)
        if readings:
            self._needs_ns[name] = self._time_ns
        return readings

    def _newly_linked(self, observations: Iterable[Observation]) -> frozenset[str]:
        """Return who has come into range of somebody, if they have estimates to exchange."""
        linked: set[str] = set()
        for seen in observations:
            if isinstance(seen, Connectivity) and self._world.has_sensors:
                fresh = set(seen.edges).difference(self._edges)
                self._edges = seen.edges
                linked.update(self._agents[index] for edge in fresh for index in edge)
        return frozenset(linked)

    def _arrive(self, time_ns: int) -> frozenset[str]:
        """Let messages arrive; return who is in range of a sender to hear them."""
        listeners: set[str] = set()
        while self._on_air and self._on_air[0][0] <= time_ns:
            _, sender, count = heapq.heappop(self._on_air)
            self._arrived[sender] = count
            listeners |= self._world.neighbours(sender)
        return frozenset(listeners)
