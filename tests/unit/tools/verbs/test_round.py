"""The verb ``round``."""

import json
from pathlib import Path

import pytest

from support.command import CORRIDOR, refusal, run


def test_round(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """The round document is on standard output and in the file, and is what a run decides."""
    status, out, _ = run(capsys, "round", CORRIDOR, "--round", "2", "--out", "r.json", "--json")
    assert status == 0
    document = json.loads(out)
    assert json.loads((tmp_path / "r.json").read_text("utf-8")) == document
    assert (document["format"], document["round"]) == ("tlcomm-round/1", 2)
    _, out, _ = run(capsys, "simulate", CORRIDOR, "--rounds", "2", "--json")
    decided = json.loads(out)["rounds"][1]
    assert document["coalition"]["potential"] == pytest.approx(decided["potential"], abs=1e-6)
    arrivals_s = [
        own["arrival"][candidate][location]
        for own, candidate, location in zip(
            document["candidates"],
            document["coalition"]["candidate"],
            document["coalition"]["location"],
            strict=True,
        )
    ]
    starts_s = max(*arrivals_s, document["window"][0])
    assert starts_s == pytest.approx(decided["planned_t_c"], abs=1e-6)
    assert document["initial"]["potential"] == pytest.approx(decided["initial_potential"], abs=1e-6)
    status, out, _ = run(capsys, "round", CORRIDOR, "--round", "1")
    assert status == 0
    assert max(map(len, out.splitlines())) <= 80


def test_out_must_be_writable(capsys: pytest.CaptureFixture[str]) -> None:
    """``--out`` takes no file where none can be."""
    complaint = refusal(capsys, "round", CORRIDOR, "--round", "1", "--out", "none/r.json")
    assert "can't write 'none/r.json': No such file or directory" in complaint
