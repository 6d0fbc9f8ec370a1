"""The recorder: a ROS 2 node that writes every topic of a run into a bag.

``RecorderSettings``  what to record, and where to
``run``               the process's whole life
``Recorder``          the node

In lock step it takes part like an agent: a tick says how many messages have been published up to a
time, and is answered only when all of them have arrived. So nothing can be missing without being
noticed. Then they are written, and nothing later is: a recording that breaks off ends at one time
on all topics, and equal runs are written in the same order. The answer comes first: what follows
from it goes on beside the run.

Waking up for a message costs more than writing it. So the recorder sleeps until it is ticked, or
running freely for a tenth of a second, and then takes all that has come.

Since it hears everything, it also makes the mirrors for other people's viewers, publishes them, and
records them beside the rest.
"""

import signal
import time
from collections.abc import Iterable
from dataclasses import dataclass, field
from importlib import import_module
from pathlib import Path
from typing import Any

import rclpy
from ament_index_python.packages import get_package_share_directory
from rclpy.clock import Clock
from rclpy.clock_type import ClockType
from rclpy.duration import Duration
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.qos import QoSDurabilityPolicy, QoSProfile, QoSReliabilityPolicy
from rclpy.signals import SignalHandlerOptions

from tlcomm_core.method import Method
from tlcomm_core.scenario.model import Scenario
from tlcomm_msgs.msg import Tick, TickReply
from tlcomm_tools.bag.compression import DEFAULT, Compression
from tlcomm_tools.bag.definitions import load_typestore, read_definition
from tlcomm_tools.bag.stamps import first_stamp_ns
from tlcomm_tools.bag.topics import Topic, recorded_topics
from tlcomm_tools.bag.writer import BagWriter
from tlcomm_tools.mirror.mirror import Mirror
from tlcomm_tools.runtime.backlog import FOR_EVER, Arrived, Backlog
from tlcomm_tools.runtime.ledger import Expected
from tlcomm_tools.runtime.notify import Failed, Finished, Notifier, Ready, Started
from tlcomm_tools.runtime.spin import Spin
from tlcomm_tools.status import Status

__all__ = ["Recorder", "RecorderSettings", "run"]

_NAME = "recorder"
_DEPTH = 1000
_PERIOD_S = 0.1
_ACKNOWLEDGED_S = 2.0
# After this time without what a tick counts, it is reported: before the sim's own deadline.
_PATIENCE_S = 7.0
# How long the end waits for what is under way, and after how many silent timers it waits no more.
_DRAIN_S = 1.5
_SILENT_PERIODS = 3


@dataclass(frozen=True, slots=True)
class RecorderSettings:
    """What to record, and where to.

    Attributes:
        bag: the bag's folder, which doesn't exist yet.
        scenario: what is run.
        method: how.
        is_lockstep: whether it is ticked, or else runs freely.
        compression: of the bag's chunks.
        notes: what the bag says about the run besides its messages.
    """

    bag: Path
    scenario: Scenario
    method: Method = Method.TEAM
    is_lockstep: bool = True
    compression: Compression = DEFAULT
    notes: dict[str, str] = field(default_factory=dict)

    @property
    def agents(self) -> tuple[str, ...]:
        """The agents' names, in the scenario's order."""
        return tuple(self.scenario.agents)

    @property
    def topics(self) -> tuple[Topic, ...]:
        """What is recorded, without the mirrors."""
        return recorded_topics(self.agents, measures=self.scenario.field is not None)


def run(settings: RecorderSettings, spin: Spin, notifier: Notifier) -> int:
    """Record until told to stop or shut down; return the exit status.

    A bag that can't be written any more is reported, and what was written stays readable.
    """
    mirror = _make_mirror(settings)
    try:
        writer = _open_bag(settings, mirror)
    except OSError as error:
        reason = f"can't write {str(settings.bag)!r}: {error.strerror}"
        notifier.tell(Failed(reason, Status.BAD_INPUT))
        return Status.BAD_INPUT
    try:
        with writer:
            is_over = _record(settings, writer, mirror, spin, notifier)
    except OSError as error:
        reason = f"can't write {str(settings.bag)!r} any more: {error.strerror}"
        notifier.tell(Failed(reason, Status.BROKEN))
        return Status.BROKEN
    if is_over:
        notifier.tell(Finished())
    return 0


def _make_mirror(settings: RecorderSettings) -> Mirror:
    store = load_typestore(Path(get_package_share_directory("tlcomm_msgs")))
    return Mirror(settings.scenario, settings.method, settings.topics, store)


def _open_bag(settings: RecorderSettings, mirror: Mirror) -> BagWriter:
    topics = (*settings.topics, *mirror.topics)
    definitions = {topic.type: read_definition(mirror.store, topic.type) for topic in topics}
    return BagWriter(
        settings.bag, topics, definitions, settings.notes, compression=settings.compression
    )


def _record(
    settings: RecorderSettings, writer: BagWriter, mirror: Mirror, spin: Spin, notifier: Notifier
) -> bool:
    """Record; return whether the run came to its end.

    A signal ends the recording, but not at once: what the others said before they stopped is under
    way on many topics, and would otherwise end at a different time on each.
    """
    signals: list[int] = []
    previous = {
        number: signal.signal(number, lambda caught, _: signals.append(caught))
        for number in (signal.SIGINT, signal.SIGTERM)
    }
    context = rclpy.Context()
    rclpy.init(context=context, signal_handler_options=SignalHandlerOptions.NO)
    node = Recorder(settings, writer, mirror, notifier, context)
    try:
        notifier.tell(Started())
        spin(node, lambda: node.is_done or bool(signals))
        node.await_silence()
        until_s = time.monotonic() + _DRAIN_S
        spin(node, lambda: node.is_done or node.is_quiet or time.monotonic() > until_s)
        node.say_what_is_missing()
        node.write_the_rest()
    finally:
        node.destroy_node()
        rclpy.try_shutdown(context=context)
        for number, handler in previous.items():
            signal.signal(number, handler)
    return node.is_done


class Recorder(Node):
    """Writes whatever arrives; answers ticks when everything has arrived."""

    def __init__(
        self,
        settings: RecorderSettings,
        writer: BagWriter,
        mirror: Mirror,
        notifier: Notifier,
        context: rclpy.Context,
    ) -> None:
        """Subscribe to every recorded topic, and offer the mirrors."""
        super().__init__(
            _NAME,
            context=context,
            use_global_arguments=False,
            enable_rosout=False,
            start_parameter_services=False,
            # A node without services can be spun fast.
            parameter_overrides=[Parameter("start_type_description_service", value=False)],
        )
        self.is_done = False
        self._silent_periods = 0
        self._tick_since_s = 0.0
        self._writer = writer
        self._mirror = mirror
        self._clock_ns = -1
        self._notifier = notifier
        self._is_ready = False
        self._is_running = False
        self._tick: Tick | None = None
        self._expected = Expected(0, 0, 0, 0, ())
        self._is_lockstep = settings.is_lockstep
        topics = settings.topics
        self._clock_number = [topic.name for topic in topics].index("/clock")
        self._backlog = Backlog(topics, settings.agents, -1 if self._is_lockstep else FOR_EVER)
        self._recorded = [self._subscribe(number, topic) for number, topic in enumerate(topics)]
        self._mirrors = [self._offer(topic) for topic in mirror.topics]
        qos = _qos(latched=False)
        self._ticks = self.create_subscription(Tick, f"{_NAME}/tick", self._on_tick, qos)
        self._replies = self.create_publisher(TickReply, "tick_reply", qos)
        steady = Clock(clock_type=ClockType.STEADY_TIME)
        self.create_timer(_PERIOD_S, self._on_timer, clock=steady)

    @property
    def urgent(self) -> object:
        """What alone need wake the recorder up now: a tick, unless it waits for what one counts."""
        return self._ticks if self._tick is None else None

    def await_silence(self) -> None:
        """Begin to look out for silence."""
        self._silent_periods = 0

    @property
    def is_quiet(self) -> bool:
        """Whether nothing has arrived for a while, since silence is looked out for."""
        return self._silent_periods >= _SILENT_PERIODS

    def say_what_is_missing(self) -> None:
        """Log what a tick counts and hasn't arrived, if the recorder was waiting for it."""
        if self._tick is not None:
            self.get_logger().error(self._missing())

    def _missing(self) -> str:
        return f"hasn't arrived: {self._backlog.describe_missing(self._expected)}"

    def write_the_rest(self) -> None:
        """Write and mirror all that has arrived, though it may not be all of one time."""
        self._backlog.cover(FOR_EVER)
        self._write(self._backlog.hand_out())
        self._show_mirrors(self._clock_ns)

    def _write(self, arrived: Iterable[Arrived]) -> None:
        for stamp_ns, number, data in arrived:
            self._writer.write(number, stamp_ns, data)
            self._mirror.take(number, stamp_ns, data)
            if number == self._clock_number:
                self._clock_ns = stamp_ns

    def _show_mirrors(self, until_ns: int) -> None:
        """Record the mirrors that are due; publish those that somebody may look at."""
        for number, stamp_ns, data in self._mirror.advance(until_ns):
            self._writer.write(len(self._recorded) + number, stamp_ns, data)
            mirror = self._mirrors[number]
            if self._mirror.topics[number].latched or mirror.get_subscription_count():
                mirror.publish(data)

    def _offer(self, topic: Topic) -> Any:  # noqa: ANN401 - rclpy is untyped
        return self.create_publisher(_load_type(topic), topic.name, _qos(latched=topic.latched))

    def _subscribe(self, number: int, topic: Topic) -> Any:  # noqa: ANN401 - as above
        def take(data: bytes) -> None:
            self._take(number, data)

        return self.create_subscription(
            _load_type(topic), topic.name, take, _qos(latched=topic.latched), raw=True
        )

    def _take(self, number: int, data: bytes) -> None:
        try:
            stamp_ns = first_stamp_ns(data)
        except ValueError as error:
            self.get_logger().warning(f"ignored: {error}")
            return
        self._backlog.take(stamp_ns, number, data)
        self._silent_periods = 0
        self._is_running = True
        if self._tick is not None:
            self._answer_when_complete(self._tick)

    def _on_tick(self, tick: Tick) -> None:
        self._is_running = True
        self._tick = tick
        self._tick_since_s = time.monotonic()
        self._expected = _expected(tick)
        self._backlog.cover(FOR_EVER if tick.stop else tick.time_ns)
        self._answer_when_complete(tick)

    def _answer_when_complete(self, tick: Tick) -> None:
        if not self._backlog.is_complete(self._expected):
            return
        self._tick = None
        if not tick.stop:
            self._reply(tick.sequence)
        self._write(self._backlog.hand_out())
        self._show_mirrors(tick.time_ns)
        if not tick.stop:
            self._writer.flush_if_due()
            return
        self._writer.flush()
        self._reply(tick.sequence)
        self._replies.wait_for_all_acked(Duration(seconds=_ACKNOWLEDGED_S))
        self.is_done = True

    def _on_timer(self) -> None:
        if not self._is_lockstep and self._tick is None:
            self._write(self._backlog.hand_out())
            # What is on its way for longer than that is shown a second later.
            self._show_mirrors(self._clock_ns)
        if self._tick is None:
            self._writer.flush_if_due()
        self._silent_periods += 1
        if self._tick is not None and time.monotonic() > self._tick_since_s + _PATIENCE_S:
            # The sim could only say that the recorder doesn't answer; this names whose fault it is.
            self._notifier.tell(Failed(self._missing(), Status.BROKEN))
        if self._is_running:
            return
        if not self._is_ready and self._is_matched():
            self._is_ready = True
            self._notifier.tell(Ready())
        self._reply(0)

    def _is_matched(self) -> bool:
        return self._replies.get_subscription_count() > 0 and all(
            subscription.get_publisher_count() > 0 for subscription in self._recorded
        )

    def _reply(self, sequence: int) -> None:
        self._replies.publish(TickReply(agent=_NAME, sequence=sequence, ready=self._is_ready))


def _load_type(topic: Topic) -> Any:  # noqa: ANN401 - as above
    package, _, name = topic.type.split("/")
    return getattr(import_module(f"{package}.msg"), name)


def _expected(tick: Tick) -> Expected:
    return Expected(
        odometry=tick.odometry_count,
        connectivity=tick.connectivity_count,
        clock=tick.clock_count,
        maps=tick.map_count,
        readings=tick.reading_count,
        agents=tuple(tick.agent_counts),
    )


def _qos(*, latched: bool) -> QoSProfile:
    durability = QoSDurabilityPolicy.TRANSIENT_LOCAL if latched else QoSDurabilityPolicy.VOLATILE
    return QoSProfile(
        depth=_DEPTH, reliability=QoSReliabilityPolicy.RELIABLE, durability=durability
    )
