"""A recorder that knows nothing of this project but its messages' definitions, run as a program.

    foreign_recorder.py FOLDER DEFINITIONS

It records as ``ros2 bag record`` does: what the topics offer decides how they are subscribed to,
log times are when messages came in, and the bag has the definitions inside and nothing else of the
run. The topics (name, type, latched) are read from standard input as JSON; ``ready`` is printed
once all are subscribed to. It ends when something has come in and all publishers are gone.
"""

import json
import sys
import time
from collections.abc import Callable, Sequence
from importlib import import_module
from pathlib import Path

import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.qos import QoSDurabilityPolicy, QoSHistoryPolicy, QoSProfile
from rosbags.interfaces import Connection
from rosbags.rosbag2 import StoragePlugin, Writer
from rosbags.typesys import Stores, get_types_from_msg, get_typestore
from rosbags.typesys.store import Typestore

# Without anything for so long, nothing is on its way any more.
_SILENCE_S = 1.0

_Topic = tuple[str, str, bool]


def _load_definitions(folder: Path) -> Typestore:
    store = get_typestore(Stores.ROS2_JAZZY)
    for path in folder.glob("*.msg"):
        name = f"tlcomm_msgs/msg/{path.stem}"
        store.register(get_types_from_msg(path.read_text("utf-8"), name))
    return store


def _subscribe(node: Node, topic: _Topic, take: Callable[[bytes], None]) -> None:
    name, kind, is_latched = topic
    package, _, own = kind.split("/")
    durability = QoSDurabilityPolicy.TRANSIENT_LOCAL if is_latched else QoSDurabilityPolicy.VOLATILE
    quality = QoSProfile(history=QoSHistoryPolicy.KEEP_ALL, durability=durability)
    message = getattr(import_module(f"{package}.msg"), own)
    node.create_subscription(message, name, take, quality, raw=True)


def _record(node: Node, topics: Sequence[_Topic], writer: Writer, store: Typestore) -> None:
    heard_s: list[float] = []
    for topic in topics:
        connection = writer.add_connection(topic[0], topic[1], typestore=store)

        def take(data: bytes, connection: Connection = connection) -> None:
            heard_s[:] = [time.monotonic()]
            writer.write(connection, time.time_ns(), data)

        _subscribe(node, topic, take)
    sys.stdout.write("ready\n")
    sys.stdout.flush()
    names = [name for name, _, _ in topics]
    executor = SingleThreadedExecutor()
    executor.add_node(node)
    while not heard_s or time.monotonic() < heard_s[0] + _SILENCE_S or _are_offered(node, names):
        executor.spin_once(timeout_sec=0.1)


def _are_offered(node: Node, names: Sequence[str]) -> bool:
    return any(map(node.count_publishers, names))


def _main(folder: str, definitions: str) -> None:
    topics = [tuple(topic) for topic in json.load(sys.stdin)]
    rclpy.init()
    node = rclpy.create_node("foreign_recorder")
    with Writer(Path(folder), version=9, storage_plugin=StoragePlugin.MCAP) as writer:
        _record(node, topics, writer, _load_definitions(Path(definitions)))


if __name__ == "__main__":
    _main(*sys.argv[1:])
