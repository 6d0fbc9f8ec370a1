"""A comparison through ROS processes."""

import json
from pathlib import Path

import pytest

from support.command import CORRIDOR, run

WALL = {"solve_wall_s", "coordination_wall_s", "wall_s"}


def test_processes_leave_the_figures_of_the_simulation(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """And bags, each of which passes its audit."""
    monkeypatch.chdir(tmp_path)
    command = ("compare", CORRIDOR, "--methods", "team,none", "--rounds", "1", "--json")
    status, out, _ = run(capsys, *command, "--processes", "--out", "run")
    assert status == 0
    found = json.loads(out)
    simulated = json.loads(run(capsys, *command, "--out", "simulated")[1])
    for one, other in zip(found["runs"], simulated["runs"], strict=True):
        assert {key: value for key, value in one["measures"].items() if key not in WALL} == (
            {key: value for key, value in other["measures"].items() if key not in WALL}
        )
        folder = tmp_path / "run" / one["folder"]
        assert run(capsys, "check", str(folder))[0] == 0
        trace, expected = (
            json.loads((tmp_path / name / one["folder"] / "trace.json").read_text("utf-8"))
            for name in ("run", "simulated")
        )
        assert trace == expected
