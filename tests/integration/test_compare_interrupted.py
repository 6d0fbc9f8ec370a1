"""A comparison that is interrupted, as a process of its own, and goes on."""

import json
import os
import select
import signal
import subprocess
import sys
import time
from pathlib import Path
from typing import Final

import pytest

from support.command import CORRIDOR

COMMAND: Final = [
    *(sys.executable, "-P", "-m", "tlcomm_tools", "compare", CORRIDOR),
    *("--methods", "team,static,none", "--seeds", "4", "--rounds", "10"),
]
PATIENCE_S: Final = 120.0


def children(pid: int) -> list[int]:
    """Return the living processes that a process started, and those that they did."""
    found = []
    for path in Path("/proc").glob("[0-9]*"):
        try:
            fields = (path / "stat").read_text("ascii").rpartition(")")[2].split()
        except OSError:
            continue
        if int(fields[1]) == pid and fields[0] != "Z":
            found += [int(path.name), *children(int(path.name))]
    return found


def wait_for_runs(process: subprocess.Popen[str], folder: Path, count: int) -> None:
    """Wait until so many runs are in the folder of a comparison that goes on."""
    deadline_s = time.monotonic() + PATIENCE_S
    while len(list(folder.glob("*-[0-9]"))) < count:
        assert time.monotonic() < deadline_s, "no run is done"
        with pytest.raises(subprocess.TimeoutExpired):
            process.wait(0.05)


def wait_for_workers(process: subprocess.Popen[bytes]) -> list[int]:
    """Return all that a comparison has started, once that is two workers at least."""
    while sum(b"spawn_main" in command_line(pid) for pid in children(process.pid)) < 2:
        with pytest.raises(subprocess.TimeoutExpired):
            process.wait(0.05)
    return children(process.pid)


def command_line(pid: int) -> bytes:
    """Return the command line of a process, nothing of one that has ended."""
    try:
        return Path(f"/proc/{pid}/cmdline").read_bytes()
    except OSError:
        return b""


def ends(pid: int) -> bool:
    """Return whether a process has ended, or soon does."""
    try:
        handle = os.pidfd_open(pid)
    except ProcessLookupError:
        return True
    try:
        return bool(select.select([handle], [], [], PATIENCE_S)[0])
    finally:
        os.close(handle)


def test_the_same_command_goes_on_after_ctrl_c(tmp_path: Path) -> None:
    """What was done stays untouched, nothing half-done is taken for done, and no process is left.

    The whole process group gets the signal, twice, as from an impatient terminal.
    """
    out = tmp_path / "out"
    command = [*COMMAND, "--out", str(out)]
    with subprocess.Popen(
        command, stderr=subprocess.PIPE, text=True, cwd=tmp_path, start_new_session=True
    ) as process:
        wait_for_runs(process, out, 2)
        workers = children(process.pid)
        os.killpg(process.pid, signal.SIGINT)
        os.killpg(process.pid, signal.SIGINT)
        _, errors = process.communicate(timeout=PATIENCE_S)
    assert process.returncode == 130
    assert workers
    assert all(map(ends, workers))
    done = sorted(out.glob("*-[0-9]"))
    assert 2 <= len(done) < 12
    assert f"{len(done)} of 12 runs are done" in errors
    assert "Traceback" not in errors
    before = {path: (path / "result.json").stat().st_mtime_ns for path in done}

    again = subprocess.run(
        [*command, "--json"], capture_output=True, text=True, cwd=tmp_path, check=True
    )
    found = json.loads(again.stdout)
    assert [run["error"] for run in found["runs"]] == [None] * 12
    assert before == {path: (path / "result.json").stat().st_mtime_ns for path in done}
    assert not list(out.glob(".*"))


def test_runs_under_way_are_given_up(tmp_path: Path) -> None:
    """However long they would still take."""
    command = [*COMMAND[:6], "--methods", "none", "--seeds", "2", "--until", "1e7"]
    with subprocess.Popen(
        [*command, "--out", "out"], stderr=subprocess.DEVNULL, cwd=tmp_path
    ) as process:
        try:
            workers = wait_for_workers(process)
            process.send_signal(signal.SIGTERM)
            assert process.wait(PATIENCE_S) == 130
        finally:
            process.kill()
    assert all(map(ends, workers))
    assert [path.name for path in (tmp_path / "out").iterdir()] == ["terms.json"]


def test_workers_end_with_a_comparison_that_is_killed(tmp_path: Path) -> None:
    """However it ends: a worker that lost its parent has nobody to work for."""
    out = tmp_path / "out"
    with subprocess.Popen(
        [*COMMAND, "--out", str(out)], stderr=subprocess.DEVNULL, text=True, cwd=tmp_path
    ) as process:
        wait_for_runs(process, out, 1)
        workers = children(process.pid)
        process.kill()
    assert workers
    assert all(map(ends, workers))
