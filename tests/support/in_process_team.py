"""Members that answer a sim's conductor in process, with counters checked and delays made up."""

import random
from collections import Counter, deque
from collections.abc import Sequence
from dataclasses import dataclass, field

from tlcomm_core.agent.actions import (
    Drive,
    HoldStrategy,
    ReportEstimate,
    ReportTask,
    SayEstimate,
    SendMessage,
)
from tlcomm_core.agent.controller import Pacing
from tlcomm_core.agent.member import create
from tlcomm_core.protocol.messages import TeamMessage
from tlcomm_core.records import EstimateRecord, RunRecords, StrategyRecord, TaskRecord
from tlcomm_core.scenario.site import Site
from tlcomm_core.workspace.atlas import Atlas
from tlcomm_core.world.observation import Connectivity, Observation, Occupancy, Odometry, Reading
from tlcomm_sim.conductor import RECORDER, Conductor
from tlcomm_sim.outputs import (
    Answer,
    Leave,
    Output,
    Show,
    ShowClock,
    Tick,
    TickAgent,
    TickRecorder,
)

__all__ = ["InProcessTeam"]


@dataclass
class _Counts:
    odometry: int = 0
    readings: int = 0
    commands: int = 0
    team: int = 0
    published: int = 0


@dataclass
class InProcessTeam:
    """Carries a conductor's outputs to members and their answers back, in a made-up order.

    Attributes:
        answers_recorder: whether the recorder answers its ticks.
        records: what members did.
        outputs: all that the conductor asked for.
    """

    site: Site
    conductor: Conductor
    rng: random.Random
    answers_recorder: bool = True
    records: RunRecords = field(default_factory=RunRecords)
    outputs: list[Output] = field(default_factory=list)

    def __post_init__(self) -> None:
        """Create the members."""
        names = self.site.scenario.agents
        atlas = Atlas(self.site.grid)
        self.members = {n: create(n, self.site, Pacing.EVENT, atlas) for n in names}
        self.counts = {name: _Counts() for name in names}
        self.seen: Counter[str] = Counter()
        # What is under way to the conductor: each topic keeps its order, and overtakes the others.
        self.commands: dict[str, deque[tuple[float, float]]] = {name: deque() for name in names}
        self.answers: dict[str, deque[Answer]] = {name: deque() for name in (*names, RECORDER)}

    def run(self) -> None:
        """Run until the sim leaves, or nothing is under way any more."""
        self.perform(self.conductor.begin(0))
        while self.deliver_one():
            pass

    def deliver_one(self) -> bool:
        """Bring a command or an answer to the conductor; tell whether one was under way."""
        waiting = [
            (queues, name)
            for queues in (self.commands, self.answers)
            for name, queue in queues.items()
            if queue
        ]
        if not waiting:
            return False
        queues, name = self.rng.choice(waiting)
        if queues is self.commands:
            command = self.commands[name].popleft()
            self.perform(self.conductor.take_command(name, *command, wall_ns=0))
        else:
            self.perform(self.conductor.take_answer(self.answers[name].popleft()))
        return True

    def perform(self, outputs: Sequence[Output]) -> None:
        """Do what the conductor asks for."""
        for output in outputs:
            self.outputs.append(output)
            match output:
                case ShowClock():
                    self.seen["clock"] += 1
                case Show(observation):
                    self._show(observation)
                case TickAgent(agent, tick):
                    self._act(agent, tick)
                case TickRecorder(tick):
                    self._record(tick)
                case Leave():
                    assert not any(self.answers.values())
                case _:
                    raise AssertionError(output)

    def _show(self, observation: Observation) -> None:
        match observation:
            case Odometry():
                self.seen["odometry"] += 1
                self._show_odometry(observation)
            case Connectivity():
                self.seen["connectivity"] += 1
                self._show_connectivity(observation)
            case Occupancy():
                self.seen["map"] += 1
                for member in self.members.values():
                    member.see_map(observation.stamp_ns, observation.grid.free)
            case Reading(agent=agent):
                self.seen["reading"] += 1
                self.counts[agent].readings += 1
                self.members[agent].see_reading(observation.stamp_ns, observation.value)

    def _show_odometry(self, odometry: Odometry) -> None:
        self.counts[odometry.agent].odometry += 1
        self.members[odometry.agent].see_odometry(
            odometry.stamp_ns, odometry.pose, odometry.linear_mps, odometry.angular_radps
        )

    def _show_connectivity(self, connectivity: Connectivity) -> None:
        names = list(self.members)
        for index, name in enumerate(names):
            pairs = zip(connectivity.edges, connectivity.distances_m, strict=True)
            near = {names[i + j - index]: apart_m for (i, j), apart_m in pairs if index in (i, j)}
            self.members[name].see_neighbours(connectivity.stamp_ns, near)

    def _act(self, name: str, tick: Tick) -> None:
        counts, member = self.counts[name], self.members[name]
        assert tick.odometry_count == counts.odometry
        assert tick.connectivity_count == self.seen["connectivity"]
        assert tick.map_count == self.seen["map"]
        assert tick.reading_count == counts.readings
        teams = [others.team for others in self.counts.values()]
        assert all(due <= sent for due, sent in zip(tick.agent_counts, teams, strict=True))
        if not tick.stop:
            for action in member.step(tick.time_ns):
                match action:
                    case Drive(linear_mps, angular_radps):
                        counts.commands += 1
                        self.commands[name].append((linear_mps, angular_radps))
                    case SendMessage(message) | SayEstimate(message):
                        counts.team += 1
                        self._say(name, message, tick.time_ns)
                    case ReportTask(event):
                        self.records.tasks.append(TaskRecord(tick.time_ns, name, event))
                    case HoldStrategy(strategy):
                        record = StrategyRecord(tick.time_ns, name, strategy)
                        self.records.strategies.append(record)
                    case ReportEstimate(value, measured):
                        has_measured = measured is not None
                        self.records.estimates.append(
                            EstimateRecord(tick.time_ns, name, value, measured or 0.0, has_measured)
                        )
                    case _:
                        continue
                counts.published += 1
        self.answers[name].append(
            Answer(
                name=name,
                sequence=tick.sequence,
                ready=True,
                next_need_ns=member.next_need_ns,
                team_messages=counts.team,
                commands=counts.commands,
                published=counts.published,
                meetings_ended=member.meetings_ended,
                measured_at=member.measured_at,
            )
        )

    def _say(self, sender: str, message: TeamMessage, now_ns: int) -> None:
        for name, member in self.members.items():
            if name != sender:
                member.receive(message, now_ns)

    def _record(self, tick: Tick) -> None:
        assert tick.odometry_count == self.seen["odometry"]
        assert tick.connectivity_count == self.seen["connectivity"]
        assert tick.map_count == self.seen["map"]
        assert tick.clock_count == self.seen["clock"]
        assert tick.reading_count == self.seen["reading"]
        if tick.stop:
            published = tuple(counts.published for counts in self.counts.values())
            assert tick.agent_counts == published
        if self.answers_recorder:
            self.answers[RECORDER].append(Answer(RECORDER, tick.sequence, ready=True))
