"""The recorder, with a test in the place of sim and agents."""

import signal
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
from ament_index_python.packages import get_package_share_directory
from builtin_interfaces.msg import Time
from rclpy.context import Context
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile
from rosgraph_msgs.msg import Clock
from visualization_msgs.msg import MarkerArray

from support.hand_made_run import AGENTS, hand_made_scenario
from support.spinning import SpunNodes
from tlcomm_agent import node as agent_node
from tlcomm_core.method import Method
from tlcomm_msgs import msg
from tlcomm_sim import node as sim_node
from tlcomm_tools.bag.container import read_container
from tlcomm_tools.bag.definitions import load_typestore, read_definition
from tlcomm_tools.bag.metadata import qos_text
from tlcomm_tools.bag.topics import mirror_topics, recorded_topics
from tlcomm_tools.bag.writer import BagWriter
from tlcomm_tools.mirror.mirror import Mirror
from tlcomm_tools.runtime import recorder
from tlcomm_tools.runtime.notify import Failed, Note, Notifier, Started
from tlcomm_tools.runtime.spin import spin


class Notes(Notifier):
    """Keeps what a supervisor would be told."""

    def __init__(self) -> None:
        super().__init__(None)
        self.told: list[Note] = []

    def tell(self, note: Note) -> None:
        """Keep a note."""
        self.told.append(note)


class World:
    """What shows the clock and ticks the recorder."""

    def __init__(self, context: Context) -> None:
        self.node = Node("test", context=context, use_global_arguments=False)
        self.clock_pub = self.node.create_publisher(Clock, "/clock", 10)
        self.tick_pub = self.node.create_publisher(msg.Tick, "/recorder/tick", 10)
        self.answers: list[Any] = []
        self.node.create_subscription(msg.TickReply, "/tick_reply", self.answers.append, 10)

    def is_found(self) -> bool:
        """Tell whether the recorder has found the clock and the ticks."""
        publishers = (self.clock_pub, self.tick_pub)
        return all(publisher.get_subscription_count() for publisher in publishers)

    def answered(self) -> bool:
        """Tell whether tick 1 has been answered."""
        return any(answer.sequence == 1 for answer in self.answers)

    def tick(self) -> None:
        """Tick the recorder, two messages of the clock having been published."""
        self.tick_pub.publish(msg.Tick(sequence=1, clock_count=2, agent_counts=[0, 0]))


class Recording(SpunNodes):
    """A recorder beside a world."""

    def __init__(self, context: Context, folder: Path) -> None:
        store = load_typestore(Path(get_package_share_directory("tlcomm_msgs")))
        scenario, recorded = hand_made_scenario(), recorded_topics(AGENTS)
        mirror = Mirror(scenario, Method.TEAM, recorded, store)
        topics = (*recorded, *mirror.topics)
        definitions = {topic.type: read_definition(store, topic.type) for topic in topics}
        self.notes = Notes()
        self.writer = BagWriter(folder, topics, definitions, {})
        settings = recorder.RecorderSettings(folder, scenario)
        self.recorder = recorder.Recorder(settings, self.writer, mirror, self.notes, context)
        self.world = World(context)
        super().__init__(context, self.recorder, self.world.node)

    def close(self) -> None:
        """Take everything down."""
        super().close()
        self.writer.close()


@pytest.fixture
def recording(context: Context, tmp_path: Path) -> Iterator[Recording]:
    """Yield a recorder that has found a world."""
    own = Recording(context, tmp_path / "bag")
    own.until(own.world.is_found)
    yield own
    own.close()


def test_a_tick_waits_for_all_that_it_counts(recording: Recording) -> None:
    """A tick isn't answered before all that was published has arrived."""
    world = recording.world
    world.tick()
    world.clock_pub.publish(Clock())
    recording.settle()
    assert not world.answered()
    world.clock_pub.publish(Clock())
    recording.until(world.answered)


def test_in_lock_step_the_bag_grows_at_answers_only(recording: Recording) -> None:
    """However much time goes by, the file never holds part of what one tick counts, or more."""
    world, size = recording.world, recording.writer.path.stat().st_size
    recording.writer._period_s = 0.0
    world.clock_pub.publish(Clock(clock=Time(sec=5)))
    world.tick()
    recording.until(lambda: recording.recorder._tick is not None)
    world.clock_pub.publish(Clock())
    recording.until(lambda: recording.recorder._backlog.total == 1)
    recording.recorder._on_timer()
    assert recording.writer.path.stat().st_size == size
    world.clock_pub.publish(Clock())
    recording.until(lambda: recording.writer.path.stat().st_size > size)
    recording.until(world.answered)
    held = read_container(recording.writer.path, lambda _: True)
    assert held.end_ns == 0


def test_mirrors_are_there_for_viewers(recording: Recording) -> None:
    """An answered tick shows the team; a viewer that comes later sees the regions as well."""
    world, teams, regions = recording.world, [], []
    world.node.create_subscription(MarkerArray, "/team_markers", teams.append, 10)
    mirrors = recording.recorder._mirrors
    recording.until(lambda: any(own.get_subscription_count() for own in mirrors))
    world.tick()
    world.clock_pub.publish(Clock())
    world.clock_pub.publish(Clock())
    recording.until(lambda: bool(teams))
    latched = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
    world.node.create_subscription(MarkerArray, "/region_markers", regions.append, latched)
    recording.until(lambda: bool(regions))
    names = [marker.text for marker in regions[0].markers if marker.text]
    assert names == ["left", "right"]
    recording.writer.flush()
    held = read_container(recording.writer.path, lambda _: True)
    counts = {held.channels[number].topic: count for number, count in held.counts.items()}
    assert counts["/team_markers"] == counts["/region_markers"] == 1


def test_it_names_what_a_tick_waits_for(
    recording: Recording, monkeypatch: pytest.MonkeyPatch
) -> None:
    """When its patience is over it gives up, and says of what how much is missing."""
    monkeypatch.setattr(recorder, "_PATIENCE_S", 0.0)
    recording.world.clock_pub.publish(Clock())
    recording.until(lambda: recording.recorder._is_running)
    recording.world.tick()
    recording.until(lambda: bool(recording.notes.told))
    assert recording.notes.told[0] == Failed("hasn't arrived: 1 of clock", 3)


def test_a_bag_says_how_its_topics_are_offered() -> None:
    """The depths in a bag's description are those of the agents' publishers."""
    assert f"depth: {agent_node._DEPTH}\n" in qos_text(latched=False)
    assert f"depth: {agent_node._HELD_STRATEGIES}\n" in qos_text(latched=True)


def test_its_patience_ends_before_the_sims() -> None:
    """Otherwise the sim could only say that the recorder doesn't answer."""
    assert recorder._PATIENCE_S + 1.0 < sim_node._ANSWER_DEADLINE_S


def test_what_is_under_way_when_a_signal_comes_is_recorded(
    context: Context, domain: int, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """After Ctrl-C what others said before they stopped comes into the bag, after a silence too."""
    monkeypatch.setenv("ROS_DOMAIN_ID", str(domain))
    notes, world, phases = Notes(), World(context), []

    def spin_after_signal(node: Node, done: Callable[[], bool]) -> None:
        phases.append(node)
        if len(phases) > 1:
            spin(node, done)
            return
        spin(node, lambda: world.is_found() and node.is_quiet)
        world.clock_pub.publish(Clock())
        signal.raise_signal(signal.SIGINT)
        assert done()

    settings = recorder.RecorderSettings(tmp_path / "bag", hand_made_scenario())
    assert recorder.run(settings, spin_after_signal, notes) == 0
    world.node.destroy_node()
    assert notes.told == [Started()]
    (path,) = (tmp_path / "bag").glob("*.mcap")
    held = read_container(path, lambda _: True)
    counts = {held.channels[number].topic: count for number, count in held.counts.items()}
    assert counts.pop("/clock") == 1
    assert {name for name, count in counts.items() if count} == {
        topic.name for topic in mirror_topics(AGENTS)
    }


def test_a_bag_goes_nowhere_where_something_is(tmp_path: Path) -> None:
    """A bag that can't be made is bad input, told with its name."""
    notes = Notes()
    settings = recorder.RecorderSettings(tmp_path, hand_made_scenario())
    assert recorder.run(settings, spin, notes) == 2
    assert notes.told == [Failed(f"can't write {str(tmp_path)!r}: File exists", 2)]
