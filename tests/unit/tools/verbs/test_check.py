"""The verb ``check``."""

import json
import re
from dataclasses import replace
from pathlib import Path

import pytest

from support.command import refusal, run
from support.hand_made_run import hand_made_records, hand_made_scenario, write_bag
from tlcomm_core.agent.actions import TaskEventKind
from tlcomm_core.scenario.loader import dumps


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


def test_check_finds_the_scenario(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """A bag that says nothing of its scenario is audited by the one beside it, or the one given."""
    write_bag(tmp_path / "bag", hand_made_records(), with_scenario=False)
    complaint = "'bag' says nothing of its scenario: give it with --scenario FILE"
    assert complaint in refusal(capsys, "check", "bag")
    (tmp_path / "line.yaml").write_text(dumps(hand_made_scenario()), "utf-8")
    assert run(capsys, "check", "bag", "--scenario", "line.yaml")[0] == 0
    (tmp_path / "line.yaml").rename(tmp_path / "scenario.yaml")
    assert run(capsys, "check", "bag")[0] == 0


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


def test_check_goes_by_the_bags_method(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """It names it, and asks for what that promises; a bag without a method is of a whole team."""
    for method in (None, "static", "all-time"):
        write_bag(tmp_path / f"bag-{method}", hand_made_records(), method=method)
    status, out, _ = run(capsys, "check", "bag-None")
    assert (status, out.splitlines()[0]) == (0, "line, method team: audit of 25.0 s")
    assert "\n  windows kept       3 of 3, by the poses\n" in out
    status, out, _ = run(capsys, "check", "bag-static")
    assert (status, out.splitlines()[0]) == (0, "line, method static: audit of 25.0 s")
    assert "\n  places kept        3 of 3 strategies\n" in out
    status, out, _ = run(capsys, "check", "bag-all-time")
    assert status == 1
    assert "\n  connected          14.5 of 25.0 s, by the poses\n" in out
    assert "\n  - not connected from 2.250 s to " in out
    status, out, _ = run(capsys, "check", "bag-all-time", "--json")
    document = json.loads(out)
    assert (status, document["method"]) == (1, "all-time")
    assert [own["kept"] for own in document["guarantees"]] == [False, False]


def test_check_is_told_the_method(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Of a bag that doesn't say, or says another; as report is."""
    write_bag(tmp_path / "bag", hand_made_records())
    status, out, _ = run(capsys, "check", "bag", "--method", "static")
    assert (status, out.splitlines()[0]) == (0, "line, method static: audit of 25.0 s")
    assert "argument --method: invalid choice: 'x'" in refusal(
        capsys, "check", "bag", "--method", "x"
    )
    arguments = ("report", "bag", "--method", "all-time", "-o", "line.html", "--json")
    status, out, _ = run(capsys, *arguments)
    assert status == 0
    assert json.loads(out)["verdict"][0].startswith("not connected from 2.250 s to ")


def test_check_wants_simulated_times(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """A message stamped by the wall clock would be of a run of years: it is refused at once."""
    records = hand_made_records()
    records.odometry[-1] = replace(records.odometry[-1], stamp_ns=1_800_000_000_000_000_000)
    write_bag(tmp_path / "bag", records)
    assert refusal(capsys, "check", "bag") == (
        "tlcomm: error: 'bag' has a message stamped 1800000000.000 s, expected simulated time: "
        "from 0 on, and 100000 windows at most, 1e+06 s\n"
    )


def test_check_knows_no_other_method(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """A bag of a method of somebody else's is refused in one line."""
    write_bag(tmp_path / "bag", hand_made_records(), method="telepathy")
    assert refusal(capsys, "check", "bag") == (
        "tlcomm: error: 'bag': method: 'telepathy' isn't one of "
        "team, static, pairwise, all-time, none, oracle\n"
    )
