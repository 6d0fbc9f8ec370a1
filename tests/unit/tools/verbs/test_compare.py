"""The verb ``compare``."""

import csv
import io
import json
from pathlib import Path

import pytest

from support.command import CORRIDOR, refusal, run
from tlcomm_core.scenario.loader import dumps, load_scenario

BRIEF = ("compare", CORRIDOR, "--methods", "team,none", "--rounds", "1")


def test_compare_writes_its_files(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """A folder per run, the same findings as JSON, CSV and table, and figures."""
    status, out, _ = run(capsys, *BRIEF, "--seeds", "2", "--out", "mine", "--json")
    assert status == 0
    found = json.loads(out)
    folder = tmp_path / "mine"
    assert found.pop("folder") == "mine"
    assert found == json.loads((folder / "comparison.json").read_text("utf-8"))
    runs = ["team-0", "team-1", "none-0", "none-1"]
    assert [own["folder"] for own in found["runs"]] == runs
    rows = list(csv.DictReader(io.StringIO((folder / "comparison.csv").read_text("utf-8"))))
    for own, row in zip(found["runs"], rows, strict=True):
        assert {key: float(row[key]) if row[key] else None for key in own["measures"]} == (
            own["measures"]
        )
        result = json.loads((folder / own["folder"] / "result.json").read_text("utf-8"))
        assert (result["method"], result["seed"]) == (own["method"], own["seed"])
        assert result["sim_s"] == 62.9995
        assert own["measures"]["windows"] == 2
        traced = (folder / own["folder"] / "trace.json").exists()
        assert traced is (own["seed"] == 0)
    for name in ("metrics.svg", "additional_time.png", "workspace.svg", "cost.svg"):
        assert (folder / "figures" / name).exists()
    assert "| windows kept |" in (folder / "comparison.md").read_text("utf-8")
    assert run(capsys, "validate", "mine/team-1/scenario.yaml")[0] == 0


def test_what_is_done_isnt_done_again(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """The same command goes on in its folder, also with more methods and seeds."""
    command = (*BRIEF, "--out", "mine")
    assert run(capsys, *command)[0] == 0
    files = sorted((tmp_path / "mine").glob("*-0/*"))
    before = [path.stat().st_mtime_ns for path in files]
    status, out, _ = run(capsys, *command, "--methods", "team,none,static", "--seeds", "2")
    assert (status, "static" in out) == (0, True)
    assert len(list((tmp_path / "mine").glob("*-[01]"))) == 6
    assert [path.stat().st_mtime_ns for path in files] == before


def test_a_run_that_fails_doesnt_stop_the_others(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Its reason is in table and document, and the status tells."""
    scenario = load_scenario(CORRIDOR)
    timing = {"period_s": 6.0, "on_infeasible": "stop"}
    communication = scenario.communication.model_copy(update=timing)
    tight = scenario.model_copy(update={"communication": communication})
    (tmp_path / "tight.yaml").write_text(dumps(tight), "utf-8")
    command = ("compare", "tight.yaml", "--methods", "team,none", "--rounds", "3", "--out", "mine")
    status, out, _ = run(capsys, *command)
    assert status == 1
    assert "Failed:\n  - team-0: round " in out
    found = json.loads((tmp_path / "mine" / "comparison.json").read_text("utf-8"))
    team, none = found["runs"]
    assert team["error"].startswith("round ")
    assert none["error"] is None
    assert none["measures"]["tasks_satisfied"] > 0
    assert not (tmp_path / "mine" / "team-0").exists()


def test_a_sweep_has_a_row_per_value_and_one_figure(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Beside the methods."""
    command = ("compare", CORRIDOR, "--methods", "none", "--rounds", "0", "--sweep", "range=1,2")
    assert run(capsys, *command, "--out", "mine")[0] == 0
    rows = list(
        csv.DictReader(io.StringIO((tmp_path / "mine" / "comparison.csv").read_text("utf-8")))
    )
    assert [(row["range"], row["folder"]) for row in rows] == [
        ("1.0", "range-1/none-0"),
        ("2.0", "range-2/none-0"),
    ]
    figures = sorted(path.name for path in (tmp_path / "mine" / "figures").iterdir())
    assert figures == ["sweep_range.png", "sweep_range.svg"]


@pytest.mark.parametrize(
    ("arguments", "complaint"),
    [
        (("--methods", "team,foo"), "invalid choice: 'foo'"),
        (("--methods", ""), "invalid choice: ''"),
        (("--seeds", "0"), "from 1 on, not '0'"),
        (("--rounds", "1", "--until", "5"), "not allowed with argument --rounds"),
        (("--sweep", "colour=1"), "not 'colour=1'"),
        (("--sweep", "loss=x"), "expected a number from 0 on, not 'x'"),
        (("--sweep", "agents=2,4"), "agents=4: scenario 'corridor' has no more than 3"),
        (("--sweep", "range=0.3"), "range=0.3: corridor: agents"),
        (("--processes", "--scheduler", "tcp://here:1"), "not allowed with argument --processes"),
    ],
)
def test_bad_usage_is_refused(
    tmp_path: Path,
    arguments: tuple[str, ...],
    complaint: str,
    capsys: pytest.CaptureFixture[str],
) -> None:
    """In one line, before anything is written."""
    assert complaint in refusal(capsys, "compare", CORRIDOR, *arguments)
    assert list(tmp_path.iterdir()) == []


def test_a_folder_of_another_comparison_is_refused(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """As is one that holds something else, or can't be made."""
    (tmp_path / "file").touch()
    (tmp_path / "full").mkdir()
    (tmp_path / "full" / "file").touch()
    assert run(capsys, *BRIEF, "--methods", "none", "--out", "mine")[0] == 0
    for arguments, complaint in (
        (("--rounds", "2", "--out", "mine"), "a comparison with rounds 1, not 2"),
        (("--solver", "exact", "--out", "mine"), '"coalition", not "exact"'),
        (("--out", "full"), "'full' isn't empty and holds no comparison"),
        (("--out", "file/below"), "can't make the folder 'file/below': Not a directory"),
    ):
        assert complaint in refusal(capsys, *BRIEF, *arguments)


def test_an_agent_without_a_plan_is_told_before_any_run(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Every run would fail."""
    text = (
        Path(CORRIDOR).read_text("utf-8").replace("G F ((west_shelf & pick)", "G !pick & F (pick")
    )
    (tmp_path / "bad.yaml").write_text(text.replace('place))"', 'place))"'), "utf-8")
    assert "bad.yaml" in refusal(capsys, "compare", "bad.yaml")
    assert [path.name for path in tmp_path.iterdir()] == ["bad.yaml"]
