"""Runs as real processes: what they record, and what is left of them when something breaks."""

import json
import os
import resource
import signal
import subprocess
from collections.abc import Callable
from pathlib import Path

import pytest
from rosbags.highlevel import AnyReader

from support.command import CORRIDOR, command
from support.processes import processes_of
from tlcomm_core.errors import InputError
from tlcomm_core.scenario.loader import loads
from tlcomm_tools.audit.findings import audit_run
from tlcomm_tools.bag.reader import read_run
from tlcomm_tools.bag.topics import mirror_topics, recorded_topics

pytest.importorskip("rclpy", reason="needs ROS 2: run by scripts/test")

AGENTS = ("west", "carrier", "east")


def start_run(folder: Path) -> "subprocess.Popen[str]":
    """Start a run that goes on until something ends it."""
    return subprocess.Popen(
        command("run", CORRIDOR, "--until", "1e6", "--out", str(folder)),
        stdout=subprocess.DEVNULL,
        stderr=subprocess.PIPE,
        text=True,
    )


def break_run(folder: Path, act: Callable[["subprocess.Popen[str]"], None]) -> tuple[int, str]:
    """Run, act once something has come into the bag, and return exit status and errors."""
    with start_run(folder) as process:
        assert process.stderr is not None
        for line in process.stderr:
            if " s simulated" in line and has_messages(folder):
                break
        act(process)
        _, errors = process.communicate(timeout=60)
    return process.returncode, errors


def has_messages(folder: Path) -> bool:
    """Tell whether a run's bag holds anything yet."""
    try:
        return read_run(folder).end_ns > 0
    except InputError:
        return False


def assert_readable(folder: Path) -> None:
    """The bag has something in it, for us and for the rosbags library, and nothing is wrong."""
    run = read_run(folder)
    assert run.damage == ""
    assert run.end_ns > 0
    with AnyReader([folder / "bag"]) as reader:
        assert reader.message_count > 0
    scenario = loads(run.notes["scenario"])
    assert audit_run(scenario, run.method, run.records, run.end_ns).violations == ()


def test_a_run_prints_its_result(finished: tuple[Path, str]) -> None:
    """--json is the file's content and the folder's name, and nothing else."""
    folder, printed = finished
    document = json.loads(printed)
    assert document.pop("folder") == str(folder)
    assert document == json.loads((folder / "result.json").read_text("utf-8"))
    assert document["verdict"] == "ok"
    assert [own["round"] for own in document["rounds"]] == [1, 2, 3]


def test_a_run_leaves_no_process(finished: tuple[Path, str]) -> None:
    """When the command returns none of its processes lives."""
    assert processes_of(finished[0]) == []


def test_run_and_simulation_are_one(finished: tuple[Path, str], tmp_path: Path) -> None:
    """The event log from the bag equals the simulation's byte for byte, and so do the results."""
    folder, _ = finished
    arguments = ("simulate", CORRIDOR, "--rounds", "3", "--out", str(tmp_path / "run"))
    subprocess.run(command(*arguments), capture_output=True, check=True)
    names = ("events.jsonl", "scenario.yaml")
    for name in names:
        assert (folder / name).read_bytes() == (tmp_path / "run" / name).read_bytes()
    recorded, simulated = (
        json.loads((path / "result.json").read_text("utf-8")) for path in (folder, tmp_path / "run")
    )
    for document in (recorded, simulated):
        for key in ("wall_s", "realtime_factor"):
            del document[key]
        del document["metrics"]["computing"]
        for own in document["rounds"]:
            del own["solve_wall_s"], own["coordination_wall_s"]
    assert recorded == simulated


def test_every_topic_is_in_the_bag(finished: tuple[Path, str]) -> None:
    """The bag has the contract's topics with their types, and the clock's tenths of a second."""
    with AnyReader([finished[0] / "bag"]) as reader:
        found = {own.topic: own.msgtype for own in reader.connections}
        counts = {own.topic: own.msgcount for own in reader.connections}
        duration_ns = reader.duration
    topics = (*recorded_topics(AGENTS), *mirror_topics(AGENTS))
    assert found == {own.name: own.type for own in topics}
    assert duration_ns > 90e9
    last_s = duration_ns // 10**9
    assert {counts[own.name] for own in mirror_topics(AGENTS)} == {1, last_s + 1, last_s // 2 + 1}
    assert counts["/clock"] == pytest.approx(duration_ns / 1e8, abs=2)
    assert min(counts[f"/{name}/cmd_vel"] for name in AGENTS) > 10


def test_the_bag_says_what_was_run(finished: tuple[Path, str]) -> None:
    """Scenario, method, solver, seed and pace are inside, so that others need nothing beside it."""
    notes = read_run(finished[0] / "bag").notes
    assert loads(notes.pop("scenario")).name == "corridor"
    expected = {"method": "team", "solver": "coalition", "seed": "0", "pace": "lockstep"}
    assert notes == expected


def test_the_audit_passes(finished: tuple[Path, str]) -> None:
    """The audit of the run's folder finds nothing, and tasks done again and again."""
    done = subprocess.run(
        command("check", str(finished[0]), "--json"), capture_output=True, text=True, check=True
    )
    document = json.loads(done.stdout)
    assert document["verdict"] == "ok"
    assert all(own["satisfied"] == own["claimed"] > 0 for own in document["tasks"].values())


@pytest.mark.parametrize("name", ["recorder", "carrier"])
def test_a_killed_process_ends_the_run(tmp_path: Path, name: str) -> None:
    """SIGKILL of recorder or agent: exit status 3, its name, a result, and a bag that is whole."""
    folder = tmp_path / "run"
    role = "process recorder" if name == "recorder" else f"--name {name}"

    def kill(_: "subprocess.Popen[str]") -> None:
        (pid,) = processes_of(folder, role)
        os.kill(pid, signal.SIGKILL)

    status, errors = break_run(folder, kill)
    assert status == 3
    assert f"tlcomm: error: {name}: killed by SIGKILL" in errors
    result = json.loads((folder / "result.json").read_text("utf-8"))
    assert result["verdict"] == [f"{name}: killed by SIGKILL"]
    assert result["communication"]["missed"] == 0
    assert_readable(folder)
    assert processes_of(folder) == []


def test_an_interrupted_run_keeps_what_it_has(tmp_path: Path) -> None:
    """Ctrl-C: exit status 130, and result and bag of all that was recorded."""
    folder = tmp_path / "run"
    status, _ = break_run(folder, lambda process: process.send_signal(signal.SIGINT))
    assert status == 130
    assert json.loads((folder / "result.json").read_text("utf-8"))["verdict"] == ["interrupted"]
    assert_readable(folder)
    assert processes_of(folder) == []


def test_a_full_disk_ends_the_run(tmp_path: Path) -> None:
    """When the bag can't grow any more the run stops, says so, and the bag stays whole."""
    folder = tmp_path / "run"

    def limit(_: "subprocess.Popen[str]") -> None:
        (pid,) = processes_of(folder, "process recorder")
        resource.prlimit(pid, resource.RLIMIT_FSIZE, (100_000, 100_000))

    status, errors = break_run(folder, limit)
    assert status == 3
    assert f"tlcomm: error: recorder: can't write '{folder}/bag' any more: File too large" in errors
    assert_readable(folder)
