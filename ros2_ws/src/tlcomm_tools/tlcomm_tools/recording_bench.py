"""What recording costs: runs in lock step in pairs, with a recorder and without.

``RecordingRow``      what it costs one scenario
``measure_recording`` a scenario's row
``format_recording``  a table of them

Both runs of a pair are of the same messages. What is measured begins when all processes have found
each other and ends when the sim is done: starting up is no part of it.
"""

import os
import resource
import statistics
import tempfile
import time
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Final

from tlcomm_core.errors import TlcommError
from tlcomm_core.game.solver import DEFAULT
from tlcomm_core.method import Method
from tlcomm_core.pace import LOCK_STEP
from tlcomm_core.scenario.model import Scenario
from tlcomm_tools.folder import RunFolder
from tlcomm_tools.run import RunOptions, launch
from tlcomm_tools.runtime.notify import Finished, Note, Progress, Ready
from tlcomm_tools.runtime.supervisor import RunFailed, RunInterrupted
from tlcomm_tools.table import format_number, format_table

__all__ = ["RecordingRow", "format_recording", "measure_recording"]

_SIM: Final = "sim"
_TICKS_PER_S: Final = os.sysconf("SC_CLK_TCK")
# Of /proc/PID/stat, behind the program's name in brackets.
_PARENT, _USER, _SYSTEM = 1, 11, 12


@dataclass(frozen=True, slots=True)
class RecordingRow:
    """What recording costs one scenario: medians over pairs of runs.

    Attributes:
        scenario: its name.
        agents: how many.
        sim_s: simulated time of a run.
        wall_s: of a recorded run.
        unrecorded_wall_s: of one that nobody records.
        wall_ratio: of each pair's wall times.
        cpu_s: computing time of all processes together, recorded.
        unrecorded_cpu_s: not recorded.
        cpu_ratio: of each pair's computing times.
        bag_bytes: of the bag's file.
    """

    scenario: str
    agents: int
    sim_s: float
    wall_s: float
    unrecorded_wall_s: float
    wall_ratio: float
    cpu_s: float
    unrecorded_cpu_s: float
    cpu_ratio: float
    bag_bytes: int


@dataclass(slots=True)
class _Watch:
    """Takes the times of one run from its processes' notes."""

    wall_s: float = 0.0
    cpu_s: float = 0.0
    sim_s: float = 0.0
    bag_bytes: int = 0

    def note(self, name: str, news: Note) -> None:
        """Take a note."""
        if name == _SIM and isinstance(news, Ready):
            self.wall_s, self.cpu_s = -time.monotonic(), -_children_cpu_s()
        elif name == _SIM and isinstance(news, Progress):
            self.sim_s = news.sim_s
        elif name == _SIM and isinstance(news, Finished):
            self.wall_s += time.monotonic()
            self.cpu_s += _children_cpu_s()


def measure_recording(scenario: Scenario, rounds: int, repeats: int) -> RecordingRow:
    """Return what recording costs a scenario.

    Args:
        scenario: the scenario.
        rounds: how far each run goes.
        repeats: how many pairs; in every other one the recorded run is the second.

    Raises:
        InputError: the processes are too many for this machine.
        TlcommError: a run broke.
        KeyboardInterrupt: the user has had enough.
    """
    options = RunOptions(scenario, Method.TEAM, DEFAULT, 0, LOCK_STEP, rounds, None, None)
    pairs = []
    for number in range(repeats):
        order = (True, False) if number % 2 == 0 else (False, True)
        by_kind = {is_recorded: _measure(options, is_recorded=is_recorded) for is_recorded in order}
        pairs.append((by_kind[True], by_kind[False]))
    median = statistics.median
    return RecordingRow(
        scenario=scenario.name,
        agents=len(scenario.agents),
        sim_s=pairs[0][0].sim_s,
        wall_s=median(own.wall_s for own, _ in pairs),
        unrecorded_wall_s=median(other.wall_s for _, other in pairs),
        wall_ratio=median(own.wall_s / other.wall_s for own, other in pairs),
        cpu_s=median(own.cpu_s for own, _ in pairs),
        unrecorded_cpu_s=median(other.cpu_s for _, other in pairs),
        cpu_ratio=median(own.cpu_s / other.cpu_s for own, other in pairs),
        bag_bytes=pairs[0][0].bag_bytes,
    )


def _measure(options: RunOptions, *, is_recorded: bool) -> _Watch:
    watch = _Watch()
    with tempfile.TemporaryDirectory() as name:
        folder = RunFolder.create(options.scenario.name, options.method, Path(name) / "run")
        outcome = launch(options, folder, watch.note, is_recorded=is_recorded)
        watch.bag_bytes = sum(file.stat().st_size for file in folder.bag.glob("*.mcap"))
    if isinstance(outcome, RunFailed):
        raise TlcommError(f"{outcome.name}: {outcome.reason}")
    if isinstance(outcome, RunInterrupted):
        raise KeyboardInterrupt
    return watch


def _children_cpu_s() -> float:
    """Return the computing time of all processes that this one has started."""
    own = str(os.getpid())
    ended = resource.getrusage(resource.RUSAGE_CHILDREN)
    ticks = 0
    for path in Path("/proc").glob("[0-9]*/stat"):
        try:
            fields = path.read_text("utf-8").rpartition(") ")[2].split()
        except (FileNotFoundError, ProcessLookupError):
            continue
        if fields[_PARENT] == own:
            ticks += int(fields[_USER]) + int(fields[_SYSTEM])
    return ended.ru_utime + ended.ru_stime + ticks / _TICKS_PER_S


def format_recording(rows: Sequence[RecordingRow], rounds: int, repeats: int) -> str:
    """Return a table."""
    header = ("scenario", "agents", "with/s", "without/s", "ratio", "CPU/s", "without/s", "ratio")
    cells = [
        (
            own.scenario,
            str(own.agents),
            format_number(own.wall_s, 2),
            format_number(own.unrecorded_wall_s, 2),
            format_number(own.wall_ratio, 2),
            format_number(own.cpu_s, 2),
            format_number(own.unrecorded_cpu_s, 2),
            format_number(own.cpu_ratio, 2),
        )
        for own in rows
    ]
    return (
        f"medians of {repeats} pairs of runs of {rounds} rounds in lock step\n\n"
        f"{format_table(header, cells)}\n\n"
        "  with     wall time with a recorder, without: without one\n"
        "  ratio    of each pair\n"
        "  CPU      computing time of all processes"
    )
