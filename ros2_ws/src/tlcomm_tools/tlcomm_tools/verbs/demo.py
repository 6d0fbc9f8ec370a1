"""The main job: the plant scenario with one ROS 2 process per agent, recorded and summarized."""

from argparse import ArgumentParser, Namespace
from pathlib import Path
from typing import Final

from tlcomm_core.errors import InputError
from tlcomm_core.scenario.loader import load_scenario
from tlcomm_tools.status import Status
from tlcomm_tools.verbs.options import (
    add_compression_argument,
    add_mission_arguments,
    add_pace_argument,
    add_view_argument,
)
from tlcomm_tools.verbs.run import run_scenario

__all__ = ["EXAMPLE", "add_arguments", "run"]

EXAMPLE: Final = "tlcomm demo"

_SCENARIO: Final = Path("scenarios") / "plant.yaml"


def add_arguments(parser: ArgumentParser) -> None:
    """Add the verb's arguments."""
    add_mission_arguments(parser)
    add_pace_argument(parser)
    add_compression_argument(parser)
    add_view_argument(parser)


def run(options: Namespace) -> Status:
    """Run the plant scenario and show the results."""
    return run_scenario(load_scenario(_find_scenario()), options)


def _find_scenario() -> Path:
    """Return the scenario's file, above this module or below the current folder."""
    for folder in (*Path(__file__).resolve().parents, Path.cwd()):
        if (folder / _SCENARIO).is_file():
            return folder / _SCENARIO
    raise InputError(f"{str(_SCENARIO)!r} is neither beside the sources nor in this folder")
