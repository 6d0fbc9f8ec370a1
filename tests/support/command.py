"""The command, run in this process or another.

``CORRIDOR``  a small scenario's file
``run``       one command, here
``refusal``   what a command that can't be carried out says
``command``   the command line for another process
"""

import re
import sys
from pathlib import Path
from typing import Final

import pytest

from tlcomm_tools.cli import main

__all__ = ["CORRIDOR", "command", "refusal", "run"]

CORRIDOR: Final = str(Path(__file__).parents[2] / "scenarios" / "corridor.yaml")


def run(capsys: pytest.CaptureFixture[str], *arguments: str) -> tuple[int, str, str]:
    """Run the command; return its status, output and errors."""
    status = main(arguments)
    captured = capsys.readouterr()
    return status, captured.out, captured.err


def refusal(capsys: pytest.CaptureFixture[str], *arguments: str) -> str:
    """Run a command of bad usage or input; return its complaint, the only line that it prints."""
    status, out, err = run(capsys, *arguments)
    assert (status, out) == (2, "")
    assert re.fullmatch(r"tlcomm: error: .*\n", err)
    return err


def command(*arguments: str) -> list[str]:
    """Return the command line of a verb."""
    return [sys.executable, "-m", "tlcomm_tools", *arguments]
