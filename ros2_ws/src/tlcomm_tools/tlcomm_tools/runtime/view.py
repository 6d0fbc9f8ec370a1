"""The process of a live view: ``python -m tlcomm_tools.runtime.view``.

``main``  the process

It only listens. Who began it says on standard input when all processes of the run have found each
other, and what the run says of itself at its end; the end of that input is the end of the view. The
first line of standard output is the page's address.
"""

import argparse
import asyncio
import json
import os
import sys
import threading
from collections import deque
from collections.abc import Iterator, Mapping, Sequence
from importlib import import_module
from pathlib import Path
from typing import Any, Final, Self

import rclpy
from ament_index_python.packages import get_package_share_directory
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.qos import QoSDurabilityPolicy, QoSProfile, QoSReliabilityPolicy
from rclpy.signals import SignalHandlerOptions

from tlcomm_core.method import parse_method
from tlcomm_core.scenario.loader import load_scenario
from tlcomm_tools.bag.definitions import load_typestore
from tlcomm_tools.bag.topics import Topic, split_topic
from tlcomm_tools.live.audience import Audience
from tlcomm_tools.live.document import LiveDocument
from tlcomm_tools.live.gate import Asked, Gate
from tlcomm_tools.live.intake import Heard, shown_topics
from tlcomm_tools.live.server import Served, Server
from tlcomm_tools.live.session import Session
from tlcomm_tools.report.page import Feed, read_charts, render_page
from tlcomm_tools.runtime.spin import spin

__all__ = ["main"]

_NAME: Final = "live_view"
_DEPTH: Final = 1000
_PERIOD_S: Final = 0.25
# Messages are taken together, that many a time: to wake up for each would cost more.
_NAP_S: Final = 0.05
# What is said once is not to be missed, nor is when links change: windows are judged by that. The
# rest is said again soon, or is not missed; and whom nobody waits for an answer from costs the
# sayers least.
_NOT_TO_BE_MISSED: Final = frozenset({"connectivity", "task_event", "team_strategy", "estimate"})
# Who is so far behind has lost the run anyway, and is not to eat the machine's memory.
_MOST_HEARD: Final = 200_000
# The run goes first.
_NICENESS: Final = 5


def main(argv: Sequence[str] | None = None) -> int:
    """Show a run until standard input ends; return the exit status."""
    parser = argparse.ArgumentParser(prog="view", description="A live view of a run.")
    parser.add_argument("--scenario", required=True)
    parser.add_argument("--bag", type=Path, required=True)
    parser.add_argument("--method", required=True)
    parser.add_argument("--solver", required=True)
    parser.add_argument("--seed", required=True)
    arguments = parser.parse_args(argv)
    os.nice(_NICENESS)
    asyncio.run(_show(arguments))
    return 0


async def _show(arguments: argparse.Namespace) -> None:
    scenario = load_scenario(arguments.scenario)
    notes = {"solver": arguments.solver, "seed": arguments.seed}
    document = LiveDocument(scenario, parse_method(arguments.method), notes)
    topics = shown_topics(scenario)
    store = load_typestore(Path(get_package_share_directory("tlcomm_msgs")))
    session = Session(document, topics, store, arguments.bag)
    audience = Audience(session.whole)
    async with Server(lambda gate: _serve(document.begun, gate), audience) as server:
        print(server.address, flush=True)
        with _Ear(topics) as ear:
            await _tell(session, audience, ear)


def _serve(document: Mapping[str, Any], gate: Gate) -> Served:
    feed = Feed(gate.address_of(Asked.FEED), gate.address_of(Asked.CHARTS))
    return Served(render_page(document, feed).encode(), read_charts().encode())


async def _tell(session: Session, audience: Audience, ear: "_Ear") -> None:
    """Tell all pages what is heard, a few times a second, until standard input ends."""
    words = asyncio.create_task(_obey(session, ear))
    while not words.done():
        await asyncio.wait((words,), timeout=_PERIOD_S)
        ear.require()
        session.take([*ear.heard()], is_hearing=ear.is_hearing)
        if news := session.news():
            audience.tell(news)
    await words


async def _obey(session: Session, ear: "_Ear") -> None:
    """Do what standard input says, until it ends."""
    lines = asyncio.StreamReader()
    await asyncio.get_running_loop().connect_read_pipe(
        lambda: asyncio.StreamReaderProtocol(lines), sys.stdin
    )
    async for line in lines:
        match json.loads(line):
            case {"event": "begun"}:
                ear.begin()
            case {"event": "over", "verdict": verdict}:
                session.take([*ear.heard()], is_hearing=ear.is_hearing)
                session.end(verdict)
            case _:
                raise ValueError(f"{line!r} isn't known")


class _Ear:
    """A node that listens in a thread of its own, once it is told to.

    Attributes:
        is_hearing: whether every topic is heard.
    """

    def __init__(self, topics: Sequence[Topic]) -> None:
        self.is_hearing = False
        self._topics: Final = topics
        self._heard: Final = deque[Heard](maxlen=_MOST_HEARD)
        self._end = threading.Event()
        self._thread = threading.Thread(target=self._listen, name="ear", daemon=True)

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self._end.set()
        if self._thread.is_alive():
            self._thread.join()

    def begin(self) -> None:
        """Begin to listen."""
        self._thread.start()

    def require(self) -> None:
        """Make sure that it still listens, if it began to."""
        if self._thread.ident is not None and not self._thread.is_alive():
            raise RuntimeError("nothing is heard any more")

    def heard(self) -> Iterator[Heard]:
        """Yield what was heard since the last call, in the order of arrival."""
        while self._heard:
            yield self._heard.popleft()

    def _listen(self) -> None:
        context = rclpy.Context()
        rclpy.init(context=context, signal_handler_options=SignalHandlerOptions.NO)
        node = Node(
            _NAME,
            context=context,
            use_global_arguments=False,
            enable_rosout=False,
            start_parameter_services=False,
            parameter_overrides=[Parameter("start_type_description_service", value=False)],
        )
        subscriptions = [self._subscribe(node, *numbered) for numbered in enumerate(self._topics)]

        def is_over() -> bool:
            if not self.is_hearing:
                self.is_hearing = all(own.get_publisher_count() for own in subscriptions)
            return self._end.wait(_NAP_S)

        try:
            spin(node, is_over)
        finally:
            node.destroy_node()
            rclpy.try_shutdown(context=context)

    def _subscribe(self, node: Node, number: int, topic: Topic) -> Any:  # noqa: ANN401 - untyped
        package, _, name = topic.type.split("/")
        return node.create_subscription(
            getattr(import_module(f"{package}.msg"), name),
            topic.name,
            lambda data: self._heard.append((number, data)),
            _quality(topic),
            raw=True,
        )


def _quality(topic: Topic) -> QoSProfile:
    return QoSProfile(
        depth=_DEPTH,
        reliability=(
            QoSReliabilityPolicy.RELIABLE
            if split_topic(topic.name)[1] in _NOT_TO_BE_MISSED
            else QoSReliabilityPolicy.BEST_EFFORT
        ),
        durability=(
            QoSDurabilityPolicy.TRANSIENT_LOCAL if topic.latched else QoSDurabilityPolicy.VOLATILE
        ),
    )


if __name__ == "__main__":
    sys.exit(main())
