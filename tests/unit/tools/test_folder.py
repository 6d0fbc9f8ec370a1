"""A run's folder."""

from pathlib import Path

import pytest

from support.hand_made_run import hand_made_records
from tlcomm_tools.folder import RunFolder


@pytest.mark.parametrize("name", ["events.jsonl", "result.json"])
def test_a_full_disk_is_told_with_the_file(tmp_path: Path, name: str) -> None:
    """The error of a write that fails names the file, and what was there before stays."""
    folder = RunFolder(tmp_path)
    (tmp_path / name).write_text("before", "utf-8")
    (tmp_path / f".{name}.tmp").symlink_to("/dev/full")
    with pytest.raises(OSError, match="No space left") as caught:
        folder.write_results({"verdict": "ok"}, hand_made_records())
    assert caught.value.filename == str(tmp_path / name)
    assert (tmp_path / name).read_text("utf-8") == "before"
    assert not (tmp_path / f".{name}.tmp").is_symlink()
