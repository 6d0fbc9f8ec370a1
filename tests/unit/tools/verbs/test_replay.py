"""Tests of ``tlcomm replay`` without ROS: what it refuses."""

from pathlib import Path

import pytest

from support.command import refusal
from support.hand_made_run import hand_made_records, write_bag


@pytest.mark.parametrize(
    ("arguments", "complaint"),
    [
        (("--rate", "0"), "argument --rate: expected"),
        (("--rate", "nan"), "argument --rate: expected"),
        (("--start", "-1"), "argument --start: expected"),
        (("--start", "1e6"), "--start: 1e+06 s is after the end"),
        (("--topics", "a,,b"), "argument --topics: expected names of topics, A,B, not 'a,,b'"),
        (("--topics", "odd"), "has no topic '/odd'"),
        (
            ("--verify", "--rate", "3"),
            "argument --rate: not with --verify, which publishes nothing",
        ),
        (("--verify", "--loop"), "argument --loop: not with --verify"),
    ],
)
def test_bad_options(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], arguments: tuple[str, ...], complaint: str
) -> None:
    """Each is one line with the value and what was expected."""
    write_bag(tmp_path / "bag", hand_made_records())
    assert complaint in refusal(capsys, "replay", str(tmp_path / "bag"), *arguments)


def test_other_files(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """A file of another kind is named."""
    (tmp_path / "a.mcap").write_text("not this")
    assert "is no MCAP file" in refusal(capsys, "replay", str(tmp_path / "a.mcap"))
