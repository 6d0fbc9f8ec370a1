"""The verb ``report``."""

import json
import math
from dataclasses import replace
from pathlib import Path

import pytest

from support.command import refusal, run
from support.gate import gate
from support.hand_made_run import hand_made_records, write_bag
from support.recorded_bag import write_recording
from support.recorded_simulation import record
from tlcomm_core.agent.actions import TaskEventKind
from tlcomm_core.mission import Mission
from tlcomm_core.protocol.messages import BestResponse
from tlcomm_core.scenario.site import Site


def test_report_writes_a_page(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """From a bag's folder or a run's, over an older page, with the verdict of the audit."""
    write_bag(tmp_path / "bag", hand_made_records())
    (tmp_path / "line.html").write_text("old")
    status, out, _ = run(capsys, "report", "bag", "-o", "line.html")
    assert (status, out.splitlines()[-1]) == (0, "verdict: ok")
    assert (tmp_path / "line.html").read_text("utf-8").startswith("<!DOCTYPE html>")
    status, out, _ = run(capsys, "report", ".", "-o", "line.html", "--json")
    assert (status, json.loads(out)["verdict"]) == (0, "ok")


def test_report_of_a_failed_run(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """The page is what was asked for, so the status is 0; the verdict is told."""
    records = hand_made_records()
    records.tasks = [
        own for own in records.tasks if own.event.kind is not TaskEventKind.TASK_SATISFIED
    ]
    write_bag(tmp_path / "bag", records)
    status, out, _ = run(capsys, "report", "bag", "-o", "line.html")
    assert (status, out.splitlines()[-1]) == (0, "verdict: FAILED")


def test_report_refuses(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """What can't be read, and where nothing can be written, in one line each."""
    assert "'nowhere' doesn't exist" in refusal(capsys, "report", "nowhere", "-o", "a.html")
    (tmp_path / "notes.txt").write_text("no bag")
    assert "'notes.txt'" in refusal(capsys, "report", "notes.txt", "-o", "a.html")
    write_bag(tmp_path / "bag", hand_made_records())
    complaint = "--out: 'bag' is a folder, expected a file's name"
    assert complaint in refusal(capsys, "report", "bag", "-o", "bag")
    assert "there is no folder 'far'" in refusal(capsys, "report", "bag", "-o", "far/a.html")
    assert "-o/--out" in refusal(capsys, "report", "bag")


def test_report_refuses_a_best_response_that_is_none(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """No agent would have heard it; the bag and the topic are named."""
    recording = record(Mission(Site.from_scenario(gate()), 0, None, 5.0))
    index, said = next(
        (index, own)
        for index, own in enumerate(recording.said)
        if isinstance(own.message, BestResponse)
    )
    bad = replace(said, message=replace(said.message, change_s=math.nan))
    recording.said[index] = bad
    write_recording(tmp_path / "bag", recording, measures=False)
    complaint = f"'bag': a message on '/{said.agent}/best_response' can't be used: change: "
    assert complaint in refusal(capsys, "report", "bag", "-o", "a.html")
