"""What ``bench --recording`` measures, with real processes."""

import json
import subprocess
import sys
from pathlib import Path

import pytest

pytest.importorskip("rclpy", reason="needs ROS 2: run by scripts/test")

SCENARIO = Path(__file__).parents[2] / "scenarios" / "corridor.yaml"


def bench(tmp_path: Path, *options: str) -> str:
    """Run the bench in an empty folder; return what it prints."""
    arguments = ("bench", str(SCENARIO), "--recording", "--rounds", "1", "--repeats", "1")
    return subprocess.run(
        [sys.executable, "-m", "tlcomm_tools", *arguments, *options],
        capture_output=True,
        text=True,
        check=True,
        cwd=tmp_path,
    ).stdout


def test_a_pair_of_runs_is_compared(tmp_path: Path) -> None:
    """Of the same simulated time, with a bag and without, and nothing is left behind."""
    (row,) = json.loads(bench(tmp_path, "--json"))["recording"]
    assert (row["scenario"], row["agents"]) == ("corridor", 3)
    assert row["sim_s"] > 50.0
    assert row["bag_bytes"] > 10_000
    for kind in ("wall", "cpu"):
        with_s, without_s = row[f"{kind}_s"], row[f"unrecorded_{kind}_s"]
        assert with_s > 0.0
        assert without_s > 0.0
        assert row[f"{kind}_ratio"] == pytest.approx(with_s / without_s)
    assert list(tmp_path.iterdir()) == []


def test_the_table_fits_a_terminal(tmp_path: Path) -> None:
    """With a row per scenario."""
    table = bench(tmp_path)
    assert "\n  corridor" in table
    assert max(map(len, table.splitlines())) <= 80
