"""Tests of ``tlcomm repair``."""

import json
from pathlib import Path

import pytest

from support.command import refusal, run
from support.hand_made_run import hand_made_records, write_bag


def test_a_cut_bag(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """It says what was wrong, how much was saved and up to when; check passes as before."""
    path = write_bag(tmp_path / "bag", hand_made_records()).path
    path.write_bytes(path.read_bytes()[:-1])
    status, out, err = run(capsys, "repair", str(tmp_path / "bag"))
    assert (status, err) == (0, "")
    assert "bag: the file has no summary\n" in out
    assert "bag_repaired: " in out
    assert out.endswith(" messages, up to 25.000 s\n")
    assert run(capsys, "check", str(tmp_path / "bag_repaired"))[0] == 0
    refused = refusal(capsys, "repair", str(tmp_path / "bag"))
    assert "bag_repaired' exists already" in refused


def test_a_whole_bag(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """It is left alone, and told to be whole."""
    write_bag(tmp_path / "bag", hand_made_records())
    status, out, _ = run(capsys, "repair", str(tmp_path / "bag"))
    assert status == 0
    assert "bag is whole: " in out
    assert "up to 25.000 s; nothing to do" in out
    document = json.loads(run(capsys, "repair", str(tmp_path / "bag"), "--json")[1])
    assert (document["flaw"], document["folder"], document["end_s"]) == (None, None, 25.0)
    assert [own.name for own in tmp_path.iterdir()] == ["bag"]


def test_a_bag_without_metadata(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """It goes where it is told to."""
    write_bag(tmp_path / "bag", hand_made_records())
    (tmp_path / "bag" / "metadata.yaml").unlink()
    arguments = ("repair", str(tmp_path / "bag"), "-o", str(tmp_path / "new"), "--json")
    document = json.loads(run(capsys, *arguments)[1])
    assert document["flaw"] == "metadata.yaml is missing or doesn't fit the file"
    assert (tmp_path / "new" / "metadata.yaml").is_file()


def test_other_files(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """What is no bag, or several files, is refused in one line."""
    (tmp_path / "a.mcap").write_text("not this")
    assert "is no MCAP file" in refusal(capsys, "repair", str(tmp_path / "a.mcap"))
    (tmp_path / "b.mcap").write_text("nor this")
    assert "holds 2 files: repair them one by one" in refusal(capsys, "repair", str(tmp_path))
