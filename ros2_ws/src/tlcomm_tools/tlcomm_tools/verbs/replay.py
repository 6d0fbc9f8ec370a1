"""Replay what a bag's agents decided: fresh brains are told the same, and must do the same."""

from argparse import ArgumentParser, Namespace
from pathlib import Path
from typing import Final

from tlcomm_tools.status import Status
from tlcomm_tools.verbs.verification import verify_run

__all__ = ["EXAMPLE", "add_arguments", "run"]

EXAMPLE: Final = "tlcomm replay --verify runs/plant-team-20260101-120000"


def add_arguments(parser: ArgumentParser) -> None:
    """Add the verb's arguments."""
    parser.add_argument(
        "run", type=Path, metavar="RUN_OR_BAG", help="a run's folder, a bag's folder or MCAP file"
    )
    parser.add_argument(
        "--verify",
        action="store_true",
        required=True,
        help="compare what fresh brains decide with what was recorded (of a run in lock step)",
    )


def run(options: Namespace) -> Status:
    """Verify the run's decisions."""
    return verify_run(options.run, as_json=options.json)
