"""A run replayed fast, and recorded by a recorder that isn't ours."""

import json
import os
import subprocess
import sys
import tempfile
from collections import defaultdict
from pathlib import Path

import pytest
import yaml
from rosbags.highlevel import AnyReader

from support import foreign_recorder
from support.command import command, refusal, run
from support.hand_made_run import SHARE
from tlcomm_tools.bag.reader import read_run
from tlcomm_tools.runtime.domain import claim_domain, process_environment

pytest.importorskip("rclpy", reason="needs ROS 2: run by scripts/test")

RATE = "50"


def topics_of(bag: Path) -> list[tuple[str, str, bool]]:
    """Return name, type and whether it is latched of all topics of a bag."""
    text = (bag / "metadata.yaml").read_text("utf-8")
    told = yaml.safe_load(text)["rosbag2_bagfile_information"]["topics_with_message_count"]
    metadata = [own["topic_metadata"] for own in told]
    return [
        (
            own["name"],
            own["type"],
            own["offered_qos_profiles"][0]["durability"] == "transient_local",
        )
        for own in metadata
    ]


def record_replay(bag: Path, again: Path) -> None:
    """Replay a bag, and record it into another."""
    with claim_domain() as domain:
        environment = process_environment(os.environ, domain, Path(tempfile.gettempdir()), 2)
        recorder = subprocess.Popen(
            [sys.executable, foreign_recorder.__file__, str(again), str(SHARE / "msg")],
            env=environment,
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            text=True,
        )
        with recorder:
            assert recorder.stdin is not None
            assert recorder.stdout is not None
            recorder.stdin.write(json.dumps(topics_of(bag)))
            recorder.stdin.close()
            assert recorder.stdout.readline() == "ready\n"
            arguments = ("replay", str(bag), "--rate", RATE, "--wait", "60", "--json")
            done = subprocess.run(
                command(*arguments),
                env=environment,
                stdin=subprocess.DEVNULL,
                capture_output=True,
                text=True,
                check=False,
            )
            if done.returncode != 0:
                recorder.kill()
    assert done.returncode == 0, done.stderr
    assert json.loads(done.stdout)["skipped"] == {}
    assert recorder.returncode == 0


@pytest.fixture(scope="module")
def again(finished: tuple[Path, str], tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return the bag of the finished run's replay."""
    folder = tmp_path_factory.mktemp("again") / "bag"
    record_replay(finished[0] / "bag", folder)
    return folder


def messages_of(bag: Path) -> dict[str, list[bytes]]:
    """Return the messages of each topic in their order, in whole words as DDS sends them."""
    messages = defaultdict(list)
    with AnyReader([bag]) as reader:
        for connection, _, data in reader.messages():
            messages[connection.topic].append(bytes(data) + bytes(-len(data) % 4))
    return messages


def test_every_message_is_recorded_again(finished: tuple[Path, str], again: Path) -> None:
    """On every topic, in order."""
    original, recorded = messages_of(finished[0] / "bag"), messages_of(again)
    assert recorded.keys() == original.keys()
    for topic, messages in original.items():
        assert recorded[topic] == messages, topic


def test_the_audit_of_a_replay_is_the_runs(
    finished: tuple[Path, str], again: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Given the scenario, which another's bag doesn't name: the same verdict, the same counts."""
    assert "give it with --scenario FILE" in refusal(capsys, "check", str(again))
    assert read_run(again).notes == {}
    scenario = str(finished[0] / "scenario.yaml")
    told = ("--scenario", scenario, "--pace", "lockstep")
    of_replay = run(capsys, "check", str(again), *told, "--json")
    of_run = run(capsys, "check", str(finished[0]), "--json")
    assert of_replay == of_run
    assert (of_run[0], json.loads(of_run[1])["verdict"]) == (0, "ok")


def test_a_replay_can_be_shown_but_not_verified(
    finished: tuple[Path, str],
    again: Path,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
) -> None:
    """As a page; its decisions can't be verified, since nothing says what they were made from."""
    scenario = str(finished[0] / "scenario.yaml")
    page = str(tmp_path / "page.html")
    arguments = ("--scenario", scenario, "--method", "team", "-o", page, "--json")
    status, out, _ = run(capsys, "report", str(again), *arguments)
    assert (status, json.loads(out)["verdict"]) == (0, "ok")
    complaint = f"{str(again)!r}: the bag doesn't say its run's scenario, which verifying needs"
    assert complaint in refusal(capsys, "replay", "--verify", str(again))
