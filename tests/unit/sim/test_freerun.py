"""The sim's conductor with a clock that runs freely."""

from collections.abc import Sequence
from itertools import pairwise

import numpy as np
import pytest

from tlcomm_core.field.field import Field
from tlcomm_core.field.sensors import Sensors
from tlcomm_core.geometry import Pose
from tlcomm_core.workspace.grid import Grid
from tlcomm_core.world.lockstep import StopRule
from tlcomm_core.world.observation import Connectivity, Odometry, Reading
from tlcomm_core.world.world import Body, Noise, World
from tlcomm_sim.conductor import RECORDER
from tlcomm_sim.freerun import FreeRunConductor
from tlcomm_sim.outputs import Answer, Leave, Output, Show, ShowClock, TickAgent, TickRecorder, Warn

MS = 1_000_000
AGENTS = ("a", "b")


def conductor_of(
    *, factor: float = 1.0, until_s: float | None = None, has_recorder: bool = True
) -> FreeRunConductor:
    """Return a conductor of two agents in an empty room; the run ends after two meetings."""
    bodies = [
        Body(name, Pose(x_m, 1.0, 0.0), 1.0, 1.5)
        for name, x_m in zip(AGENTS, (1.0, 1.5), strict=True)
    ]
    world = World(bodies, Grid((10.0, 10.0), 0.5, []), 1.0, Noise(), np.random.default_rng(0))
    until_ns = None if until_s is None else round(until_s * 1e9)
    stop = StopRule(2, until_ns)
    return FreeRunConductor(world, AGENTS, stop, factor, has_recorder=has_recorder)


def odometry_of(outputs: Sequence[Output], agent: str) -> list[Odometry]:
    """Return an agent's odometry among outputs."""
    shown = [output.observation for output in outputs if isinstance(output, Show)]
    return [seen for seen in shown if isinstance(seen, Odometry) and seen.agent == agent]


def test_world_is_shown_at_the_start() -> None:
    """The clock, everybody's odometry and the connectivity are shown at once."""
    outputs = conductor_of().begin(5_000 * MS)
    assert outputs[0] == ShowClock(0)
    assert all(len(odometry_of(outputs, agent)) == 1 for agent in AGENTS)
    assert isinstance(outputs[-1], Show)
    assert isinstance(outputs[-1].observation, Connectivity)


@pytest.mark.parametrize("factor", [0.5, 1.0, 4.0])
def test_clock_follows_the_wall(factor: float) -> None:
    """Simulated time is the factor times the wall time since the start."""
    conductor = conductor_of(factor=factor)
    conductor.begin(5_000 * MS)
    for step in range(1, 51):
        outputs = conductor.pass_time(5_000 * MS + step * 20 * MS)
        assert ShowClock(round(step * 20 * MS * factor)) in outputs


def test_command_acts_when_it_arrives() -> None:
    """A command takes effect at the wall time of its arrival, between two passes of the clock."""
    conductor = conductor_of()
    conductor.begin(0)
    conductor.pass_time(20 * MS)
    (shown,) = odometry_of(conductor.take_command("a", 1.0, 0.0, 27 * MS), "a")
    assert (shown.stamp_ns, shown.linear_mps) == (27 * MS, 1.0)
    assert odometry_of(conductor.pass_time(127 * MS), "a")[-1].pose.x_m == pytest.approx(1.1)


def test_moving_agents_are_shown_at_20_hz() -> None:
    """In motion odometry comes every 50 to 60 ms, once per instant; at rest every second."""
    conductor = conductor_of()
    conductor.begin(0)
    outputs = conductor.take_command("a", 1.0, 0.0, 0)
    for step in range(1, 101):
        outputs += conductor.pass_time(step * 20 * MS)
    stamps = [shown.stamp_ns for shown in odometry_of(outputs, "a")]
    assert len(set(stamps)) == len(stamps)
    assert max(later - earlier for earlier, later in pairwise(stamps)) <= 60 * MS
    assert len(odometry_of(outputs, "b")) == 2


def test_who_says_that_it_has_measured_reads_its_sensor() -> None:
    """If it truly is at the station, and as long as the run isn't over."""
    conductor = conductor_of(until_s=1.0)
    conductor._world.equip(Sensors(Field(((0.0, 7.0),), {"m": 0.0}), {"m": (1.0, 1.0, 0.1)}))
    conductor.begin(0)
    conductor.pass_time(20 * MS)
    there, elsewhere, stranger = (
        conductor.take_answer(Answer(name, 0, ready=True, measured_at="m"))
        for name in ("a", "b", "nobody")
    )
    assert there == [Show(Reading(20 * MS, "a", "m", 7.0))]
    assert elsewhere == stranger == []
    for wall_ms in range(220, 1_400, 200):
        conductor.pass_time(wall_ms * MS)
    assert conductor.take_answer(Answer("a", 0, ready=True, measured_at="m")) == []


def test_long_pause_slips_and_is_told() -> None:
    """A sim that stood still lets time slip instead of leaping, and says so once per loss."""
    conductor = conductor_of(factor=2.0)
    conductor.begin(0)
    outputs = conductor.pass_time(1_250 * MS)
    assert conductor.time_ns == 500 * MS
    assert sum(isinstance(output, Warn) for output in outputs) == 1
    outputs = conductor.pass_time(1_270 * MS)
    assert conductor.time_ns == 540 * MS
    assert not any(isinstance(output, Warn) for output in outputs)


def end(conductor: FreeRunConductor, outputs: Sequence[Output]) -> None:
    """Answer the last ticks; check the order of leaving."""
    ticks = [output for output in outputs if isinstance(output, TickAgent)]
    assert [tick.agent for tick in ticks] == list(AGENTS)
    assert all(tick.tick.stop for tick in ticks)
    assert conductor.pass_time(10**12) == []
    assert conductor.take_command("a", 1.0, 0.0, 10**12) == []
    first, second = (Answer(t.agent, t.tick.sequence, ready=True, published=7) for t in ticks)
    assert conductor.take_answer(first) == []
    (recorder,) = conductor.take_answer(second)
    assert isinstance(recorder, TickRecorder)
    assert recorder.tick.agent_counts == (7, 7)
    assert conductor.take_answer(Answer(RECORDER, recorder.tick.sequence, ready=True)) == [Leave()]


def test_end_by_meetings() -> None:
    """The run is over when the slowest agent has ended its meetings."""
    conductor = conductor_of()
    conductor.begin(0)
    conductor.take_answer(Answer("a", 0, ready=True, meetings_ended=2))
    assert not any(isinstance(output, TickAgent) for output in conductor.pass_time(20 * MS))
    conductor.take_answer(Answer("b", 0, ready=True, meetings_ended=2))
    end(conductor, conductor.pass_time(40 * MS))


def test_end_by_time() -> None:
    """The run is over at the given time exactly, however late the sim is run."""
    conductor = conductor_of(until_s=0.105)
    conductor.begin(0)
    outputs = conductor.pass_time(200 * MS)
    assert conductor.time_ns == 105 * MS
    end(conductor, outputs)
