"""Tests of ``tlcomm_tools.cli``: exit statuses, one-line errors, JSON and help."""

import json
import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

from support.hand_made_run import hand_made_records, hand_made_scenario, write_bag
from tlcomm_core.agent.actions import TaskEventKind
from tlcomm_core.scenario.loader import dumps
from tlcomm_tools.cli import VERBS, main

ROOT = Path(__file__).parents[3]
SCENARIO = str(ROOT / "scenarios" / "corridor.yaml")


@pytest.fixture(autouse=True)
def _in_empty_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)


def run(capsys: pytest.CaptureFixture[str], *arguments: str) -> tuple[int, str, str]:
    """Run the command; return its status, output and errors."""
    status = main(arguments)
    captured = capsys.readouterr()
    return status, captured.out, captured.err


@pytest.mark.parametrize("verb", VERBS)
def test_each_verb_has_help_with_an_example(verb: str, capsys: pytest.CaptureFixture[str]) -> None:
    """``--help`` says what the verb does, and shows one command, at exit status 0."""
    status, out, err = run(capsys, verb, "--help")
    assert (status, err) == (0, "")
    assert out.startswith(f"usage: tlcomm {verb}")
    assert f"example: tlcomm {verb}" in out


@pytest.mark.parametrize("arguments", [["--help"], ["-h"]])
def test_the_overview_lists_the_verbs(
    arguments: list[str], capsys: pytest.CaptureFixture[str]
) -> None:
    """The command's own help lists every verb, within 80 columns."""
    status, out, _ = run(capsys, *arguments)
    assert status == 0
    assert all(f"\n  {verb} " in out for verb in VERBS)
    assert max(map(len, out.splitlines())) <= 80


def test_no_verb_is_a_usage_error(capsys: pytest.CaptureFixture[str]) -> None:
    """Without a verb one line lists them, at exit status 2."""
    status, out, err = run(capsys)
    assert status == 2
    assert out == ""
    assert err.startswith("tlcomm: error: expected a verb (the verbs are demo, run,")


BAD_USAGE = [
    (["report", "x"], "unknown verb 'report' (the verbs are demo, run,"),
    (["compare"], "unknown verb 'compare'"),
    (["--version"], "unknown verb '--version'"),
    (["validate"], "the following arguments are required: SCENARIO"),
    (["validate", "missing.yaml"], "missing.yaml"),
    (["validate", "."], "."),
    (["validate", SCENARIO, "--fast"], "unrecognized arguments: --fast"),
    (["validate", SCENARIO, "more"], "unrecognized arguments: more"),
    (["plan", SCENARIO, "--agent", "nobody"], "no agent 'nobody' (the agents are west, carrier"),
    (["plan", SCENARIO, "--gamma", "0"], "--gamma: expected a number or a ratio from 1e-9 to 1e9"),
    (
        ["plan", SCENARIO, "--gamma", "1e-99999999"],
        "--gamma: expected a number or a ratio from 1e-9 to 1e9",
    ),
    (
        ["plan", SCENARIO, "--gamma", "inf"],
        "--gamma: expected a number or a ratio from 1e-9 to 1e9",
    ),
    (["ltl", "G F (a &"], "column 9: expected an operand after '&'"),
    (["ltl", "a", "--hoa", "--dot"], "not allowed with argument"),
    (["ltl"], "required: FORMULA"),
    (["round", SCENARIO], "required: --round"),
    (["round", SCENARIO, "--round", "0"], "--round: expected a whole number from 1 on, not '0'"),
    (["round", SCENARIO, "--round", "x"], "--round: expected a whole number from 1 on, not 'x'"),
    (["simulate", SCENARIO, "--rounds", "-1"], "--rounds: expected a whole number from 0 on"),
    (["simulate", SCENARIO, "--rounds", "2.5"], "--rounds: expected a whole number from 0 on"),
    (["simulate", SCENARIO, "--rounds"], "--rounds: expected one argument"),
    (["simulate", SCENARIO, "--rounds", "1", "--until", "9"], "not allowed with argument"),
    (["simulate", SCENARIO, "--until", "0"], "--until: expected a number greater than 0, not '0'"),
    (["simulate", SCENARIO, "--until", "inf"], "--until: expected a number greater than 0"),
    (["simulate", SCENARIO, "--until", "nan"], "--until: expected a number greater than 0"),
    (["simulate", SCENARIO, "--seed", "-3"], "--seed: expected a whole number from 0 on"),
    (["simulate", SCENARIO, "--pace", "2.0"], "--pace: '2.0' is for 'tlcomm run'"),
    (["simulate", SCENARIO, "--solver", "nonsense"], "(choose from 'best-response')"),
    (["simulate", SCENARIO, "--solver", "nonsense"], "invalid choice: 'nonsense'"),
    (["simulate", SCENARIO, "--method", "pairwise"], "'pairwise' is not available yet"),
    (["simulate", SCENARIO, "--method", "magic"], "invalid choice: 'magic' (choose from 'team')"),
    (["run", SCENARIO, "--pace", "fast"], "expected 'lockstep' or a factor greater than 0"),
    (["run", SCENARIO, "--pace", "0"], "(1.0 is real time), not '0'"),
    (["run", SCENARIO, "--pace", "-1"], "not '-1'"),
    (["run", "missing.yaml"], "missing.yaml"),
    (["check"], "required: RUN_OR_BAG"),
    (["check", "missing"], "'missing' doesn't exist"),
    (["check", "."], "holds no bag"),
    (["bench", SCENARIO, "--repeats", "0"], "--repeats: expected a whole number from 1 on"),
]


@pytest.mark.parametrize(("arguments", "complaint"), BAD_USAGE)
def test_bad_usage_is_one_line(
    arguments: list[str], complaint: str, capsys: pytest.CaptureFixture[str]
) -> None:
    """Bad usage or input gives exit status 2 and one line that says what, and nothing else."""
    status, out, err = run(capsys, *arguments)
    assert status == 2
    assert out == ""
    assert re.fullmatch(r"tlcomm: error: .*\n", err)
    assert complaint in err


def test_a_scenarios_error_names_file_and_line(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """A bad scenario is told with its file, its line and the value."""
    text = Path(SCENARIO).read_text("utf-8").replace("cell_m: 0.5", "cell_m: -0.5")
    (tmp_path / "bad.yaml").write_text(text, "utf-8")
    for verb in ("validate", "plan", "simulate", "run", "bench"):
        status, _, err = run(capsys, verb, "bad.yaml")
        assert status == 2
        assert re.match(r"tlcomm: error: bad\.yaml:\d+: .*cell_m.*-0\.5", err), err
    assert not (tmp_path / "runs").exists()


def test_a_task_without_a_plan_is_one_line(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """A task that contradicts itself is bad input: exit status 2."""
    text = Path(SCENARIO).read_text("utf-8")
    task = "G F ((west_shelf & pick) & F (west_bench & place))"
    (tmp_path / "bad.yaml").write_text(text.replace(task, "G F (pick & !pick)"), "utf-8")
    status, _, err = run(capsys, "plan", "bad.yaml")
    assert status == 2
    assert re.fullmatch(
        r"tlcomm: error: bad.yaml: agents.west.task: .* contradicts itself.*\n", err
    )


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
        status, _, err = run(capsys, "simulate", SCENARIO, "--out", out)
        assert status == 2
        assert complaint in err
    status, _, err = run(capsys, "round", SCENARIO, "--round", "1", "--out", "none/r.json")
    assert status == 2
    assert "can't write 'none/r.json': No such file or directory" in err


def test_validate(capsys: pytest.CaptureFixture[str]) -> None:
    """A good scenario is told to be ok, by text and by JSON."""
    status, out, _ = run(capsys, "validate", SCENARIO)
    assert (status, out.splitlines()[0]) == (0, f"{SCENARIO}: ok")
    status, out, _ = run(capsys, "validate", SCENARIO, "--json")
    assert (status, json.loads(out)["agents"]) == (0, ["west", "carrier", "east"])


def test_plan(capsys: pytest.CaptureFixture[str]) -> None:
    """Plans have steps, costs and times; a suffix satisfies; one agent can be asked for."""
    status, out, _ = run(capsys, "plan", SCENARIO, "--json")
    assert status == 0
    plans = json.loads(out)["agents"]
    assert list(plans) == ["west", "carrier", "east"]
    assert all(any(step["satisfies"] for step in own["suffix"]) for own in plans.values())
    assert all(own["suffix_s"] > 0.0 for own in plans.values())
    assert all(own["suffix_m"] > 0.0 for own in plans.values())
    assert all(len(own["word"]["loop"]) == len(own["suffix"]) for own in plans.values())
    assert run(capsys, "plan", SCENARIO, "--gamma", "1/3")[0] == 0
    status, out, _ = run(capsys, "plan", SCENARIO, "--agent", "east")
    assert status == 0
    assert out.startswith("east: G F ((east_bench & inspect)")
    assert "west: " not in out
    assert max(map(len, out.splitlines())) <= 80


def test_ltl(capsys: pytest.CaptureFixture[str]) -> None:
    """A formula's automaton comes in HOA, as a drawing, as text and as JSON."""
    assert run(capsys, "ltl", "G F a", "--hoa")[1].startswith("HOA: v1")
    assert run(capsys, "ltl", "G F a", "--dot")[1].startswith("digraph")
    assert "restarted good-prefix automaton" in run(capsys, "ltl", "G F a")[1]
    document = json.loads(run(capsys, "ltl", "F G a", "--json")[1])
    assert document["construction"] == "tableau"
    assert document["hoa"].startswith("HOA: v1")


def test_round(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """The round document is on standard output and in the file, and is what a run decides."""
    status, out, _ = run(capsys, "round", SCENARIO, "--round", "2", "--out", "r.json", "--json")
    assert status == 0
    document = json.loads(out)
    assert json.loads((tmp_path / "r.json").read_text("utf-8")) == document
    assert (document["format"], document["round"]) == ("tlcomm-round/1", 2)
    _, out, _ = run(capsys, "simulate", SCENARIO, "--rounds", "2", "--json")
    decided = json.loads(out)["rounds"][1]
    assert document["nash"]["potential"] == pytest.approx(decided["potential"], abs=1e-6)
    arrivals_s = [
        own["arrival"][candidate][location]
        for own, candidate, location in zip(
            document["candidates"],
            document["nash"]["candidate"],
            document["nash"]["location"],
            strict=True,
        )
    ]
    starts_s = max(*arrivals_s, document["window"][0])
    assert starts_s == pytest.approx(decided["planned_t_c"], abs=1e-6)
    assert document["initial"]["potential"] == pytest.approx(decided["initial_potential"], abs=1e-6)
    status, out, _ = run(capsys, "round", SCENARIO, "--round", "1")
    assert status == 0
    assert max(map(len, out.splitlines())) <= 80


def test_simulate_writes_its_files(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Scenario, event log and results are in the folder; --json is result.json and the folder."""
    status, out, _ = run(capsys, "simulate", SCENARIO, "--rounds", "2", "--out", "mine", "--json")
    assert status == 0
    result = json.loads(out)
    assert result.pop("folder") == "mine"
    assert result == json.loads((tmp_path / "mine" / "result.json").read_text("utf-8"))
    assert (result["verdict"], len(result["rounds"])) == ("ok", 2)
    events = (tmp_path / "mine" / "events.jsonl").read_text("utf-8").splitlines()
    assert json.loads(events[0])["stamp_ns"] == 0
    assert run(capsys, "validate", "mine/scenario.yaml")[0] == 0


def test_an_automaton_stands_for_a_task(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Made by another tool, it is planned and carried out, and goes into the run's scenario."""
    task = "G F ((west_shelf & pick) & F (west_bench & place))"
    (tmp_path / "west.hoa").write_text(run(capsys, "ltl", task, "--hoa")[1], "utf-8")
    text = Path(SCENARIO).read_text("utf-8")
    (tmp_path / "hoa.yaml").write_text(text.replace(f'task: "{task}"', "automaton: west.hoa"))
    assert run(capsys, "validate", "hoa.yaml")[0] == 0
    status, out, _ = run(capsys, "plan", "hoa.yaml", "--agent", "west")
    assert (status, out.splitlines()[0]) == (0, "west: the given automaton")
    results = []
    for name in (SCENARIO, "hoa.yaml"):
        folder = Path(name).stem
        status, out, _ = run(capsys, "simulate", name, "--rounds", "2", "--out", folder, "--json")
        results.append((status, json.loads(out)["agents"]))
    assert results[0] == results[1]
    (tmp_path / "west.hoa").unlink()
    assert run(capsys, "validate", "hoa/scenario.yaml")[0] == 0


def test_simulate_ends_when_told(capsys: pytest.CaptureFixture[str]) -> None:
    """--until is the simulated time at the end, to the nanosecond."""
    _, out, _ = run(capsys, "simulate", SCENARIO, "--until", "12.5", "--json")
    assert json.loads(out)["sim_s"] == 12.5


def test_simulate_makes_folders_of_its_own(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Without --out each run has a new folder below runs/, two within a second too."""
    for _ in range(2):
        status, out, _ = run(capsys, "simulate", SCENARIO, "--until", "5")
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
        run(capsys, "simulate", SCENARIO, "--rounds", "2", "--seed", "4", "--out", out)
    logs = [(tmp_path / out / "events.jsonl").read_bytes() for out in ("a", "b")]
    assert logs[0] == logs[1]


def test_a_failed_property_is_status_1(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    """A simulation whose verdict isn't ok ends with status 1, its files written."""
    monkeypatch.setattr(
        "tlcomm_tools.verbs.simulate.result_document",
        lambda *_: {
            **json.loads(json.dumps(RESULT)),
            "verdict": ["window 1 missed: connected for 0.000 s at most, not 3 s"],
        },
    )
    status, out, _ = run(capsys, "simulate", SCENARIO, "--until", "5", "--out", "mine")
    assert status == 1
    assert "verdict: FAILED\n  - window 1 missed" in out
    assert (tmp_path / "mine" / "result.json").is_file()


RESULT = {
    "scenario": "line",
    "method": "team",
    "solver": "best-response",
    "seed": 0,
    "pace": "lockstep",
    "sim_s": 5.0,
    "wall_s": None,
    "realtime_factor": None,
    "rounds": [],
    "communication": {"windows": 2, "satisfied": 1, "missed": 1},
    "agents": {
        "one": {"tasks_satisfied": 0, "makespan_s": None, "distance_m": 0.0, "messages_sent": None}
    },
}


def test_check_a_good_bag(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """A good bag passes, by text and by JSON, with the scenario that is inside."""
    write_bag(tmp_path / "bag", hand_made_records())
    status, out, _ = run(capsys, "check", "bag")
    assert (status, out.splitlines()[-1]) == (0, "verdict: ok")
    assert max(map(len, out.splitlines())) <= 80
    status, out, _ = run(capsys, "check", ".", "--json")
    assert (status, json.loads(out)["verdict"]) == (0, "ok")


def test_check_a_bad_bag(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """A violation is listed, and the exit status is 1."""
    records = hand_made_records()
    records.tasks = [
        own for own in records.tasks if own.event.kind is not TaskEventKind.TASK_SATISFIED
    ]
    write_bag(tmp_path / "bag", records)
    status, out, _ = run(capsys, "check", "bag")
    assert status == 1
    assert "verdict: FAILED\n  - east: task claimed satisfied 0 times" in out
    status, out, _ = run(capsys, "check", "bag", "--json")
    assert (status, len(json.loads(out)["verdict"])) == (1, 2)


def test_check_tells_a_violated_task(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Agent and time are in the table, in the verdict and in JSON; the status is 1."""
    write_bag(tmp_path / "bag", hand_made_records())
    text = dumps(hand_made_scenario())
    (tmp_path / "strict.yaml").write_text(text.replace("G F (left & pick)", "G !(left & pick)"))
    status, out, _ = run(capsys, "check", "bag", "--scenario", "strict.yaml")
    assert status == 1
    assert re.search(r"\n  west .* violated at 5\.000 s\n", out)
    assert re.search(r"\n  east .* kept\n", out)
    assert "\n  - west: task violated at 5.000 s; what was true then: {left, pick}\n" in out
    assert max(map(len, out.splitlines())) <= 80
    status, out, _ = run(capsys, "check", "bag", "--scenario", "strict.yaml", "--json")
    found = json.loads(out)["tasks"]["west"]
    assert (status, found["verdict"], found["settled_s"]) == (1, "violated", 5.0)


def test_check_finds_the_scenario(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """A bag that says nothing of its scenario is audited by the one beside it, or the one given."""
    write_bag(tmp_path / "bag", hand_made_records(), with_scenario=False)
    status, _, err = run(capsys, "check", "bag")
    assert status == 2
    assert "'bag' says nothing of its scenario: give it with --scenario FILE" in err
    (tmp_path / "line.yaml").write_text(dumps(hand_made_scenario()), "utf-8")
    assert run(capsys, "check", "bag", "--scenario", "line.yaml")[0] == 0
    (tmp_path / "line.yaml").rename(tmp_path / "scenario.yaml")
    assert run(capsys, "check", "bag")[0] == 0


def test_bench(capsys: pytest.CaptureFixture[str]) -> None:
    """The table has a row per scenario and fits 80 columns; JSON has the same figures."""
    status, out, _ = run(capsys, "bench", SCENARIO, "--repeats", "1", "--rounds", "1")
    assert status == 0
    assert "corridor" in out
    assert max(map(len, out.splitlines())) <= 80
    _, out, _ = run(capsys, "bench", SCENARIO, "--repeats", "1", "--rounds", "1", "--json")
    (measured,) = json.loads(out)["scenarios"]
    assert all(measured[key] > 0.0 for key in ("plan_s", "solve_s", "own_solve_s", "simulate_s"))


def test_interruption_is_status_130(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    """Ctrl-C ends with status 130 and no traceback."""

    def interrupt(*_: object, **__: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr("tlcomm_tools.verbs.simulate.simulate", interrupt)
    status, _, err = run(capsys, "simulate", SCENARIO)
    assert (status, err) == (130, "tlcomm: error: interrupted\n")


@pytest.mark.parametrize(
    ("number", "status"), [(28, 3), (30, 2), (13, 2)], ids=["full", "read-only", "forbidden"]
)
def test_what_the_disk_refuses(
    number: int,
    status: int,
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """A full disk breaks the run; a place that can't be written is bad input; one line each."""

    def refuse(*_: object) -> None:
        raise OSError(number, os.strerror(number), "runs/x")

    monkeypatch.setattr("tlcomm_tools.folder.RunFolder.write_results", refuse)
    found, _, err = run(capsys, "simulate", SCENARIO, "--until", "1")
    assert found == status
    assert err == f"tlcomm: error: 'runs/x': {os.strerror(number)}\n"


def test_a_closed_pipe_is_silent(tmp_path: Path) -> None:
    """A reader that goes away, ``head`` for instance, causes no complaint."""
    command = [sys.executable, "-m", "tlcomm_tools", "plan", SCENARIO, "--json"]
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)}
    with subprocess.Popen(
        command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, env=environment, cwd=tmp_path
    ) as process:
        assert process.stdout is not None
        assert process.stderr is not None
        process.stdout.close()
        errors = process.stderr.read()
    assert (process.returncode, errors) == (0, b"")


def test_help_imports_little() -> None:
    """The overview needs neither numpy nor any verb: the command starts at once."""
    code = (
        "import sys; from tlcomm_tools.cli import main; main(['--help']); "
        "print(sorted({'numpy', 'scipy', 'pydantic', 'rosbags', 'yaml'} & set(sys.modules)))"
    )
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)}
    output = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, check=True, env=environment, text=True
    ).stdout
    assert output.splitlines()[-1] == "[]"
