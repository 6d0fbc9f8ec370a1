"""The command, run in this process.

``CORRIDOR``  a small scenario's file
``run``       one command
"""

from pathlib import Path
from typing import Final

import pytest

from tlcomm_tools.cli import main

__all__ = ["CORRIDOR", "run"]

CORRIDOR: Final = str(Path(__file__).parents[2] / "scenarios" / "corridor.yaml")


def run(capsys: pytest.CaptureFixture[str], *arguments: str) -> tuple[int, str, str]:
    """Run the command; return its status, output and errors."""
    status = main(arguments)
    captured = capsys.readouterr()
    return status, captured.out, captured.err
