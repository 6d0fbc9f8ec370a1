"""The agent's node, with a test in the place of sim and neighbours."""

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from geometry_msgs.msg import TwistStamped
from nav_msgs.msg import OccupancyGrid
from nav_msgs.msg import Odometry as OdometryMessage
from rclpy.context import Context
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.qos import DurabilityPolicy, QoSProfile
from std_msgs.msg import Header

from support.measuring_corridor import measuring_corridor
from support.spinning import SpunNodes
from tlcomm_agent.node import AgentNode, main
from tlcomm_core.errors import InputError
from tlcomm_core.geometry import Pose
from tlcomm_core.scenario.loader import dumps, load_scenario
from tlcomm_core.scenario.site import grid_of
from tlcomm_core.world.observation import Connectivity, Occupancy, Odometry, Reading
from tlcomm_msgs import msg
from tlcomm_sim.outputs import Tick
from tlcomm_sim.wire import (
    encode_connectivity,
    encode_occupancy,
    encode_odometry,
    encode_reading,
    encode_tick,
)

CORRIDOR = Path(__file__).parents[2] / "scenarios" / "corridor.yaml"
SCENARIO = load_scenario(CORRIDOR)
NAMES = tuple(SCENARIO.agents)
OWN, PEER = NAMES[0], NAMES[1]


def parameters(**values: object) -> list[Parameter]:
    """Return parameters of an agent in the corridor, some of them changed."""
    chosen = {"scenario": str(CORRIDOR), "pace": "lockstep", **values}
    return [Parameter(name, value=value) for name, value in chosen.items()]


class Surroundings(SpunNodes):
    """An agent's node beside one that speaks for everybody else."""

    def __init__(self, context: Context, **values: object) -> None:
        """Create both, and wait until they have found each other; ``values`` are parameters."""
        self.agent = AgentNode(namespace=OWN, parameters=parameters(**values), context=context)
        self.node = Node("test", context=context, use_global_arguments=False)
        super().__init__(context, self.agent, self.node)
        create, subscribe = self.node.create_publisher, self.node.create_subscription
        self.tick_pub = create(msg.Tick, f"/{OWN}/tick", 10)
        self.odometry_pub = create(OdometryMessage, f"/{OWN}/odom", 10)
        self.connectivity_pub = create(msg.Connectivity, "/connectivity", 10)
        held = QoSProfile(depth=10, durability=DurabilityPolicy.TRANSIENT_LOCAL)
        self.map_pub = create(OccupancyGrid, "/map", held)
        self.response_pub = create(msg.BestResponse, f"/{PEER}/best_response", 10)
        self.answers: list[Any] = []
        self.events: list[Any] = []
        self.offers: list[Any] = []
        subscribe(msg.TickReply, "/tick_reply", self.answers.append, 10)
        subscribe(msg.TaskEvent, f"/{OWN}/task_event", self.events.append, 10)
        subscribe(msg.PlanOffer, f"/{OWN}/plan_offer", self.offers.append, 10)
        subscribe(TwistStamped, f"/{OWN}/cmd_vel", lambda _: None, 10)
        own = (self.tick_pub, self.odometry_pub, self.connectivity_pub, self.map_pub)
        own += (self.response_pub,)
        self.until(lambda: all(publisher.get_subscription_count() for publisher in own))
        self.until(lambda: bool(self.answers))

    def answered(self, sequence: int) -> bool:
        """Tell whether a tick has been answered."""
        return any(answer.sequence == sequence for answer in self.answers)

    def tick(
        self, sequence: int, counts: tuple[int, int, int], *, maps: int = 0, stop: bool = False
    ) -> None:
        """Tick the agent after a hop; counts: odometry, connectivity, the peer's messages."""
        odometry, connectivity, team = counts
        agent_counts = tuple(team if name == PEER else 0 for name in NAMES)
        tick = Tick(sequence, 10_000_000, odometry, connectivity, 0, maps, agent_counts, stop)
        self.tick_pub.publish(encode_tick(tick))

    def show(self) -> None:
        """Show the agent where it is and that all are in range."""
        self.show_odometry()
        self.show_connectivity()

    def show_odometry(self) -> None:
        """Show the agent that it rests at its start."""
        start = Pose(*SCENARIO.agents[OWN].start).as_transmitted()
        self.odometry_pub.publish(encode_odometry(Odometry(0, OWN, start, 0.0, 0.0)))

    def show_map(self) -> None:
        """Show the agent the scenario's map."""
        self.map_pub.publish(encode_occupancy(Occupancy(0, grid_of(SCENARIO.workspace))))

    def show_connectivity(
        self, edges: tuple[tuple[int, int], ...] = ((0, 1), (0, 2), (1, 2))
    ) -> None:
        """Show who is in range of whom, by default all of all."""
        self.connectivity_pub.publish(
            encode_connectivity(Connectivity(0, edges, connected=True), 1.0, NAMES)
        )


def response(**fields: object) -> msg.BestResponse:
    """Return a well-formed best response of the peer's, some fields of it changed."""
    strategy = msg.Strategy(agent=PEER)
    return msg.BestResponse(**{"sender": PEER, "candidate": PEER, "strategy": strategy, **fields})


@pytest.fixture
def surroundings(context: Context) -> Iterator[Surroundings]:
    """Yield an agent in lock step with its surroundings."""
    own = Surroundings(context)
    yield own
    own.close()


@pytest.fixture
def free(context: Context) -> Iterator[Surroundings]:
    """Yield an agent that runs freely with its surroundings."""
    own = Surroundings(context, pace="1.0")
    yield own
    own.close()


@pytest.mark.parametrize("last", ["odometry", "connectivity", "map", "message"])
def test_tick_waits_for_all_that_it_counts(surroundings: Surroundings, last: str) -> None:
    """A tick isn't answered before everything has come that it counts; then at once, and once."""
    show = {
        "odometry": surroundings.show_odometry,
        "connectivity": surroundings.show_connectivity,
        "map": surroundings.show_map,
        "message": lambda: surroundings.response_pub.publish(response()),
    }
    surroundings.tick(1, (1, 1, 1), maps=1)
    for name, show_it in show.items():
        if name != last:
            show_it()
    surroundings.settle()
    assert not surroundings.answered(1)
    show[last]()
    surroundings.until(lambda: surroundings.answered(1))
    surroundings.settle()
    (answer,) = [answer for answer in surroundings.answers if answer.sequence == 1]
    assert answer.agent == OWN
    assert answer.has_next_need
    assert answer.team_messages == len(surroundings.offers) == 1
    published = answer.team_messages + answer.commands + len(surroundings.events)
    assert answer.published == published


def test_what_it_has_heard_it_tells_at_the_end(surroundings: Surroundings) -> None:
    """All of it, counted among what it has published."""
    hearings: list[Any] = []
    surroundings.node.create_subscription(msg.Hearing, f"/{OWN}/hearing", hearings.append, 10)
    surroundings.show()
    surroundings.response_pub.publish(response())
    surroundings.tick(1, (1, 1, 1))
    surroundings.until(lambda: surroundings.answered(1))
    assert not hearings
    surroundings.tick(2, (1, 1, 1), stop=True)
    surroundings.until(lambda: surroundings.answered(2) and bool(hearings))
    (told,) = hearings
    assert (told.agent, told.agents, list(told.sender)) == (OWN, [PEER], [0])
    assert list(told.topic) == [msg.Hearing.BEST_RESPONSE]
    assert (list(told.said), list(told.heard)) == ([0], [10_000_000])
    first, last = (
        next(own.published for own in surroundings.answers if own.sequence == sequence)
        for sequence in (1, 2)
    )
    assert last - first == 2, "what was undelivered, and what was heard"


def test_a_tick_waits_for_the_readings_that_it_counts(context: Context, tmp_path: Path) -> None:
    """If there is anything to measure; then the agent says what it takes the field to be."""
    scenario = tmp_path / "field.yaml"
    scenario.write_text(dumps(measuring_corridor()), "utf-8")
    own = Surroundings(context, scenario=str(scenario))
    estimates: list[msg.Estimate] = []
    own.node.create_subscription(msg.Estimate, f"/{OWN}/estimate", estimates.append, 10)
    reading_pub = own.node.create_publisher(msg.Reading, f"/{OWN}/reading", 10)
    own.until(lambda: reading_pub.get_subscription_count() > 0)
    own.show()
    tick = encode_tick(Tick(1, 10_000_000, 1, 1, 0, 0, (0, 0, 0), reading_count=2))
    own.tick_pub.publish(tick)
    own.settle()
    assert not own.answered(1)
    reading_pub.publish(msg.Reading(agent=PEER, value=9.0))
    reading_pub.publish(encode_reading(Reading(9_000_000, OWN, "west_bench", 51.5)))
    own.until(lambda: own.answered(1) and bool(estimates))
    assert [(said.value, said.last_measurement) for said in estimates] == [(51.5, 51.5)]
    ((reason, count),) = own.agent.ignored.items()
    assert (reason.split(":")[0], count) == ("reading", 1)
    own.close()


def test_running_freely_it_takes_messages_of_those_in_range(free: Surroundings) -> None:
    """What one says who is out of range waits untaken; in range, it is taken and looked at."""
    free.show_connectivity(edges=((1, 2),))
    free.settle()
    free.response_pub.publish(response(sender="x"))
    free.settle()
    assert not free.agent.ignored
    free.show_connectivity()
    free.until(lambda: bool(free.agent.ignored))
    assert "in the name of" in next(iter(free.agent.ignored))


def test_sim_is_told_who_is_missing(surroundings: Surroundings) -> None:
    """While somebody expected isn't there, the agent says that it isn't ready, and keeps saying."""
    surroundings.answers.clear()
    surroundings.until(lambda: len(surroundings.answers) > 1)
    assert not any(answer.ready for answer in surroundings.answers)
    assert {answer.sequence for answer in surroundings.answers} == {0}


@pytest.mark.parametrize(
    ("message", "reason"),
    [
        (response(change=float("nan")), "change: nan"),
        (response(sender=""), "sender: "),
        (response(sender=NAMES[2]), f"in the name of '{NAMES[2]}'"),
        (b"", "not a BestResponse"),
        (b"\0\1\0\0", "not a BestResponse"),
        (b"\0\1\0\0" + b"\xff" * 40, "not a BestResponse"),
    ],
    ids=["nan", "nameless", "in another's name", "nothing", "truncated", "garbage"],
)
def test_malformed_messages_are_counted_and_ignored(
    surroundings: Surroundings, message: object, reason: str
) -> None:
    """Whatever a peer's topic carries, it counts as received, is noted, and harms nobody."""
    surroundings.response_pub.publish(message)
    surroundings.show()
    surroundings.tick(1, (1, 1, 1))
    surroundings.until(lambda: surroundings.answered(1))
    ((noted, count),) = surroundings.agent.ignored.items()
    assert count == 1
    assert noted.startswith(f"{PEER}: ")
    assert reason in noted


def test_malformed_surroundings_are_counted_and_ignored(surroundings: Surroundings) -> None:
    """An odometry, connectivity or map that can't be used is noted, and harms nobody."""
    surroundings.connectivity_pub.publish(msg.Connectivity(header=Header(), agents=["x"]))
    odometry = OdometryMessage()
    odometry.pose.pose.position.x = float("inf")
    surroundings.odometry_pub.publish(odometry)
    surroundings.map_pub.publish(OccupancyGrid())
    surroundings.tick_pub.publish(msg.Tick(sequence=1))
    surroundings.until(lambda: sum(surroundings.agent.ignored.values()) == 4)
    assert {reason.split(":")[0] for reason in surroundings.agent.ignored} == {
        "odom",
        "connectivity",
        "map",
        "tick",
    }


def test_agent_leaves_after_the_sim(surroundings: Surroundings) -> None:
    """Told that the run is over, the agent answers, and leaves when the sim has gone."""
    surroundings.show()
    surroundings.tick(1, (1, 1, 0))
    surroundings.until(lambda: surroundings.answered(1))
    surroundings.tick(2, (1, 1, 0), stop=True)
    surroundings.until(lambda: surroundings.answered(2))
    surroundings.settle()
    assert not surroundings.agent.is_done
    surroundings.node.destroy_publisher(surroundings.tick_pub)
    surroundings.until(lambda: surroundings.agent.is_done)


@pytest.mark.parametrize(
    ("namespace", "changed", "reason"),
    [
        ("nobody", {}, "'/nobody' is no agent"),
        (None, {}, "'/' is no agent"),
        (OWN, {"scenario": ""}, "scenario"),
        (OWN, {"scenario": 3}, "scenario"),
        (OWN, {"scenario": "missing.yaml"}, "missing.yaml"),
        (OWN, {"pace": "fast"}, "pace: 'fast'"),
        (OWN, {"pace": -1.0}, "pace: '-1.0'"),
        (OWN, {"seed": -1}, "seed: -1"),
    ],
)
def test_bad_parameters(
    context: Context, namespace: str | None, changed: dict[str, object], reason: str
) -> None:
    """What can't be used is an input error of one line that names it."""
    with pytest.raises(InputError, match=reason) as caught:
        AgentNode(namespace=namespace, parameters=parameters(**changed), context=context)
    assert "\n" not in str(caught.value)


def test_executable_says_what_is_wrong(
    domain: int, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    """The executable exits with 2 and one line."""
    monkeypatch.setenv("ROS_DOMAIN_ID", str(domain))
    arguments = ["--ros-args", "-r", "__ns:=/nobody", "-p", f"scenario:={CORRIDOR}"]
    assert main(arguments) == 2
    assert capsys.readouterr().err.count("\n") == 1
