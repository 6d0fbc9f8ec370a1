"""A simulated run with all that its agents were told and did, as a bag would hold it.

``record``  runs a mission and records it
"""

from collections.abc import Iterable

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
from tlcomm_core.agent.member import create
from tlcomm_core.mission import Mission, create_world
from tlcomm_core.protocol.topics import topic_of
from tlcomm_core.records import (
    EstimateRecord,
    HeardRecord,
    RunRecords,
    SaidRecord,
    StrategyRecord,
    TaskRecord,
)
from tlcomm_core.scenario.loader import dumps
from tlcomm_core.units import nanoseconds
from tlcomm_core.workspace.atlas import Atlas
from tlcomm_core.world.lockstep import LockStep, Reply
from tlcomm_core.world.observation import Connectivity, Observation, Occupancy, Odometry, Reading
from tlcomm_tools.bag.reader import RecordedRun
from tlcomm_tools.bag.topics import recorded_topics
from tlcomm_tools.verification.recording import Commanded, MapShown, Recording, Said

__all__ = ["record"]


def record(mission: Mission) -> Recording:
    """Run a mission in lock step; return what a bag of it would hold."""
    shell = _Shell(mission)
    while (step := shell.lockstep.next_step()) is not None:
        shell.show(step.observations)
        replies = {name: shell.act(name, step.time_ns) for name in step.ticked}
        shell.show(shell.lockstep.complete(replies))
    heard_until_ns = dict.fromkeys(mission.site.scenario.agents, shell.lockstep.time_ns)
    shell.recording.run.records.heard_until_ns = heard_until_ns
    return shell.recording


class _Shell:
    """Carries observations and messages between world and members, and keeps them."""

    def __init__(self, mission: Mission) -> None:
        site, scenario = mission.site, mission.site.scenario
        atlas = Atlas(site.grid, site.region_discs)
        chosen = (mission.seed, mission.solver, mission.method)
        self._members = {
            name: create(name, site, Pacing.EVENT, atlas, *chosen) for name in scenario.agents
        }
        self._sent = dict.fromkeys(scenario.agents, 0)
        self.lockstep = LockStep(
            create_world(site, mission.seed),
            tuple(scenario.agents),
            nanoseconds(scenario.communication.hop_latency_s),
            mission.stop,
        )
        notes = {
            "scenario": dumps(scenario),
            "method": mission.method.value,
            "solver": mission.method.solver(mission.solver).name,
            "seed": str(mission.seed),
            "pace": "lockstep",
        }
        topics = recorded_topics(scenario.agents, measures=scenario.field is not None)
        self.recording = Recording(
            RecordedRun(RunRecords(), tuple(scenario.agents), 0, notes, ""),
            topics=frozenset(topic.name for topic in topics),
        )

    def show(self, observations: Iterable[Observation]) -> None:
        """Let members see what the world shows."""
        records = self.recording.run.records
        for seen in observations:
            match seen:
                case Odometry(stamp_ns, agent, pose, linear_mps, angular_radps):
                    records.odometry.append(seen)
                    self._members[agent].see_odometry(stamp_ns, pose, linear_mps, angular_radps)
                case Connectivity():
                    records.connectivity.append(seen)
                    self._show_links(seen)
                case Occupancy(stamp_ns, grid):
                    self.recording.maps.append(MapShown(stamp_ns, grid.free))
                    for member in self._members.values():
                        member.see_map(stamp_ns, grid.free)
                case Reading(stamp_ns, agent, _, value):
                    self.recording.readings.append(seen)
                    self._members[agent].see_reading(stamp_ns, value)

    def _show_links(self, seen: Connectivity) -> None:
        names = tuple(self._members)
        links = [
            (names[i], names[j], distance_m)
            for (i, j), distance_m in zip(seen.edges, seen.distances_m, strict=True)
        ]
        for name, member in self._members.items():
            near_m = {one: distance_m for one, other, distance_m in links if other == name}
            near_m |= {other: distance_m for one, other, distance_m in links if one == name}
            member.see_neighbours(seen.stamp_ns, near_m)

    def act(self, name: str, now_ns: int) -> Reply:
        """Let a member act; return its reply."""
        member = self._members[name]
        actions = member.step(now_ns)
        self.recording.run.records.heard += [
            HeardRecord(now_ns, name, own.message.sender, topic_of(own.message), own.said_ns)
            for own in member.heard
        ]
        for action in actions:
            self._note(name, action, now_ns)
        drives = [own for own in actions if isinstance(own, Drive)]
        return Reply(
            next_need_ns=member.next_need_ns,
            team_messages=self._sent[name],
            command=(drives[-1].linear_mps, drives[-1].angular_radps) if drives else None,
            meetings_ended=member.meetings_ended,
            measured_at=member.measured_at,
        )

    def _note(self, name: str, action: Action, now_ns: int) -> None:
        records = self.recording.run.records
        match action:
            case Drive():
                self.recording.commanded.append(Commanded(now_ns, name, action))
            case ReportTask(event):
                records.tasks.append(TaskRecord(now_ns, name, event))
            case HoldStrategy(strategy):
                records.strategies.append(StrategyRecord(now_ns, name, strategy))
            case ReportEstimate(value, own):
                estimate = EstimateRecord(now_ns, name, value, own or 0.0, own is not None)
                records.estimates.append(estimate)
            case SendMessage(message) | SayEstimate(message):
                self._sent[name] += 1
                self.recording.said.append(Said(now_ns, name, message))
                records.said.append(SaidRecord(now_ns, name, topic_of(message)))
                for other, member in self._members.items():
                    if other != name:
                        member.receive(message, now_ns)
            case CountIgnored():
                pass
