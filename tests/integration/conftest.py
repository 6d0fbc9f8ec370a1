"""What integration tests share."""

import subprocess
from pathlib import Path

import pytest

from support.command import CORRIDOR, command


@pytest.fixture(scope="session")
def finished(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, str]:
    """Return a finished run's folder and what it printed."""
    folder = tmp_path_factory.mktemp("finished") / "run"
    arguments = ("run", CORRIDOR, "--rounds", "3", "--out", str(folder), "--json")
    done = subprocess.run(command(*arguments), capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return folder, done.stdout
