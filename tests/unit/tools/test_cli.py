"""Tests of ``tlcomm_tools.cli``: help, exit statuses and one-line errors."""

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

from support.command import CORRIDOR, refusal, run
from tlcomm_tools.cli import VERBS


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
    (["explain", "x"], "unknown verb 'explain' (the verbs are demo, run,"),
    (["dance"], "unknown verb 'dance'"),
    (["--version"], "unknown verb '--version'"),
    (["validate"], "the following arguments are required: SCENARIO"),
    (["validate", "missing.yaml"], "missing.yaml"),
    (["validate", "."], "."),
    (["validate", CORRIDOR, "--fast"], "unrecognized arguments: --fast"),
    (["validate", CORRIDOR, "more"], "unrecognized arguments: more"),
    (["plan", CORRIDOR, "--agent", "nobody"], "no agent 'nobody' (the agents are west, carrier"),
    (["ltl", "G F (a &"], "column 9: expected an operand after '&'"),
    (["ltl", "a", "--hoa", "--dot"], "not allowed with argument"),
    (["ltl"], "required: FORMULA"),
    (["round", CORRIDOR], "required: --round"),
    (["run", "missing.yaml"], "missing.yaml"),
    (["check"], "required: RUN_OR_BAG"),
    (["check", "missing"], "'missing' doesn't exist"),
    (["check", "."], "holds no bag"),
]


@pytest.mark.parametrize(("arguments", "complaint"), BAD_USAGE)
def test_bad_usage_is_one_line(
    arguments: list[str], complaint: str, capsys: pytest.CaptureFixture[str]
) -> None:
    """Bad usage or input gives exit status 2 and one line that says what, and nothing else."""
    assert complaint in refusal(capsys, *arguments)


def test_a_scenarios_error_names_file_and_line(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """A bad scenario is told with its file, its line and the value."""
    text = Path(CORRIDOR).read_text("utf-8").replace("cell_m: 0.5", "cell_m: -0.5")
    (tmp_path / "bad.yaml").write_text(text, "utf-8")
    for verb in ("validate", "plan", "simulate", "run", "bench"):
        status, _, err = run(capsys, verb, "bad.yaml")
        assert status == 2
        assert re.match(r"tlcomm: error: bad\.yaml:\d+: .*cell_m.*-0\.5", err), err
    assert not (tmp_path / "runs").exists()


def test_interruption_is_status_130(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    """Ctrl-C ends with status 130 and no traceback."""

    def interrupt(*_: object, **__: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr("tlcomm_tools.timed_simulation.simulate", interrupt)
    status, _, err = run(capsys, "simulate", CORRIDOR)
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
    found, _, err = run(capsys, "simulate", CORRIDOR, "--until", "1")
    assert found == status
    assert err == f"tlcomm: error: 'runs/x': {os.strerror(number)}\n"


def test_a_closed_pipe_is_silent(tmp_path: Path) -> None:
    """A reader that goes away, ``head`` for instance, causes no complaint."""
    command = [sys.executable, "-m", "tlcomm_tools", "plan", CORRIDOR, "--json"]
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)}
    with subprocess.Popen(
        command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, env=environment, cwd=tmp_path
    ) as process:
        assert process.stdout is not None
        assert process.stderr is not None
        process.stdout.close()
        errors = process.stderr.read()
    assert (process.returncode, errors) == (0, b"")


def test_a_full_disk_behind_standard_output_is_told(tmp_path: Path) -> None:
    """What can't be printed breaks the run, in one line that says so."""
    command = [sys.executable, "-m", "tlcomm_tools", "validate", CORRIDOR]
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)}
    with Path("/dev/full").open("wb") as full:
        done = subprocess.run(
            command,
            stdout=full,
            stderr=subprocess.PIPE,
            env=environment,
            cwd=tmp_path,
            text=True,
            check=False,
        )
    assert done.returncode == 3
    assert done.stderr == "tlcomm: error: standard output: No space left on device\n"


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
