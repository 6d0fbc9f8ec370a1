"""Somebody else's program looks on at a run that has begun long ago."""

import json
import os
import re
import signal
import subprocess
import sys
from pathlib import Path

import pytest
import yaml

from tlcomm_tools.bag.topics import mirror_topics, recorded_topics

pytest.importorskip("rclpy", reason="needs ROS 2: run by scripts/test")

ROOT = Path(__file__).parents[2]
SCENARIO = ROOT / "scenarios" / "corridor.yaml"
AGENT = "west"
RVIZ = ROOT / "ros2_ws" / "src" / "tlcomm_tools" / "config" / "tlcomm.rviz"
# What this project's own processes are told about each other, and others are not.
_PRIVATE = ("FASTRTPS_DEFAULT_PROFILES_FILE", "ROS_AUTOMATIC_DISCOVERY_RANGE")

# Subscribes with given durabilities until there is a message of each topic.
_VIEWER = """
import json, sys
from importlib import import_module
import rclpy
from rclpy.qos import QoSDurabilityPolicy, QoSProfile
wanted, seen = json.loads(sys.argv[1]), set()
rclpy.init()
node = rclpy.create_node("viewer")
for topic, type_name, durability in wanted:
    package, _, name = type_name.split("/")
    node.create_subscription(
        getattr(import_module(f"{package}.msg"), name),
        topic,
        lambda _, topic=topic: seen.add(topic),
        QoSProfile(depth=10, durability=QoSDurabilityPolicy[durability]),
    )
while len(seen) < len(wanted):
    rclpy.spin_once(node, timeout_sec=1.0)
"""


def displays(nodes: list[dict[str, object]]) -> list[dict[str, str]]:
    """Return the topics of RViz's displays, with the qualities that they ask for."""
    found = []
    for node in nodes:
        topic = node.get("Topic")
        if isinstance(topic, dict):
            found.append(topic)
        inner = node.get("Displays")
        if isinstance(inner, list):
            found += displays(inner)
    return found


def asked_for() -> list[tuple[str, str, str]]:
    """Return topic, type and durability of all that RViz would show of one agent and the team."""
    document = yaml.safe_load(RVIZ.read_text("utf-8"))
    types = {own.name: own.type for own in (*recorded_topics([AGENT]), *mirror_topics([AGENT]))}
    asked = {
        own["Value"].replace("agent_1", AGENT): own["Durability Policy"]
        for own in displays(document["Visualization Manager"]["Displays"])
    }
    return [
        (name, types[name], durability.upper().replace(" ", "_"))
        for name, durability in asked.items()
        if name in types
    ]


def test_rviz_would_see_a_run_in_the_domain_that_it_names(tmp_path: Path) -> None:
    """Also what was said before it came, by any program's own ways of finding others."""
    run = ("run", str(SCENARIO), "--until", "1e6", "--pace", "1.0", "--out", str(tmp_path / "run"))
    asked = asked_for()
    assert len(asked) == 5
    with subprocess.Popen(
        [sys.executable, "-m", "tlcomm_tools", *run],
        stdout=subprocess.DEVNULL,
        stderr=subprocess.PIPE,
        text=True,
    ) as process:
        assert process.stderr is not None
        domain = re.fullmatch(r"tlcomm: ROS domain (\d+)\n", process.stderr.readline())
        next(line for line in process.stderr if " s simulated" in line)
        others = {name: text for name, text in os.environ.items() if name not in _PRIVATE}
        try:
            assert domain is not None
            subprocess.run(
                [sys.executable, "-c", _VIEWER, json.dumps(asked)],
                env={**others, "ROS_DOMAIN_ID": domain[1]},
                timeout=60,
                check=True,
            )
        finally:
            process.send_signal(signal.SIGINT)
            process.communicate(timeout=60)
