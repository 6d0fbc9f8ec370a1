"""The verb ``bench``."""

import json
from typing import Any

import pytest

from support.command import CORRIDOR, run

Rows = list[dict[str, Any]]


def test_bench(capsys: pytest.CaptureFixture[str]) -> None:
    """The table has a row per scenario and fits 80 columns; JSON has the same figures."""
    status, out, _ = run(capsys, "bench", CORRIDOR, "--repeats", "1", "--rounds", "1")
    assert status == 0
    assert "corridor" in out
    assert max(map(len, out.splitlines())) <= 80
    _, out, _ = run(capsys, "bench", CORRIDOR, "--repeats", "1", "--rounds", "1", "--json")
    (measured,) = json.loads(out)["scenarios"]
    assert all(measured[key] > 0.0 for key in ("plan_s", "solve_s", "own_solve_s", "simulate_s"))


def measured(capsys: pytest.CaptureFixture[str], what: str, agents: int) -> tuple[Rows, str]:
    """Return the rows of a kind of bench on one random team, and what a person reads."""
    asked = ("bench", CORRIDOR, f"--{what}", "--agents", str(agents), "--instances", "1")
    status, text, progress = run(capsys, *asked)
    assert status == 0
    assert max(map(len, text.splitlines())) <= 80
    _, out, _ = run(capsys, *asked, "--json")
    rows: Rows = json.loads(out)[what]
    return rows, f"{text}{progress}"


def test_bench_of_solvers(capsys: pytest.CaptureFixture[str]) -> None:
    """Each solver has a row for the scenario's rounds and for random ones, next to the optimum."""
    rows, text = measured(capsys, "solvers", 4)
    assert "random 4 coalition" in text
    assert {(row["instances"], row["solver"]) for row in rows} == {
        (instances, solver)
        for instances in ("corridor", "random")
        for solver in ("best-response", "coalition", "exact")
    }
    assert all(row["mean_ratio"] >= 1.0 - 1e-9 for row in rows)


def test_bench_of_traffic(capsys: pytest.CaptureFixture[str]) -> None:
    """Each solver has a row for each size."""
    rows, text = measured(capsys, "traffic", 3)
    assert "coalition" in text
    assert {row["solver"] for row in rows} >= {"best-response", "coalition"}
    assert all(row["agents"] == 3 for row in rows)
