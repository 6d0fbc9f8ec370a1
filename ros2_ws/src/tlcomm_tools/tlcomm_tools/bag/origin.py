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
from tlcomm_core.records import RunRecords
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
        InputError: there is none, it is wrong, or agents or times in the bag can't be of a run of
            it.
    """
    scenario = _choose_scenario(path, recorded, given)
    _require_agents(path, recorded, scenario)
    _require_times(path, recorded, scenario)
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


def find_pace(path: Path, recorded: RecordedRun, given: Pace | None = None) -> Pace | None:
    """Return how simulated time went on, as given or as the bag says; ``None`` if neither does.

    Raises:
        InputError: the bag names a pace that is none.
    """
    if given is not None:
        return given
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


def _require_agents(path: Path, recorded: RecordedRun, scenario: Scenario) -> None:
    """Refuse another team's bag: its links are between agents by their places in the team."""
    if recorded.records.connectivity and recorded.agents != tuple(scenario.agents):
        raise InputError(
            f"{str(path)!r} is of the agents {list(recorded.agents)!r}, "
            f"the scenario {scenario.name!r} of {list(scenario.agents)!r}"
        )


def _require_times(path: Path, recorded: RecordedRun, scenario: Scenario) -> None:
    """Refuse stamps of another clock: the audit would go through years of windows."""
    begin_s, end_s = seconds(_begin_ns(recorded.records)), seconds(recorded.end_ns)
    most_s = _MOST_WINDOWS * scenario.communication.period_s
    for stamp_s in (begin_s, end_s):
        if not 0.0 <= stamp_s <= most_s:
            raise InputError(
                f"{str(path)!r} has a message stamped {stamp_s:.3f} s, expected simulated time: "
                f"from 0 on, and {_MOST_WINDOWS} windows at most, {most_s:g} s"
            )


def _begin_ns(records: RunRecords) -> int:
    """Return the least stamp."""
    kinds = (records.odometry, records.connectivity, records.tasks, records.strategies)
    firsts = [own[0].stamp_ns for own in kinds if own]
    return min(firsts, default=0)
