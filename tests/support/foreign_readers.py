"""Other people's readers of bags, by themselves: without ROS, and without this project.

``LIBRARIES``   their names
``read_alone``  what one of them decodes
"""

import json
import subprocess
import sys
from collections.abc import Iterator
from importlib.metadata import distribution
from pathlib import Path
from typing import Any, Final

from packaging.requirements import Requirement

__all__ = ["LIBRARIES", "read_alone"]

LIBRARIES: Final = ("rosbags", "mcap", "mcap-ros2-support")

_BEGIN: Final = """
import json, sys
from dataclasses import fields, is_dataclass
from importlib.util import find_spec
packages, path = sys.argv[1:]
sys.path.append(packages)
strangers = ("tlcomm_core", "tlcomm_tools", "tlcomm_msgs", "rclpy", "nav_msgs", "std_msgs")
assert not any(map(find_spec, strangers)), sys.path

def plain(value):
    if hasattr(value, "tolist"):
        return value.tolist()
    if isinstance(value, (bytes, list, tuple)):
        return [plain(own) for own in value]
    if isinstance(value, (str, bool, int, float)):
        return value
    if is_dataclass(value):
        # Without the type's name and constants.
        names = [own.name for own in fields(value) if own.name[0].islower()]
    else:
        names = value.__slots__
    return {name: plain(getattr(value, name)) for name in names}

def tell(topic, log_ns, message):
    print(json.dumps([topic, log_ns, plain(message)], sort_keys=True))
"""
_READ: Final = {
    "rosbags": """
from pathlib import Path
from rosbags.highlevel import AnyReader
with AnyReader([Path(path).parent]) as reader:
    for connection, log_ns, data in reader.messages():
        tell(connection.topic, log_ns, reader.deserialize(data, connection.msgtype))
""",
    "mcap-ros2-support": """
from mcap_ros2.reader import read_ros2_messages
for own in read_ros2_messages(path):
    tell(own.channel.topic, own.log_time_ns, own.ros_msg)
""",
    "mcap": """
from mcap.reader import make_reader
from mcap_ros2.decoder import DecoderFactory
with open(path, "rb") as stream:
    reader = make_reader(stream, validate_crcs=True, decoder_factories=[DecoderFactory()])
    for _, channel, message, decoded in reader.iter_decoded_messages():
        tell(channel.topic, message.log_time, decoded)
""",
}

# topic, log time (ns), the message's fields by name
Row = tuple[str, int, dict[str, Any]]


def read_alone(library: str, path: Path, folder: Path) -> list[Row]:
    """Return what a library decodes in a process that has nothing but it and what it needs.

    Args:
        library: one of ``LIBRARIES``.
        path: an MCAP file in its bag's folder.
        folder: an empty one, for links to the packages.
    """
    # The decoder of ROS 2's messages for mcap is a package by itself.
    for name in _needed({library, "mcap-ros2-support"} if library == "mcap" else {library}):
        for module in _modules(name):
            (folder / module.name).symlink_to(module)
    # Neither the environment's packages nor its variables.
    done = subprocess.run(
        [sys.executable, "-I", "-S", "-c", _BEGIN + _READ[library], str(folder), str(path)],
        env={},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    return [tuple(json.loads(line)) for line in done.stdout.splitlines()]


def _needed(names: set[str]) -> set[str]:
    """Return distributions with all that they require."""
    needed, new = set[str](), names
    while new:
        needed |= new
        required = (Requirement(line) for name in new for line in distribution(name).requires or ())
        new = {own.name for own in required if own.marker is None or own.marker.evaluate()} - needed
    return needed


def _modules(name: str) -> Iterator[Path]:
    """Yield the packages and modules that a distribution brings."""
    installed = distribution(name)
    tops = {path.parts[0] for path in installed.files or ()}
    for top in sorted(tops - {"..", "bin"}):
        if not top.endswith((".dist-info", ".pth")) and top != "__pycache__":
            yield Path(str(installed.locate_file(top)))
