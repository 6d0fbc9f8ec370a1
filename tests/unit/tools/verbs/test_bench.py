"""The verb ``bench``."""

import json

import pytest

from support.command import CORRIDOR, run


def test_bench(capsys: pytest.CaptureFixture[str]) -> None:
    """The table has a row per scenario and fits 80 columns; JSON has the same figures."""
    status, out, _ = run(capsys, "bench", CORRIDOR, "--repeats", "1", "--rounds", "1")
    assert status == 0
    assert "corridor" in out
    assert max(map(len, out.splitlines())) <= 80
    _, out, _ = run(capsys, "bench", CORRIDOR, "--repeats", "1", "--rounds", "1", "--json")
    (measured,) = json.loads(out)["scenarios"]
    assert all(measured[key] > 0.0 for key in ("plan_s", "solve_s", "own_solve_s", "simulate_s"))
