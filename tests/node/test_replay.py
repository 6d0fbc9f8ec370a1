"""A replay as a process of its own, heard by a node in this one."""

import json
import os
import select
import signal
import struct
import subprocess
import sys
from collections.abc import Callable, Iterator
from importlib import import_module
from pathlib import Path

import pytest
from rclpy.context import Context
from rclpy.node import Node
from rclpy.qos import QoSDurabilityPolicy, QoSHistoryPolicy, QoSProfile, QoSReliabilityPolicy

from support.command import run
from support.hand_made_run import (
    AGENTS,
    END_S,
    SHARE,
    _Messages,
    hand_made_records,
    hand_made_scenario,
    serialize_run,
)
from tlcomm_core.scenario.loader import dumps
from tlcomm_core.units import NANOSECONDS_PER_SECOND
from tlcomm_tools.bag.definitions import Definition, load_typestore, read_definition
from tlcomm_tools.bag.topics import Topic, recorded_topics
from tlcomm_tools.bag.writer import BagWriter
from tlcomm_tools.runtime.spin import spin

TOPICS = recorded_topics(AGENTS)
NUMBERS = {topic.name: number for number, topic in enumerate(TOPICS)}
# Several times what the clock's publisher keeps.
CLOCKS = 5000
# A turn without anything to hear takes a tenth of a second.
SILENT_TURNS = 20
Row = tuple[str, int, bytes]


def open_writer(folder: Path) -> BagWriter:
    """Return the writer of a bag like the hand-made run's."""
    store = load_typestore(SHARE)
    definitions = {topic.type: read_definition(store, topic.type) for topic in TOPICS}
    return BagWriter(folder, TOPICS, definitions, {"scenario": dumps(hand_made_scenario())})


def make_rows() -> list[Row]:
    """Return the hand-made run with a clock, in order of time, the clock first."""
    step_ns = int(END_S) * NANOSECONDS_PER_SECOND // CLOCKS
    clock = [
        ("/clock", time_ns, struct.pack("<IiI", 256, *divmod(time_ns, NANOSECONDS_PER_SECOND)))
        for time_ns in range(0, CLOCKS * step_ns, step_ns)
    ]
    rows = [*clock, *serialize_run(load_typestore(SHARE), hand_made_records())]
    return sorted(rows, key=lambda row: row[1])


@pytest.fixture(scope="module")
def bag(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Write the run into a bag."""
    folder = tmp_path_factory.mktemp("original") / "bag"
    with open_writer(folder) as writer:
        for topic, log_ns, data in make_rows():
            writer.write(NUMBERS[topic], log_ns, data)
    return folder


class Listener:
    """Hears topics reliably, however much comes at once."""

    def __init__(self, context: Context, topics: tuple[Topic, ...]) -> None:
        self.node = Node("listener", context=context, use_global_arguments=False)
        self.heard: list[tuple[str, bytes]] = []
        for topic in topics:
            self.listen(topic)

    def listen(self, topic: Topic) -> None:
        """Hear one topic, with what it latches."""
        package, _, name = topic.type.split("/")
        durability = (
            QoSDurabilityPolicy.TRANSIENT_LOCAL if topic.latched else QoSDurabilityPolicy.VOLATILE
        )
        self.node.create_subscription(
            getattr(import_module(f"{package}.msg"), name),
            topic.name,
            lambda data: self.heard.append((topic.name, data)),
            QoSProfile(
                history=QoSHistoryPolicy.KEEP_ALL,
                reliability=QoSReliabilityPolicy.RELIABLE,
                durability=durability,
            ),
            raw=True,
        )

    def hear(self, done: Callable[[], bool], process: "subprocess.Popen[str]") -> None:
        """Hear until something holds, as long as the process lives."""
        spin(self.node, lambda: done() or process.poll() is not None)
        assert done()

    def hear_the_rest(self) -> None:
        """Hear until there is silence."""
        counts: list[int] = []

        def is_silent() -> bool:
            counts.append(len(self.heard))
            return counts[-SILENT_TURNS:] == [len(self.heard)] * SILENT_TURNS

        spin(self.node, is_silent)

    def of(self, topic: str) -> list[bytes]:
        """Return what was heard on one topic."""
        return [data for name, data in self.heard if name == topic]


@pytest.fixture
def listener(context: Context) -> Iterator[Listener]:
    """Yield a node that hears everything."""
    own = Listener(context, TOPICS)
    yield own
    own.node.destroy_node()


def in_words(data: bytes) -> bytes:
    """Return data as the middleware hands it on: filled up to whole words."""
    return data + bytes(-len(data) % 4)


def start(domain: int, bag: Path, *options: str, stdin: int) -> "subprocess.Popen[str]":
    """Start a replay that begins when somebody listens."""
    return subprocess.Popen(
        [sys.executable, "-m", "tlcomm_tools", "replay", str(bag), "--wait", "60", *options],
        env={**os.environ, "ROS_DOMAIN_ID": str(domain)},
        stdin=stdin,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )


def test_every_message_arrives_in_order(
    domain: int,
    bag: Path,
    listener: Listener,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
) -> None:
    """Faster than anybody hears, nothing is lost; and an audit of what was heard is the same."""
    rows = make_rows()
    with start(domain, bag, "--rate", "1e4", "--json", stdin=subprocess.DEVNULL) as process:
        spin(listener.node, lambda: process.poll() is not None)
        out, errors = process.communicate()
    listener.hear_the_rest()
    assert process.returncode == 0, errors
    assert json.loads(out)["messages"] == len(rows)
    for topic in NUMBERS:
        assert listener.of(topic) == [in_words(data) for name, _, data in rows if name == topic]
    with open_writer(tmp_path / "again") as writer:
        for topic, data in listener.heard:
            seconds, nanoseconds = struct.unpack_from("<iI", data, 4)
            stamp_ns = seconds * NANOSECONDS_PER_SECOND + nanoseconds
            writer.write(NUMBERS[topic], stamp_ns, data)
    original, again = (
        run(capsys, "check", str(folder), "--json") for folder in (bag, tmp_path / "again")
    )
    assert original == again
    assert json.loads(original[1])["verdict"] == "ok"


def test_keys_step_and_quit(domain: int, bag: Path, listener: Listener) -> None:
    """Too slow to see anything happen, a step brings the next instant, and q ends it."""
    typist, terminal = os.openpty()
    with start(domain, bag, "--rate", "1e-6", stdin=terminal) as process:
        listener.hear(lambda: len(listener.of("/clock")) == 1, process)
        os.write(typist, b".")
        listener.hear(lambda: len(listener.of("/clock")) == 2, process)
        os.write(typist, b"\x1b[C")
        listener.hear(lambda: len(listener.of("/clock")) == 3, process)
        os.write(typist, b"q")
        out, errors = process.communicate(timeout=60)
    os.close(typist)
    os.close(terminal)
    assert process.returncode == 0
    assert "up to 0.010 s" in out
    assert "tlcomm: paused at 0.010 s" in errors


def test_what_was_latched_is_offered_to_whoever_comes_later(
    domain: int, bag: Path, context: Context
) -> None:
    """From a late start on, the strategies agreed before are there; Ctrl-C ends with 130."""
    latched = next(topic for topic in TOPICS if topic.name == "/east/team_strategy")
    listener = Listener(context, TOPICS[:1])
    options = ("--rate", "1e-6", "--start", "15")
    with start(domain, bag, *options, stdin=subprocess.DEVNULL) as process:
        listener.hear(lambda: bool(listener.of("/clock")), process)
        listener.listen(latched)
        listener.hear(lambda: len(listener.of(latched.name)) == 2, process)
        process.send_signal(signal.SIGINT)
        _, errors = process.communicate(timeout=60)
    listener.node.destroy_node()
    assert process.returncode == 130
    assert errors == "tlcomm: error: interrupted\n"


def test_other_types_are_skipped(domain: int, context: Context, tmp_path: Path) -> None:
    """A type that isn't installed, or is another of that name, is one line; the rest goes on."""
    clock = read_definition(load_typestore(SHARE), "rosgraph_msgs/msg/Clock")
    definitions = {
        "tlcomm_msgs/msg/Unheard": clock,
        "tlcomm_msgs/msg/Tick": Definition("tlcomm_msgs/msg/Tick", clock.text, f"RIHS01_{0:064}"),
        clock.type: clock,
    }
    topics = [Topic(f"/{kind.rpartition('/')[2].lower()}", kind) for kind in definitions]
    with BagWriter(tmp_path / "bag", topics, definitions, {}) as writer:
        for number in range(3):
            writer.write(number, 0, struct.pack("<IiI", 256, 0, 0))
    listener = Listener(context, TOPICS[:1])
    with start(domain, tmp_path / "bag", stdin=subprocess.DEVNULL) as process:
        spin(listener.node, lambda: process.poll() is not None)
        out, errors = process.communicate(timeout=60)
    listener.node.destroy_node()
    assert errors.splitlines() == [
        "tlcomm: skipped '/unheard': its type 'tlcomm_msgs/msg/Unheard' isn't installed",
        "tlcomm: skipped '/tick': its type 'tlcomm_msgs/msg/Tick' is installed in another version",
    ]
    assert out.startswith("replayed 1 messages on 1 topics")


HEARER = """
import rclpy
from rclpy.qos import QoSHistoryPolicy, QoSProfile
from tlcomm_msgs.msg import Confirmation
rclpy.init()
node, heard = rclpy.create_node("hearer"), []
quality = QoSProfile(history=QoSHistoryPolicy.KEEP_ALL)
subscription = node.create_subscription(Confirmation, "/east/confirmation", heard.append, quality)
while not heard:
    rclpy.spin_once(node)
print("one", flush=True)
while subscription.get_publisher_count():
    rclpy.spin_once(node, timeout_sec=0.1)
count = -1
while count < len(heard):
    count = len(heard)
    rclpy.spin_once(node, timeout_sec=1.0)
print(count, flush=True)
"""
# Half as many again as the publisher keeps, and more than a stopped process's socket holds.
BURST = 1500
NAME = "x" * 20_000


def write_burst(folder: Path, burst: int = BURST) -> None:
    """Write a bag with one large message, and a second later many at once."""
    make = _Messages(load_typestore(SHARE))
    data = make._bytes(
        "tlcomm_msgs/msg/Confirmation",
        header=make._header(0),
        sender=NAME,
        round=1,
        iteration=1,
        digest=7,
        confirmed=[],
    )
    with open_writer(folder) as writer:
        for number in range(burst + 1):
            log_ns = NANOSECONDS_PER_SECOND if number else 0
            writer.write(NUMBERS["/east/confirmation"], log_ns, data)


def test_whoever_stands_still_is_waited_for(domain: int, tmp_path: Path) -> None:
    """A subscriber that is stopped for a while misses nothing."""
    write_burst(tmp_path / "bag")
    typist, terminal = os.openpty()
    hearer = subprocess.Popen(
        [sys.executable, "-c", HEARER],
        env={**os.environ, "ROS_DOMAIN_ID": str(domain)},
        stdout=subprocess.PIPE,
        text=True,
    )
    with hearer, start(domain, tmp_path / "bag", "--rate", "1e-6", stdin=terminal) as process:
        assert hearer.stdout is not None
        assert process.stderr is not None
        assert hearer.stdout.readline() == "one\n"
        hearer.send_signal(signal.SIGSTOP)
        os.write(typist, b".q")
        # A replay that runs ahead says within this time that it has made its step.
        hints = b""
        while select.select([process.stderr], [], [], 5.0)[0] and b"paused" not in hints:
            hints += os.read(process.stderr.fileno(), 4096)
        hearer.send_signal(signal.SIGCONT)
        process.communicate(timeout=60)
        assert hearer.stdout.readline() == f"{1 + BURST}\n"
    os.close(typist)
    os.close(terminal)


# What the publisher keeps, so that it doesn't wait before the end.
REMAINDER = 400


def test_the_end_waits_for_whoever_is_late(domain: int, tmp_path: Path) -> None:
    """What is under way when all is published arrives too, at a subscriber that is behind."""
    write_burst(tmp_path / "bag", REMAINDER)
    typist, terminal = os.openpty()
    hearer = subprocess.Popen(
        [sys.executable, "-c", HEARER],
        env={**os.environ, "ROS_DOMAIN_ID": str(domain)},
        stdout=subprocess.PIPE,
        text=True,
    )
    with hearer, start(domain, tmp_path / "bag", "--rate", "1e-6", stdin=terminal) as process:
        assert hearer.stdout is not None
        assert hearer.stdout.readline() == "one\n"
        hearer.send_signal(signal.SIGSTOP)
        os.write(typist, b".")
        try:
            with pytest.raises(subprocess.TimeoutExpired):
                process.wait(timeout=12)
        finally:
            hearer.send_signal(signal.SIGCONT)
        process.communicate(timeout=60)
        assert hearer.stdout.readline() == f"{1 + REMAINDER}\n"
    os.close(typist)
    os.close(terminal)


def test_nobody_has_to_wait_for_whoever_never_comes(domain: int, tmp_path: Path) -> None:
    """At the end, too, q quits."""
    write_burst(tmp_path / "bag", REMAINDER)
    typist, terminal = os.openpty()
    hearer = subprocess.Popen(
        [sys.executable, "-c", HEARER],
        env={**os.environ, "ROS_DOMAIN_ID": str(domain)},
        stdout=subprocess.PIPE,
        text=True,
    )
    with hearer, start(domain, tmp_path / "bag", "--rate", "1e-6", stdin=terminal) as process:
        assert hearer.stdout is not None
        assert process.stderr is not None
        assert hearer.stdout.readline() == "one\n"
        hearer.send_signal(signal.SIGSTOP)
        os.write(typist, b".")
        hints = b""
        while b"paused" not in hints:
            hints += os.read(process.stderr.fileno(), 4096)
        os.write(typist, b"q")
        try:
            # A little sooner than DDS takes a process that says nothing for gone.
            assert process.wait(timeout=15) == 0
        finally:
            hearer.kill()
            process.kill()
    os.close(typist)
    os.close(terminal)
