"""Every verb that takes a bag, on what is none, on others' bags, and on nonsense inside."""

import json
import math
import os
import re
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from rosbags.rosbag2 import StoragePlugin, Writer
from rosbags.typesys import Stores, get_typestore

from support.command import CORRIDOR, refusal, run
from support.hand_made_run import hand_made_records, write_bag
from tlcomm_core.records import RunRecords

VERBS = {
    "check": ("check",),
    "report": ("report", "-o", "page.html"),
    "replay": ("replay",),
    "verify": ("replay", "--verify"),
    "repair": ("repair",),
}
# Those that want a bag of a run, not just any.
OF_RUNS = ("check", "report", "verify")
HTML = "</script><img src=x onerror=alert(1)>\u2028\x1b[31m\n"


def make_text(path: Path) -> None:
    """Write a file that isn't MCAP."""
    path.mkdir()
    (path / "bag.mcap").write_text("no bag", "utf-8")


def make_nothing(path: Path) -> None:
    """Write a file without anything."""
    path.mkdir()
    (path / "bag.mcap").touch()


def make_closed(path: Path) -> None:
    """Write a file that can't be read, by anybody: a folder in its place."""
    (path / "bag.mcap").mkdir(parents=True)


def make_dangling(path: Path) -> None:
    """Write a bag whose file is a link to nowhere."""
    path.mkdir()
    (path / "bag.mcap").symlink_to("nowhere")


def make_loop(path: Path) -> None:
    """Write a link to itself."""
    path.symlink_to(path.name)


def make_sqlite(path: Path) -> None:
    """Write a bag that isn't MCAP."""
    with Writer(path, version=9, storage_plugin=StoragePlugin.SQLITE3):
        pass


@pytest.mark.parametrize("verb", VERBS)
@pytest.mark.parametrize(
    ("make", "complaint"),
    [
        (lambda _: None, "'bag' doesn't exist"),
        (Path.mkdir, "'bag' holds no bag"),
        (make_text, "'bag/bag.mcap' is no MCAP file"),
        (make_nothing, "'bag/bag.mcap' is no MCAP file"),
        (make_closed, "can't read 'bag/bag.mcap': Is a directory"),
        (make_dangling, "can't read 'bag/bag.mcap': No such file or directory"),
        (make_loop, "'bag' doesn't exist"),
        (make_sqlite, "'bag' is an SQLite bag; only MCAP bags can be read"),
    ],
)
def test_what_is_no_bag_is_refused(
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
    verb: str,
    make: Callable[[Path], None],
    complaint: str,
) -> None:
    """In one line that names it; the status is 2, and nothing is written."""
    make(tmp_path / "bag")
    assert complaint in refusal(capsys, *VERBS[verb], "bag")
    assert not (tmp_path / "page.html").exists()


@pytest.mark.parametrize("verb", VERBS)
def test_what_may_not_be_read_is_refused(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch, verb: str
) -> None:
    """A file whose permissions forbid it; of root, to whom nothing is forbidden, simulated."""
    path = write_bag(tmp_path / "bag", hand_made_records()).path
    path.chmod(0)
    if os.access(path, os.R_OK):

        def deny(*_: object) -> None:
            raise PermissionError(13, "Permission denied")

        monkeypatch.setattr(Path, "open", deny)
    complaint = f"can't read 'bag/{path.name}': Permission denied"
    assert complaint in refusal(capsys, *VERBS[verb], "bag")


def make_foreign(path: Path) -> None:
    """Write another program's bag."""
    store = get_typestore(Stores.ROS2_JAZZY)
    with Writer(path, version=9, storage_plugin=StoragePlugin.MCAP) as writer:
        connection = writer.add_connection("/chatter", "std_msgs/msg/String", typestore=store)
        message = store.types["std_msgs/msg/String"](data="hello")
        writer.write(connection, 1, store.serialize_cdr(message, "std_msgs/msg/String"))


def make_empty(path: Path) -> None:
    """Write a bag in which nothing was recorded."""
    write_bag(path, RunRecords())


def make_cut(path: Path) -> None:
    """Write a bag that was cut off before its first message."""
    file = write_bag(path, hand_made_records()).path
    file.write_bytes(file.read_bytes()[:300])


@pytest.mark.parametrize("verb", OF_RUNS)
@pytest.mark.parametrize(
    ("make", "complaint"),
    [
        (make_foreign, "'bag' is no bag of a tlcomm run: it has no topic 'connectivity'\n"),
        (make_empty, "'bag' is empty: it holds no messages of a run\n"),
        (make_cut, "it has no topic 'connectivity' (the file has no end)\n"),
    ],
)
def test_what_is_no_run_is_refused(
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
    verb: str,
    make: Callable[[Path], None],
    complaint: str,
) -> None:
    """In one line that says what is missing."""
    make(tmp_path / "bag")
    assert complaint in refusal(capsys, *VERBS[verb], "bag")


def test_metadata_of_any_depth_is_passed_over(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """What isn't YAML that anybody writes says nothing of the bag; a repair writes it anew."""
    write_bag(tmp_path / "bag", hand_made_records())
    (tmp_path / "bag" / "metadata.yaml").write_text("[" * 100_000, "utf-8")
    assert run(capsys, "check", "bag")[0] == 0
    status, out, _ = run(capsys, "repair", "bag", "--json")
    assert (status, json.loads(out)["flaw"]) == (
        0,
        "metadata.yaml is missing or doesn't fit the file",
    )


def test_another_teams_scenario_is_refused(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Both teams are named."""
    write_bag(tmp_path / "bag", hand_made_records())
    for verb in ("check", "report"):
        complaint = refusal(capsys, *VERBS[verb], "bag", "--scenario", CORRIDOR)
        assert complaint == (
            "tlcomm: error: 'bag' is of the agents ['east', 'west'], "
            "the scenario 'corridor' of ['west', 'carrier', 'east']\n"
        )


@dataclass(frozen=True)
class Flaw:
    """A value that the first message on a topic has in a field; steps lead to the field."""

    topic: str
    steps: tuple[str | int, ...]
    value: Any

    def write(self, folder: Path) -> None:
        """Write a bag with it."""
        done: list[bool] = []

        def change(topic: str, message: Any) -> None:  # noqa: ANN401 (made by a decoder)
            if topic == self.topic and not done:
                done.append(True)
                for step in self.steps[:-1]:
                    message = message[step] if isinstance(step, int) else getattr(message, step)
                setattr(message, str(self.steps[-1]), self.value)

        write_bag(folder, hand_made_records(), change=change)


def flaw(topic: str, *steps: str | int, to: object) -> Flaw:  # noqa: D103 (says itself)
    return Flaw(topic, steps, to)


ENDS = [np.array(ends, dtype=np.uint16) for ends in ([0, 60_000], [1, 0], [0, 1, 0])]


@pytest.mark.parametrize(
    ("bad", "complaint"),
    [
        (flaw("/connectivity", "edges", to=ENDS[0]), "links (0, 60000), no pair of 2 agents"),
        (flaw("/connectivity", "edges", to=ENDS[1]), "links (1, 0), no pair of 2 agents"),
        (flaw("/connectivity", "edges", to=ENDS[2]), "the 3 ends of edges aren't pairs"),
        (
            flaw("/connectivity", "agents", to=["east", "east"]),
            "'/connectivity' is of ('east', 'west'), and was of ('east', 'east') before",
        ),
        (flaw("/west/task_event", "kind", to=99), "99 is not a valid TaskEventKind"),
        (
            flaw("/west/odom", "header", "stamp", "sec", to=2**31 - 1),
            "has a message stamped 2147483647.000 s, expected simulated time: from 0 on, and",
        ),
        (
            flaw("/west/odom", "header", "stamp", "sec", to=-5),
            "has a message stamped -5.000 s, expected simulated time: from 0 on, and",
        ),
    ],
)
@pytest.mark.parametrize("verb", ["check", "report"])
def test_messages_that_cant_be_are_refused(
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
    verb: str,
    bad: Flaw,
    complaint: str,
) -> None:
    """In one line with what is wrong."""
    bad.write(tmp_path / "bag")
    assert complaint in refusal(capsys, *VERBS[verb], "bag")


POSITION = ("pose", "pose", "position", "x")
PART = ("strategies", 0)


@pytest.mark.parametrize(
    ("bad", "check", "line"),
    [
        (
            flaw("/west/odom", *POSITION, to=math.nan),
            "records",
            "west: 0.000 s: odometry with nan, not a finite number, 1 in all",
        ),
        (
            flaw("/west/odom", *POSITION, to=1e308),
            "records",
            "west: 0.000 s: odometry with 1e+308, too large a number, 1 in all",
        ),
        (
            flaw("/west/team_strategy", *PART, "arrival_time", to=math.inf),
            "records",
            "west: 1.000 s: strategy with inf, not a finite number, 1 in all",
        ),
        (
            flaw("/west/team_strategy", *PART, "agent", to=HTML),
            "records",
            f"west: 1.000 s: round 1: strategies of {[HTML, 'west']!r}, not of one agent",
        ),
        (
            flaw("/west/team_strategy", "strategies", to=[]),
            "records",
            "west: 1.000 s: round 1: strategies of nobody",
        ),
        (
            flaw("/west/team_strategy", "round", to=2**32 - 1),
            "meetings",
            "round 4294967295: t_c is 10.000 s, not in its window",
        ),
        (
            flaw("/west/team_strategy", *PART, "agent", to="west"),
            "records",
            "west: 1.000 s: round 1: strategies of ['west', 'west'], not of one agent of the",
        ),
        (
            flaw("/west/task_event", "agent", to=HTML),
            "records",
            f"{HTML!r} is no agent of the scenario, and has 1 task event",
        ),
    ],
)
@pytest.mark.parametrize("method", ["team", "pairwise", "all-time"])
def test_messages_that_make_no_sense_are_violations(
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
    bad: Flaw,
    check: str,
    line: str,
    method: str,
) -> None:
    """By the check that is for it; the page is written all the same, with the same verdict."""
    bad.write(tmp_path / "bag")
    arguments = ("bag", "--method", method)
    status, out, _ = run(capsys, "check", *arguments, "--json")
    found = json.loads(out)
    assert status == 1
    assert method != "team" or any(own.startswith(line) for own in found["checks"][check])
    assert "\x1b" not in run(capsys, "check", *arguments)[1]
    status, out, _ = run(capsys, *VERBS["report"], *arguments, "--json")
    assert (status, json.loads(out)["verdict"]) == (0, found["verdict"])


def spoil(path: Path, old: bytes, new: bytes) -> None:
    """Replace bytes in a file by as many others."""
    data = path.read_bytes()
    assert old in data
    assert len(old) == len(new)
    path.write_bytes(data.replace(old, new))


@pytest.mark.parametrize("verb", ["check", "report"])
def test_messages_of_another_version_are_refused(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], verb: str
) -> None:
    """A bag from when a type had other fields: the one that is missing is named."""
    path = write_bag(tmp_path / "bag", hand_made_records()).path
    spoil(path, b"float64 bound", b"float64 limit")
    complaint = refusal(capsys, *VERBS[verb], "bag")
    assert re.search(r"'bag' has messages of another version: .*'bound'", complaint)


def test_no_array_is_longer_than_its_message(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Whatever its length says: here the second half of 1.0, some thousand million."""
    path = write_bag(tmp_path / "bag", hand_made_records()).path
    spoil(path, b"float64 range", b"float32 range")
    assert "'bag' holds a message that can't be decoded" in refusal(capsys, "check", "bag")
