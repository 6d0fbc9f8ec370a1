"""The verb ``simulate``."""

import json
import re
from pathlib import Path

import pytest

from support.command import CORRIDOR, refusal, run
from tlcomm_core.result import result_document


def test_out_must_be_empty_and_writable(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """``--out`` takes no folder that holds something, and no place where none can be."""
    (tmp_path / "full").mkdir()
    (tmp_path / "full" / "file").touch()
    (tmp_path / "file").touch()
    for out, complaint in (
        ("full", "'full' isn't empty"),
        ("file", "can't make the folder 'file': File exists"),
        ("file/below", "can't make the folder 'file/below': Not a directory"),
    ):
        assert complaint in refusal(capsys, "simulate", CORRIDOR, "--out", out)


def test_simulate_writes_its_files(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Scenario, event log and results are in the folder; --json is result.json and the folder."""
    status, out, _ = run(capsys, "simulate", CORRIDOR, "--rounds", "2", "--out", "mine", "--json")
    assert status == 0
    result = json.loads(out)
    assert result.pop("folder") == "mine"
    assert result == json.loads((tmp_path / "mine" / "result.json").read_text("utf-8"))
    assert (result["verdict"], len(result["rounds"])) == ("ok", 2)
    events = (tmp_path / "mine" / "events.jsonl").read_text("utf-8").splitlines()
    assert json.loads(events[0])["stamp_ns"] == 0
    assert run(capsys, "validate", "mine/scenario.yaml")[0] == 0


def test_simulate_ends_when_told(capsys: pytest.CaptureFixture[str]) -> None:
    """--until is the simulated time at the end, to the nanosecond."""
    _, out, _ = run(capsys, "simulate", CORRIDOR, "--until", "12.5", "--json")
    assert json.loads(out)["sim_s"] == 12.5


def test_simulate_makes_folders_of_its_own(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Without --out each run has a new folder below runs/, two within a second too."""
    for _ in range(2):
        status, out, _ = run(capsys, "simulate", CORRIDOR, "--until", "5")
        assert status == 0
        assert max(map(len, out.splitlines())) <= 80
    names = sorted(path.name for path in (tmp_path / "runs").iterdir())
    assert len(names) == 2
    assert all(re.fullmatch(r"corridor-team-\d{8}-\d{6}(-2)?", name) for name in names)


def test_the_same_seed_gives_the_same_log(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Two simulations with the same seed have the same event log, byte for byte."""
    for out in ("a", "b"):
        run(capsys, "simulate", CORRIDOR, "--rounds", "2", "--seed", "4", "--out", out)
    logs = [(tmp_path / out / "events.jsonl").read_bytes() for out in ("a", "b")]
    assert logs[0] == logs[1]


def test_a_failed_property_is_status_1(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    """A simulation whose verdict isn't ok ends with status 1, its files written."""
    monkeypatch.setattr(
        "tlcomm_tools.timed_simulation.result_document",
        lambda *run: {**result_document(*run), "verdict": ["window 1 missed"]},
    )
    status, out, _ = run(capsys, "simulate", CORRIDOR, "--until", "5", "--out", "mine")
    assert status == 1
    assert "verdict: FAILED\n  - window 1 missed\n" in out
    assert (tmp_path / "mine" / "result.json").is_file()


def test_an_automaton_stands_for_a_task(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Made by another tool, it is planned and carried out, and goes into the run's scenario."""
    task = "G F ((west_shelf & pick) & F (west_bench & place))"
    (tmp_path / "west.hoa").write_text(run(capsys, "ltl", task, "--hoa")[1], "utf-8")
    text = Path(CORRIDOR).read_text("utf-8")
    (tmp_path / "hoa.yaml").write_text(text.replace(f'task: "{task}"', "automaton: west.hoa"))
    assert run(capsys, "validate", "hoa.yaml")[0] == 0
    status, out, _ = run(capsys, "plan", "hoa.yaml", "--agent", "west")
    assert (status, out.splitlines()[0]) == (0, "west: the given automaton")
    results = []
    for name in (CORRIDOR, "hoa.yaml"):
        folder = Path(name).stem
        status, out, _ = run(capsys, "simulate", name, "--rounds", "2", "--out", folder, "--json")
        results.append((status, json.loads(out)["agents"]))
    assert results[0] == results[1]
    (tmp_path / "west.hoa").unlink()
    assert run(capsys, "validate", "hoa/scenario.yaml")[0] == 0
