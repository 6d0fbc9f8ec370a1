"""A comparison whose runs are made by a Dask cluster."""

import json
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest
from distributed import LocalCluster

from support.command import CORRIDOR, refusal, run

COMMAND = ("compare", CORRIDOR, "--methods", "team,none", "--rounds", "1", "--json")


@pytest.fixture(autouse=True)
def _in_empty_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)


@pytest.fixture(name="cluster", scope="module")
def cluster_(tmp_path_factory: pytest.TempPathFactory) -> Iterator[LocalCluster]:
    """Return a cluster of two processes, which share no working folder with the test."""
    with LocalCluster(
        n_workers=2,
        threads_per_worker=1,
        dashboard_address=":0",
        local_directory=str(tmp_path_factory.mktemp("dask")),
    ) as cluster:
        yield cluster


def test_a_cluster_finds_what_this_machine_does(
    cluster: LocalCluster, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """The same runs, written here; they differ in wall times alone."""
    address = cluster.scheduler_address
    status, out, _ = run(capsys, *COMMAND, "--scheduler", address, "--out", "far")
    assert status == 0
    far = json.loads(out)
    near = json.loads(run(capsys, *COMMAND, "--out", "near")[1])
    for one, other in zip(far["runs"], near["runs"], strict=True):
        for key in ("solve_wall_s", "coordination_wall_s", "wall_s"):
            one["measures"].pop(key)
            other["measures"].pop(key)
        assert one == other
    files = {path.relative_to(tmp_path / "near") for path in (tmp_path / "near").rglob("*")}
    assert files == {path.relative_to(tmp_path / "far") for path in (tmp_path / "far").rglob("*")}


def test_a_scheduler_that_isnt_there_is_told_in_one_line(
    capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    """Before a folder is made."""
    command = COMMAND[:-1]
    for address, complaint in (
        ("tcp://127.0.0.1:1", "no Dask scheduler answers at 'tcp://127.0.0.1:1'"),
        ("127.0.0.1:8786", "'127.0.0.1:8786' isn't an address"),
        ("tcp://here", "'tcp://here' isn't an address"),
    ):
        assert complaint in refusal(capsys, *command, "--scheduler", address)
    assert list(tmp_path.iterdir()) == []


def test_a_scheduler_without_workers_is_told_in_one_line(
    capsys: pytest.CaptureFixture[str],
) -> None:
    """Runs sent to it would wait for ever."""
    with LocalCluster(n_workers=0, dashboard_address=":0") as idle:
        complaint = refusal(capsys, *COMMAND[:-1], "--scheduler", idle.scheduler_address)
    assert "has no workers" in complaint


def test_without_the_extra_its_told_how_to_get_it(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    """In one line."""
    monkeypatch.setitem(sys.modules, "distributed", None)
    complaint = refusal(capsys, *COMMAND[:-1], "--scheduler", "tcp://127.0.0.1:1")
    assert "'scripts/dask --version' installs it" in complaint
