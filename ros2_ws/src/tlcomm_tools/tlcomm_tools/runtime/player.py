"""The player: a ROS 2 node that publishes a bag's messages when they are due.

``Playing``  how to play
``Played``   what was played
``play``     plays a script

It publishes in the user's own ROS domain, where the user's tools are. The node has publishers only,
so there is nothing to spin: keys are all that it waits for.
"""

import math
import os
import re
import signal
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from importlib import import_module
from typing import Any, Final

import rclpy
from rclpy.duration import Duration
from rclpy.exceptions import InvalidTopicNameException
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.qos import (
    QoSDurabilityPolicy,
    QoSHistoryPolicy,
    QoSProfile,
    QoSReliabilityPolicy,
)

from tlcomm_core.errors import InputError
from tlcomm_core.units import seconds
from tlcomm_tools.replay.audience import Audience
from tlcomm_tools.replay.keyboard import Key, Keyboard
from tlcomm_tools.replay.quality import Quality
from tlcomm_tools.replay.schedule import Schedule
from tlcomm_tools.replay.script import Message, OfferedTopic, Script
from tlcomm_tools.runtime.domain import player_environment

__all__ = ["Played", "Playing", "play"]

_NAME: Final = "tlcomm_replay"
_TYPE: Final = re.compile(r"([a-z][a-z0-9_]*)/msg/([A-Z][A-Za-z0-9]*)")
# How many messages are published before keys are looked at again.
_BATCH: Final = 200
_LONGEST_WAIT_S: Final = 0.1
_MATCHING_PERIOD_S: Final = 0.02
# Of each topic, no more than this are published before those before them have arrived.
_MOST_UNACKNOWLEDGED: Final = 500
_SLICE: Final = Duration(seconds=0.1)
# How long quitting waits for what is under way.
_SLICES_ON_QUITTING: Final = 50


@dataclass(frozen=True, slots=True)
class Playing:
    """How to play.

    Attributes:
        rate: seconds of the bag per second.
        loops: whether to begin again after the end.
        patience_s: how long to wait for the first subscriber before beginning without.
    """

    rate: float = 1.0
    loops: bool = False
    patience_s: float = 0.0


@dataclass(slots=True)
class Played:
    """What was played.

    Attributes:
        topics: that could be published.
        skipped: topics that couldn't, with reasons.
        messages: published.
        reached_ns: the last one's log time.
    """

    topics: int = 0
    skipped: dict[str, str] = field(default_factory=dict)
    messages: int = 0
    reached_ns: int = 0


class _TypeError(Exception):
    """A topic's type isn't here, or isn't the same."""


class _Outlet:
    """A topic's publisher, which doesn't run ahead of those who listen reliably.

    Its history keeps what the original's did. A message that drops out of it before it has arrived
    is lost; so it waits, half a history at a time.
    """

    def __init__(self, node: Node, topic: OfferedTopic) -> None:
        self._publisher = node.create_publisher(
            _load_type(topic.type), topic.name, _profile(topic.quality)
        )
        depth = topic.quality.depth or 2 * _MOST_UNACKNOWLEDGED
        self._most = max(1, min(depth // 2, _MOST_UNACKNOWLEDGED))
        self._unacknowledged = 0
        _require_hash(node, topic)

    @property
    def matched(self) -> int:
        """How many subscriptions are served."""
        count: int = self._publisher.get_subscription_count()
        return count

    def publish(self, data: bytes) -> None:
        """Publish one message, and wait if too many are under way."""
        self._publisher.publish(data)
        self._unacknowledged += 1
        if self._unacknowledged >= self._most:
            # A subscriber that has gone is forgotten in time, and then acknowledges nothing.
            while not self._publisher.wait_for_all_acked(_SLICE):
                pass
            self._unacknowledged = 0

    def has_arrived(self) -> bool:
        """Wait a little for everything to arrive; return whether it has."""
        arrived: bool = self._publisher.wait_for_all_acked(_SLICE)
        return arrived


class _Player:
    def __init__(self, outlets: Sequence[_Outlet | None], script: Script, played: Played) -> None:
        self._outlets = outlets
        self._script = script
        self._played = played

    @property
    def matched(self) -> int:
        """How many subscriptions are served."""
        return sum(outlet.matched for outlet in self._outlets if outlet is not None)

    def publish(self, numbers: range) -> None:
        """Publish these messages, and what came before the first one."""
        if numbers and numbers.start == 0:
            for message in self._script.held:
                self._publish(message)
        for number in numbers:
            self._publish(self._script.messages[number])

    def _publish(self, message: Message) -> None:
        log_ns, topic, data = message
        outlet = self._outlets[topic]
        if outlet is not None:
            outlet.publish(data)
            self._played.messages += 1
            self._played.reached_ns = log_ns

    def finish(self, keyboard: Keyboard, *, is_cut: bool) -> None:
        """Wait until everything has arrived; not for long once the user has quit."""
        slices = _SLICES_ON_QUITTING if is_cut else math.inf
        while slices > 0:
            if all(outlet.has_arrived() for outlet in self._outlets if outlet is not None):
                return
            slices -= 1
            if Key.QUIT in keyboard.wait(0.0):
                slices = min(slices, _SLICES_ON_QUITTING)


def play(script: Script, how: Playing, keyboard: Keyboard, tell: Callable[[str], None]) -> Played:
    """Play to the end, or until the user quits.

    Args:
        script: what to publish.
        how: how fast, how often.
        keyboard: pauses, steps and quits.
        tell: is told what a user should know meanwhile, a line at a time.

    Raises:
        InputError: no topic can be published.
        KeyboardInterrupt: SIGINT or SIGTERM; nothing is left behind.
    """
    played = Played(skipped=dict(script.skipped))
    with _open_node() as node:
        outlets = _open_outlets(node, script.topics, played)
        for topic, reason in played.skipped.items():
            tell(f"skipped {topic!r}: {reason}")
        if played.topics == 0:
            raise InputError("nothing to replay: none of the topics can be published")
        player = _Player(outlets, script, played)
        if _await_audience(player, how, keyboard):
            is_over = _play(player, script, how, keyboard, tell)
            player.finish(keyboard, is_cut=not is_over)
    return played


@contextmanager
def _open_node() -> Iterator[Node]:
    """Yield the node; SIGTERM ends it as SIGINT does."""
    os.environ.update(player_environment(os.environ))
    previous = signal.signal(signal.SIGTERM, signal.default_int_handler)
    context = rclpy.Context()
    # Without logs, which would go to files in the user's home.
    context.init(args=[], initialize_logging=False)
    try:
        node = Node(
            _NAME,
            context=context,
            use_global_arguments=False,
            enable_rosout=False,
            start_parameter_services=False,
            parameter_overrides=[Parameter("start_type_description_service", value=False)],
        )
        try:
            yield node
        finally:
            node.destroy_node()
    finally:
        rclpy.try_shutdown(context=context)
        signal.signal(signal.SIGTERM, previous)


def _open_outlets(
    node: Node, topics: Sequence[OfferedTopic], played: Played
) -> list[_Outlet | None]:
    outlets: list[_Outlet | None] = []
    for topic in topics:
        try:
            outlets.append(_Outlet(node, topic))
            played.topics += 1
        except (InvalidTopicNameException, _TypeError) as error:
            played.skipped[topic.name] = " ".join(str(error).split())
            outlets.append(None)
    return outlets


def _await_audience(player: _Player, how: Playing, keyboard: Keyboard) -> bool:
    """Wait for subscribers; return whether to begin at all."""
    audience = Audience(time.monotonic(), how.patience_s)
    while not audience.is_complete(time.monotonic(), player.matched):
        if Key.QUIT in keyboard.wait(_MATCHING_PERIOD_S):
            return False
    return True


def _play(
    player: _Player,
    script: Script,
    how: Playing,
    keyboard: Keyboard,
    tell: Callable[[str], None],
) -> bool:
    """Return whether the end was reached, and the user hasn't quit."""
    times_ns = [message[0] for message in script.messages]
    schedule = Schedule(times_ns, how.rate, time.monotonic(), loops=how.loops)
    while not schedule.is_over:
        player.publish(schedule.take_due(time.monotonic(), _BATCH))
        wait_s = schedule.wait_s(time.monotonic())
        for key in keyboard.wait(None if wait_s is None else min(wait_s, _LONGEST_WAIT_S)):
            if key is Key.QUIT:
                return False
            if key is Key.PAUSE:
                schedule.toggle_pause(time.monotonic())
            else:
                player.publish(schedule.take_step(time.monotonic()))
            tell(_describe(schedule))
    return True


def _describe(schedule: Schedule) -> str:
    state = "paused" if schedule.is_paused else "going on"
    return f"{state} at {seconds(schedule.reached_ns(time.monotonic())):.3f} s"


def _load_type(name: str) -> Any:  # noqa: ANN401 (a class that rclpy makes a publisher from)
    parts = _TYPE.fullmatch(name)
    if parts is None:
        raise _TypeError(f"{name!r} is no message type")
    package, own = parts.groups()
    try:
        kind = getattr(import_module(f"{package}.msg"), own)
        kind.__class__.__import_type_support__()
    except (ImportError, AttributeError) as error:
        raise _TypeError(f"its type {name!r} isn't installed") from error
    return kind


def _require_hash(node: Node, topic: OfferedTopic) -> None:
    """Refuse to publish one type's bytes as another's of the same name."""
    if not topic.type_hash:
        return
    for own in node.get_publishers_info_by_topic(topic.name):
        if own.node_name == _NAME and str(own.topic_type_hash) != topic.type_hash:
            raise _TypeError(f"its type {topic.type!r} is installed in another version")


def _profile(quality: Quality) -> QoSProfile:
    keeps_all = quality.depth is None
    return QoSProfile(
        history=QoSHistoryPolicy.KEEP_ALL if keeps_all else QoSHistoryPolicy.KEEP_LAST,
        depth=quality.depth or 0,
        reliability=(
            QoSReliabilityPolicy.RELIABLE if quality.reliable else QoSReliabilityPolicy.BEST_EFFORT
        ),
        durability=(
            QoSDurabilityPolicy.TRANSIENT_LOCAL if quality.latched else QoSDurabilityPolicy.VOLATILE
        ),
    )
