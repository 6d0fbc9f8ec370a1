"""The in-process harness: members and world in lock step, without ROS.

``simulate``   run a mission
``Simulated``  what it leaves behind
"""

import time
from collections import Counter
from collections.abc import Callable, Iterable
from dataclasses import dataclass, field
from typing import assert_never

from tlcomm_core.agent.actions import (
    Action,
    CountIgnored,
    Drive,
    HoldStrategy,
    ReportEstimate,
    ReportTask,
    SayEstimate,
    SendMessage,
)
from tlcomm_core.agent.controller import Pacing
from tlcomm_core.agent.member import Member, create
from tlcomm_core.agent.timing import TimedMember
from tlcomm_core.mission import Mission, create_world
from tlcomm_core.protocol.messages import PlanOffer, TeamMessage
from tlcomm_core.protocol.size import size_bytes
from tlcomm_core.protocol.topics import topic_of
from tlcomm_core.records import (
    EstimateRecord,
    HeardRecord,
    OfferRecord,
    RunRecords,
    SaidRecord,
    StrategyRecord,
    TaskRecord,
)
from tlcomm_core.units import nanoseconds
from tlcomm_core.workspace.atlas import Atlas
from tlcomm_core.world.lockstep import LockStep, Reply
from tlcomm_core.world.observation import Connectivity, Observation, Occupancy, Odometry, Reading

__all__ = ["Simulated", "simulate"]


@dataclass(slots=True)
class Simulated:
    """What a simulated run leaves behind.

    Attributes:
        records: what result and event log are made from.
        ignored: per reason, how many messages changed nothing.
        collisions: per agent, how often it ran into something.
        sim_ns: simulated time at the end.
    """

    records: RunRecords = field(default_factory=RunRecords)
    ignored: Counter[str] = field(default_factory=Counter)
    collisions: dict[str, int] = field(default_factory=dict)
    sim_ns: int = 0


def simulate(
    mission: Mission,
    on_progress: Callable[[int, int], None] | None = None,
    on_message: Callable[[TeamMessage], None] | None = None,
) -> Simulated:
    """Run a mission in this process.

    Args:
        mission: what to run.
        on_progress: called after each instant with the simulated time (ns) and the number of
            meetings that have ended.
        on_message: called with each message that a member says.

    Raises:
        PlanningError: an agent's task has no plan.
        InfeasibleRoundError: the team has no admissible next meeting.
    """
    harness = _Harness(mission, on_message)
    while (step := harness.lockstep.next_step()) is not None:
        harness.show(step.observations)
        replies = {name: harness.act(name, step.time_ns) for name in step.ticked}
        harness.show(harness.lockstep.complete(replies))
        harness.left.sim_ns = step.time_ns
        if on_progress is not None:
            on_progress(step.time_ns, harness.lockstep.meetings_ended)
    harness.left.collisions = dict(harness.world.collisions)
    agents = mission.site.scenario.agents
    harness.left.records.heard_until_ns = dict.fromkeys(agents, harness.left.sim_ns)
    return harness.left


class _Harness:
    """The members' shell: carries observations and messages between world and members."""

    def __init__(self, mission: Mission, on_message: Callable[[TeamMessage], None] | None) -> None:
        self._on_message = on_message
        self._offered: set[object] = set()
        scenario = mission.site.scenario
        silent = dict.fromkeys(scenario.agents, 0)
        self.left = Simulated(RunRecords(messages_sent=silent, bytes_sent=silent.copy()))
        atlas = Atlas(mission.site.grid, mission.site.region_discs)
        self._members: dict[str, Member] = {
            name: create(
                name,
                mission.site,
                Pacing.EVENT,
                atlas,
                mission.seed,
                mission.solver,
                mission.method,
            )
            for name in scenario.agents
        }
        self.left.records.messages_undelivered = {
            name: member.undelivered for name, member in self._members.items()
        }
        self._timed = {
            name: TimedMember(member, time.thread_time, time.time)
            for name, member in self._members.items()
        }
        self.world = create_world(mission.site, mission.seed)
        self.lockstep = LockStep(
            self.world,
            tuple(scenario.agents),
            nanoseconds(scenario.communication.hop_latency_s),
            mission.stop,
        )

    def show(self, observations: Iterable[Observation]) -> None:
        """Let members see what the world shows."""
        for observation in observations:
            match observation:
                case Odometry():
                    self.left.records.odometry.append(observation)
                    self._members[observation.agent].see_odometry(
                        observation.stamp_ns,
                        observation.pose,
                        observation.linear_mps,
                        observation.angular_radps,
                    )
                case Connectivity():
                    self.left.records.connectivity.append(observation)
                    self._show_connectivity(observation)
                case Occupancy():
                    for member in self._members.values():
                        member.see_map(observation.stamp_ns, observation.grid.free)
                case Reading():
                    member = self._members[observation.agent]
                    member.see_reading(observation.stamp_ns, observation.value)

    def act(self, name: str, now_ns: int) -> Reply:
        """Let a member act; return its reply."""
        actions, timing = self._timed[name].step(now_ns)
        if timing is not None:
            self.left.records.timings.append(timing)
        command = None
        for action in actions:
            match action:
                case Drive(linear_mps, angular_radps):
                    command = (linear_mps, angular_radps)
                case _:
                    self._perform(name, action, now_ns)
        member = self._members[name]
        self.left.records.heard += [
            HeardRecord(now_ns, name, own.message.sender, topic_of(own.message), own.said_ns)
            for own in member.heard
        ]
        return Reply(
            next_need_ns=member.next_need_ns,
            team_messages=self.left.records.messages_sent[name],
            command=command,
            meetings_ended=member.meetings_ended,
            measured_at=member.measured_at,
        )

    def _perform(self, name: str, action: Action, now_ns: int) -> None:
        match action:
            case SendMessage(message) | SayEstimate(message):
                self._broadcast(name, message, now_ns)
            case ReportTask(event):
                self.left.records.tasks.append(TaskRecord(now_ns, name, event))
            case HoldStrategy(strategy):
                self.left.records.strategies.append(StrategyRecord(now_ns, name, strategy))
            case ReportEstimate(value, measured):
                record = EstimateRecord(now_ns, name, value, measured or 0.0, measured is not None)
                self.left.records.estimates.append(record)
            case CountIgnored(reason):
                self.left.ignored[reason] += 1
            case Drive():
                raise AssertionError("drives are commands, handled by the caller")
            case _:
                assert_never(action)

    def _broadcast(self, sender: str, message: TeamMessage, now_ns: int) -> None:
        self.left.records.messages_sent[sender] += 1
        self.left.records.bytes_sent[sender] += size_bytes(message)
        self.left.records.said.append(SaidRecord(now_ns, sender, topic_of(message)))
        if self._on_message is not None:
            self._on_message(message)
        if isinstance(message, PlanOffer):
            self._note_offer(message, now_ns)
        for name, member in self._members.items():
            if name != sender:
                member.receive(message, now_ns)

    def _note_offer(self, message: PlanOffer, now_ns: int) -> None:
        """Record the sender's own offer when it is new."""
        for offer in message.offers:
            ticket = (message.round, offer)
            if offer.agent == message.sender and ticket not in self._offered:
                self._offered.add(ticket)
                record = OfferRecord(now_ns, offer.agent, message.round, offer)
                self.left.records.offers.append(record)

    def _show_connectivity(self, connectivity: Connectivity) -> None:
        names = tuple(self._members)
        neighbours: dict[str, dict[str, float]] = {name: {} for name in names}
        for (i, j), distance_m in zip(connectivity.edges, connectivity.distances_m, strict=True):
            neighbours[names[i]][names[j]] = distance_m
            neighbours[names[j]][names[i]] = distance_m
        for name, member in self._members.items():
            member.see_neighbours(connectivity.stamp_ns, neighbours[name])
