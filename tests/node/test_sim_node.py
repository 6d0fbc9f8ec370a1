"""The sim's node, with a test in the place of all agents."""

from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from geometry_msgs.msg import TwistStamped
from nav_msgs.msg import OccupancyGrid
from nav_msgs.msg import Odometry as OdometryMessage
from rclpy.context import Context
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.publisher import Publisher
from rclpy.qos import DurabilityPolicy, QoSProfile
from rosgraph_msgs.msg import Clock

from support.spinning import SpunNodes
from tlcomm_agent.wire import encode_drive
from tlcomm_core.agent.actions import Drive
from tlcomm_core.errors import InputError
from tlcomm_core.scenario.loader import load_scenario
from tlcomm_msgs import msg
from tlcomm_sim import node as module
from tlcomm_sim.node import RunBrokenError, SimNode, main

CORRIDOR = Path(__file__).parents[2] / "scenarios" / "corridor.yaml"
NAMES = tuple(load_scenario(CORRIDOR).agents)


def parameters(**values: object) -> list[Parameter]:
    """Return parameters of a sim of the corridor, some of them changed."""
    chosen = {"scenario": str(CORRIDOR), "pace": "lockstep", "until_s": 1.5, **values}
    return [Parameter(name, value=value) for name, value in chosen.items()]


class Team(SpunNodes):
    """A node that speaks for every agent, beside the sim's."""

    def __init__(self, context: Context, **values: object) -> None:
        """Create both; ``values`` change the sim's parameters."""
        self.began = False
        self.progress: list[tuple[int, int]] = []
        self.sim = SimNode(
            parameters=parameters(**values),
            context=context,
            on_ready=self._note_begin,
            on_progress=lambda *progress: self.progress.append(progress),
        )
        self.node = Node("test", context=context, use_global_arguments=False)
        super().__init__(context, self.sim, self.node)
        self.ticks: dict[str, list[msg.Tick]] = {name: [] for name in NAMES}
        self.odometry: dict[str, list[OdometryMessage]] = {name: [] for name in NAMES}
        self.connectivity: list[msg.Connectivity] = []
        self.clocks: list[Clock] = []
        self.maps: list[OccupancyGrid] = []
        held = QoSProfile(depth=100, durability=DurabilityPolicy.TRANSIENT_LOCAL)
        self.commands: dict[str, list[Drive]] = {name: [] for name in NAMES}
        self.silent: set[str] = set()
        self.commanded = dict.fromkeys(NAMES, 0)
        self.answer_pub = self.node.create_publisher(msg.TickReply, "/tick_reply", 100)
        self.command_pubs = {name: self._be(name) for name in NAMES}
        subscribe = self.node.create_subscription
        # Every agent has its own; the sim counts them.
        for _ in NAMES:
            subscribe(msg.Connectivity, "/connectivity", self.connectivity.append, 100)
            subscribe(OccupancyGrid, "/map", self.maps.append, held)
        subscribe(Clock, "/clock", self.clocks.append, 100)
        # The sim waits for one publisher of answers per agent.
        self.extra = [self.node.create_publisher(msg.TickReply, "/tick_reply", 1) for _ in NAMES]

    def _note_begin(self) -> None:
        self.began = True

    def _be(self, name: str) -> Publisher:
        subscribe = self.node.create_subscription
        subscribe(OdometryMessage, f"/{name}/odom", self.odometry[name].append, 100)
        subscribe(msg.Tick, f"/{name}/tick", lambda tick: self._take(name, tick), 100)
        return self.node.create_publisher(TwistStamped, f"/{name}/cmd_vel", 100)

    def _take(self, name: str, tick: msg.Tick) -> None:
        self.ticks[name].append(tick)
        if name in self.silent:
            return
        for drive in self.commands[name] if not tick.stop else []:
            self.commanded[name] += 1
            self.command_pubs[name].publish(encode_drive(drive, name, tick.time_ns))
        self.commands[name] = []
        self.answer(name, tick.sequence)

    def answer(self, name: str, sequence: int, *, meetings_ended: int = 0) -> None:
        """Answer a tick, or with 0 say that an agent is ready."""
        self.answer_pub.publish(
            msg.TickReply(
                agent=name,
                sequence=sequence,
                ready=True,
                commands=self.commanded[name],
                meetings_ended=meetings_ended,
            )
        )

    def begin(self) -> None:
        """Let all agents be ready, and wait for the begin."""
        self.until(lambda: self.answer_pub.get_subscription_count() > 0)
        for name in NAMES:
            assert not self.began
            self.answer(name, 0)
        self.until(lambda: self.began)


@pytest.fixture
def create(context: Context) -> Iterator[Callable[..., Team]]:
    """Yield a maker of teams that are cleared away."""
    teams: list[Team] = []

    def make(**values: object) -> Team:
        teams.append(Team(context, **values))
        return teams[-1]

    yield make
    for team in teams:
        team.close()


def test_lock_step_from_begin_to_end(create: Callable[..., Team]) -> None:
    """All are ticked at t = 0, commands are carried out, time goes on, all are told the end."""
    team = create()
    team.commands[NAMES[0]] = [Drive(0.0, 0.5), Drive(0.0, 1.0)]
    team.begin()
    team.until(lambda: team.sim.is_done)
    first = {name: ticks[0] for name, ticks in team.ticks.items()}
    last = {name: ticks[-1] for name, ticks in team.ticks.items()}
    assert all(tick.time_ns == 0 and tick.odometry_count == 1 for tick in first.values())
    assert all(tick.stop and tick.time_ns == 1_500_000_000 for tick in last.values())
    counts = [tick.odometry_count for tick in last.values()]
    team.until(lambda: [len(seen) for seen in team.odometry.values()] == counts)
    # The last command of a tick is the one that counts.
    turned = team.odometry[NAMES[0]][1]
    assert (turned.header.stamp.sec, turned.twist.twist.angular.z) == (0, 1.0)
    team.until(lambda: len(team.clocks) == 16)
    # One map, seen by each.
    assert [message.header.stamp.sec for message in team.maps] == [0] * len(NAMES)
    assert all(tick.map_count == 1 for tick in first.values())
    assert team.progress[-1] == (1_500_000_000, 0)


def test_free_running_from_begin_to_end(create: Callable[..., Team]) -> None:
    """The clock runs by itself, commands are carried out, and the end is when all have met."""
    team = create(pace=2.0, until_s=600.0, rounds=0)
    team.begin()
    team.command_pubs[NAMES[0]].publish(encode_drive(Drive(0.0, 1.0), NAMES[0], 0))
    team.until(lambda: len(team.odometry[NAMES[0]]) > 5)
    for name in NAMES:
        team.answer(name, 0, meetings_ended=1)
    team.until(lambda: team.sim.is_done)
    assert all(len(ticks) == 1 and ticks[0].stop for ticks in team.ticks.values())
    stamps = [clock.clock.sec * 10**9 + clock.clock.nanosec for clock in team.clocks]
    assert stamps == sorted(stamps)


def test_silent_agent_is_named(
    create: Callable[..., Team], monkeypatch: pytest.MonkeyPatch
) -> None:
    """An agent that doesn't answer in time ends the run, by name."""
    monkeypatch.setattr(module, "_ANSWER_DEADLINE_S", 0.3)
    team = create()
    team.silent = {NAMES[1]}
    team.begin()
    with pytest.raises(RunBrokenError, match=f"no answer from {NAMES[1]} within"):
        team.until(lambda: team.sim.is_done)


def test_nothing_begins_before_all_are_ready(create: Callable[..., Team]) -> None:
    """With one agent missing there is no tick, however long it takes."""
    team = create()
    team.until(lambda: team.answer_pub.get_subscription_count() > 0)
    for name in NAMES[1:]:
        team.answer(name, 0)
    for _ in range(50):
        team.executor.spin_once(timeout_sec=0.01)
    assert not team.began
    assert not any(team.ticks.values())
    team.answer(NAMES[0], 0)
    team.until(lambda: team.began)


@pytest.mark.parametrize(
    ("changed", "reason"),
    [
        ({"scenario": ""}, "scenario"),
        ({"scenario": "missing.yaml"}, "missing.yaml"),
        ({"pace": "0"}, "pace: '0'"),
        ({"seed": -1}, "seed: -1"),
        ({"rounds": -1}, "rounds: -1"),
        ({"rounds": 1.5}, "rounds: 1.5"),
        ({"until_s": 0.0}, "until_s: 0.0"),
    ],
)
def test_bad_parameters(context: Context, changed: dict[str, object], reason: str) -> None:
    """What can't be used is an input error of one line that names it."""
    with pytest.raises(InputError, match=reason) as caught:
        SimNode(parameters=parameters(**changed), context=context)
    assert "\n" not in str(caught.value)


def test_executable_says_what_is_wrong(
    domain: int, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    """The executable exits with 2 and one line."""
    monkeypatch.setenv("ROS_DOMAIN_ID", str(domain))
    assert main(["--ros-args", "-p", "scenario:=missing.yaml"]) == 2
    assert capsys.readouterr().err.count("\n") == 1
