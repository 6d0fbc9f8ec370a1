"""A recorder that is killed in a running run: what its bag has, in lock step and in real time."""

import os
import signal
import subprocess
import time
from collections import deque
from pathlib import Path

import pytest
from mcap.reader import make_reader
from rosbags.highlevel import AnyReader

from support.command import CORRIDOR, command
from support.processes import processes_of
from tlcomm_core.mission import Mission
from tlcomm_core.records import event_log
from tlcomm_core.scenario.loader import load_scenario
from tlcomm_core.scenario.site import Site
from tlcomm_core.simulation import simulate
from tlcomm_core.units import NANOSECONDS_PER_SECOND, seconds
from tlcomm_tools.bag.compression import Compression
from tlcomm_tools.bag.container import read_container
from tlcomm_tools.bag.reader import read_run
from tlcomm_tools.bag.repair import inspect

pytest.importorskip("rclpy", reason="needs ROS 2: run by scripts/test")

# How far a run goes before its recorder is killed (s), at which pace, with what compression.
KILLS = [
    (30.0, "lockstep", Compression.ZSTD),
    (200.0, "lockstep", Compression.NONE),
    (700.0, "lockstep", Compression.LZ4),
    (2.0, "1.0", Compression.ZSTD),
    (20.0, "5.0", Compression.LZ4),
]
_LOST_S = 1.0


def kill_recorder(folder: Path, at_s: float, pace: str, compression: Compression) -> float:
    """Run, and kill the recorder at a simulated time.

    Returns:
        The simulated time (s) that the run was known to have reached a second before.
    """
    arguments = ("--until", "1e6", "--pace", pace, "--compression", compression)
    process = subprocess.Popen(
        command("run", CORRIDOR, *arguments, "--out", str(folder)),
        stdout=subprocess.DEVNULL,
        stderr=subprocess.PIPE,
        text=True,
    )
    reached: deque[tuple[float, float]] = deque([(0.0, 0.0)])
    with process:
        assert process.stderr is not None
        for line in process.stderr:
            if " s simulated" in line:
                sim_s = float(line.partition(" s simulated")[0].split()[-1])
                reached.append((time.monotonic(), sim_s))
                if sim_s >= at_s:
                    break
        (recorder,) = processes_of(folder, "process recorder")
        os.kill(recorder, signal.SIGKILL)
        killed_s = time.monotonic()
        process.communicate(timeout=60)
    return max(sim_s for wall_s, sim_s in reached if wall_s <= killed_s - _LOST_S)


def last_times_ns(path: Path) -> dict[str, int]:
    """Return the last time of each topic that has any."""
    held = read_container(path, lambda _: True)
    assert held.damage == ""
    last_ns: dict[str, int] = {}
    for number, stamp_ns, _ in held.messages:
        name = held.channels[number].topic
        last_ns[name] = max(stamp_ns, last_ns.get(name, 0))
    return last_ns


def assert_whole_until_its_end(bag: Path) -> None:
    """Everything that was decided up to the last time is there, as in the other harness."""
    run = read_run(bag)
    site = Site.from_scenario(load_scenario(CORRIDOR))
    whole = simulate(Mission(site, 0, None, seconds(run.end_ns + 1))).records
    assert list(event_log(run.records)) == list(event_log(whole))


@pytest.mark.parametrize(("at_s", "pace", "compression"), KILLS)
def test_a_killed_recorder_leaves_a_bag(
    tmp_path: Path, at_s: float, pace: str, compression: Compression
) -> None:
    """It opens everywhere, and lacks the last second at most; in lock step it ends at one time."""
    folder = tmp_path / "run"
    certain_s = kill_recorder(folder, at_s, pace, compression)
    path = folder / "bag" / "bag_0.mcap"
    last_ns = last_times_ns(path)
    assert last_ns["/clock"] >= certain_s * NANOSECONDS_PER_SECOND
    if pace == "lockstep":
        assert_whole_until_its_end(folder / "bag")
        # The clock goes on in tenths of a second, each before anything later.
        assert max(last_ns.values()) < last_ns["/clock"] + NANOSECONDS_PER_SECOND // 10
        assert last_ns["/team_markers"] == last_ns["/clock"] // 10**9 * 10**9
    assert inspect(path).flaw == ""
    with AnyReader([folder / "bag"]) as reader:
        assert reader.message_count > 0
    with path.open("rb") as stream:
        summary = make_reader(stream, validate_crcs=True).get_summary()
    assert summary is not None
    assert {chunk.compression for chunk in summary.chunk_indexes} == {compression.tag}


@pytest.mark.parametrize("compression", Compression)
def test_what_a_cut_left_is_finished_and_audited(tmp_path: Path, compression: Compression) -> None:
    """Repair keeps all chunks before the one that was cut, and the audit reads what it made."""
    folder = tmp_path / "run"
    kill_recorder(folder, 100.0, "lockstep", compression)
    path = folder / "bag" / "bag_0.mcap"
    whole_ns = read_container(path, lambda _: False).end_ns
    data = path.read_bytes()
    path.write_bytes(data[: len(data) * 3 // 4])
    finished = tmp_path / "finished"
    done = subprocess.run(
        command("repair", str(folder / "bag"), "-o", str(finished)),
        capture_output=True,
        text=True,
        check=True,
    )
    assert "the file has no end" in done.stdout
    (repaired,) = finished.glob("*.mcap")
    last_ns = last_times_ns(repaired)
    assert whole_ns is not None
    assert 0 < last_ns["/clock"] <= whole_ns
    assert max(last_ns.values()) < last_ns["/clock"] + NANOSECONDS_PER_SECOND // 10
    audited = subprocess.run(
        command("check", str(finished), "--json"), capture_output=True, text=True, check=False
    )
    assert audited.returncode == 0, audited.stdout + audited.stderr
