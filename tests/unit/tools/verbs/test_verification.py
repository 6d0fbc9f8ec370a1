"""Tests of ``tlcomm replay --verify``: decisions against a bag."""

import json
from dataclasses import replace
from pathlib import Path

import pytest

from support.gate import gate
from support.recorded_bag import write_recording
from support.recorded_simulation import record
from tlcomm_core.agent.actions import Drive
from tlcomm_core.mission import Mission
from tlcomm_core.scenario.site import Site
from tlcomm_tools.cli import main
from tlcomm_tools.status import Status
from tlcomm_tools.verification.recording import Recording


@pytest.fixture
def recording() -> Recording:
    """Return two agents' first meeting and what they do before the second."""
    return record(Mission(Site.from_scenario(gate()), 0, None, 20.0))


def test_equal_decisions_are_fine(
    recording: Recording, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Exit status 0, and how much was compared."""
    write_recording(tmp_path / "bag", recording, measures=False)
    assert main(["replay", "--verify", str(tmp_path)]) == Status.FINE
    shown = capsys.readouterr().out
    assert shown.startswith("gate, method team: decisions of 20.0 s")
    assert shown.endswith("verdict: ok\n")
    assert main(["replay", "--verify", "--json", str(tmp_path)]) == Status.FINE
    document = json.loads(capsys.readouterr().out)
    assert (document["verdict"], document["difference"]) == ("ok", None)
    assert document["agents"]["one"]["outputs"] > 0


def test_a_difference_fails(
    recording: Recording, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Exit status 1, and where the first is."""
    changed = replace(recording.commanded[3], drive=Drive(0.125, 0.0))
    recording.commanded[3] = changed
    write_recording(tmp_path / "bag", recording, measures=False)
    assert main(["replay", "--verify", str(tmp_path)]) == Status.PROPERTY_FAILED
    shown = capsys.readouterr().out
    assert "verdict: FAILED" in shown
    assert f"  - {changed.agent} at {changed.stamp_ns * 1e-9:.9f} s, cmd_vel" in shown
    assert "recorded 0.125, came out" in shown
    assert main(["replay", "--verify", "--json", str(tmp_path)]) == Status.PROPERTY_FAILED
    (flaw,) = json.loads(capsys.readouterr().out)["verdict"]
    assert flaw in shown


def test_what_cant_be_verified_is_refused(
    recording: Recording, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Exit status 2, and one line that names the bag and why."""
    recording.run.notes["pace"] = "1.0"
    write_recording(tmp_path / "bag", recording, measures=False)
    assert main(["replay", "--verify", str(tmp_path)]) == Status.BAD_INPUT
    shown = capsys.readouterr().err
    assert shown.startswith(f"tlcomm: error: {str(tmp_path)!r}: the run was at pace 1.0")
    assert shown.count("\n") == 1


def test_a_cut_bag_is_verified_as_far_as_it_goes(
    recording: Recording, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """With a note of why that isn't all."""
    write_recording(tmp_path / "bag", recording, measures=False)
    (path,) = (tmp_path / "bag").glob("*.mcap")
    data = path.read_bytes()
    end = data.index(b"\x0f\x04\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00")
    path.write_bytes(data[:end])
    assert main(["replay", "--verify", str(tmp_path)]) == Status.FINE
    shown = capsys.readouterr().out
    assert shown.endswith("note: the bag was read only in part: the file has no end\nverdict: ok\n")
