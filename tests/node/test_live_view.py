"""A live view as a process of its own: topics in, a page's feed out."""

import json
import os
import subprocess
import sys
from collections.abc import Iterator
from dataclasses import replace
from importlib import import_module
from pathlib import Path
from typing import Any

import pytest
from rclpy.context import Context
from rclpy.node import Node
from rclpy.qos import QoSDurabilityPolicy, QoSProfile
from websockets.sync.client import connect
from websockets.typing import Origin

from support.hand_made_run import (
    SHARE,
    hand_made_records,
    hand_made_scenario,
    serialize_run,
    write_bag,
)
from support.live_page import grown
from support.spinning import SpunNodes
from tlcomm_core.method import Method
from tlcomm_core.scenario.loader import dumps
from tlcomm_core.units import nanoseconds
from tlcomm_tools.bag.definitions import load_typestore
from tlcomm_tools.bag.topics import Topic
from tlcomm_tools.live.document import LiveDocument
from tlcomm_tools.live.intake import shown_topics

LIMIT_S = 60.0


class View:
    """A view's process."""

    def __init__(self, folder: Path, domain: int) -> None:
        """Start it, with a bag beside it that goes on after what is said on topics."""
        records = hand_made_records()
        later_ns = records.odometry[-1].stamp_ns + nanoseconds(2.0)
        records.odometry.append(replace(records.odometry[-1], stamp_ns=later_ns))
        write_bag(folder / "bag", records)
        (folder / "scenario.yaml").write_text(dumps(hand_made_scenario()), "utf-8")
        self._process = subprocess.Popen(
            [
                *(sys.executable, "-P", "-m", "tlcomm_tools.runtime.view"),
                *("--scenario", str(folder / "scenario.yaml"), "--bag", str(folder / "bag")),
                *("--method", "team", "--solver", "coalition", "--seed", "0"),
            ],
            env={**os.environ, "ROS_DOMAIN_ID": str(domain)},
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            text=True,
        )
        assert self._process.stdout is not None
        self.address = self._process.stdout.readline().strip()

    def say(self, **word: object) -> None:
        """Say a word on its standard input."""
        assert self._process.stdin is not None
        self._process.stdin.write(f"{json.dumps(word)}\n")
        self._process.stdin.flush()

    def end(self) -> int:
        """End its standard input; return its exit status."""
        self._process.communicate(timeout=LIMIT_S)
        return self._process.returncode


@pytest.fixture
def view(tmp_path: Path, domain: int) -> Iterator[View]:
    """Return a view that is ended at last."""
    started = View(tmp_path, domain)
    yield started
    assert started.end() == 0


def offer(node: Node, topic: Topic) -> Any:  # noqa: ANN401 - rclpy is untyped
    """Return a publisher as a run has it."""
    package, _, name = topic.type.split("/")
    kind = getattr(import_module(f"{package}.msg"), name)
    durability = (
        QoSDurabilityPolicy.TRANSIENT_LOCAL if topic.latched else QoSDurabilityPolicy.VOLATILE
    )
    return node.create_publisher(kind, topic.name, QoSProfile(depth=1000, durability=durability))


def test_what_is_said_on_topics_reaches_a_page(view: View, context: Context) -> None:
    """Only once it is told to begin it subscribes; then a page gets all, and how it ended."""
    scenario, node = hand_made_scenario(), Node("run", context=context)
    publishers = {topic.name: offer(node, topic) for topic in shown_topics(scenario)}
    nodes = SpunNodes(context, node)
    nodes.settle()
    assert not any(own.get_subscription_count() for own in publishers.values())
    view.say(event="begun")
    nodes.until(lambda: all(own.get_subscription_count() for own in publishers.values()))
    for name, _, data in serialize_run(load_typestore(SHARE), hand_made_records()):
        if name in publishers:
            publishers[name].publish(data)
    page = LiveDocument(scenario, Method.TEAM, {}).begun
    feed = view.address.replace("http:", "ws:") + "feed"
    origin = Origin(view.address[: view.address.index("/", len("http://"))])
    with connect(feed, origin=origin, compression=None, max_size=None, proxy=None) as connection:
        while page["run"]["end_s"] < 25.0:
            page = grown(page, json.loads(connection.recv(LIMIT_S)))
        view.say(event="over", verdict="ok")
        while page["run"]["verdict"] is None:
            page = grown(page, json.loads(connection.recv(LIMIT_S)))
    assert [agent["satisfied_s"] for agent in page["agents"]] == [[5.5, 15.5], [5.0, 15.0]]
    assert [own["round"] for own in page["rounds"]] == [1, 2, 3]
    nodes.close()
