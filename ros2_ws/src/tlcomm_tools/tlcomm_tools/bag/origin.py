"""What was run, as a bag says or as lies beside it.

``find_scenario``  the scenario
``find_method``    the method of coordination
``find_pace``      how simulated time went on
"""

from pathlib import Path
from typing import Final

from tlcomm_core.errors import InputError
from tlcomm_core.method import Method
from tlcomm_core.pace import Pace
from tlcomm_core.scenario.loader import load_scenario, loads
from tlcomm_core.scenario.model import Scenario
from tlcomm_core.units import seconds
from tlcomm_tools.bag.reader import RecordedRun, find_files

__all__ = ["find_method", "find_pace", "find_scenario"]

_MOST_WINDOWS: Final = 100_000


def find_scenario(path: Path, recorded: RecordedRun, given: Path | None) -> Scenario:
    """Return the scenario given, else the bag's own, else ``scenario.yaml`` beside the bag.

    Args:
        path: where the run was read from.
        recorded: the run.
        given: the user's choice.

    Raises:
        InputError: there is none, it is wrong, or the bag's times can't be those of a run of it.
    """
    scenario = _choose_scenario(path, recorded, given)
    end_s, period_s = seconds(recorded.end_ns), scenario.communication.period_s
    if end_s > _MOST_WINDOWS * period_s:
        raise InputError(
            f"{str(path)!r} has a message stamped {end_s:.3f} s, more than {_MOST_WINDOWS} windows "
            f"of {period_s:g} s after the start: expected simulated time from 0 on"
        )
    return scenario


def find_method(path: Path, recorded: RecordedRun, given: Method | None = None) -> Method:
    """Return the method given, else the one that the bag names, else that of a whole team.

    Raises:
        InputError: the bag names one that isn't known.
    """
    if given is not None:
        return given
    try:
        return recorded.method
    except InputError as error:
        raise InputError(f"{str(path)!r}: {error}") from None


def find_pace(path: Path, recorded: RecordedRun) -> Pace | None:
    """Return how simulated time went on; ``None`` if the bag doesn't say.

    Raises:
        InputError: the bag names a pace that is none.
    """
    try:
        return recorded.pace
    except InputError as error:
        raise InputError(f"{str(path)!r}: {error}") from None


def _choose_scenario(path: Path, recorded: RecordedRun, given: Path | None) -> Scenario:
    if given is not None:
        return load_scenario(given)
    if "scenario" in recorded.notes:
        return loads(recorded.notes["scenario"], "the bag's scenario")
    folder = find_files(path)[0].parent
    for file in (folder / "scenario.yaml", folder.parent / "scenario.yaml"):
        if file.is_file():
            return load_scenario(file)
    raise InputError(f"{str(path)!r} says nothing of its scenario: give it with --scenario FILE")
