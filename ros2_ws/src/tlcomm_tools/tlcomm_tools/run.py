"""A run as processes: its folder, its processes, and its results from its bag.

``RunOptions``   what is run
``RunReport``    how it went
``run_mission``  runs it
``launch``       its processes alone, also without a recorder
"""

import contextlib
import os
import sys
import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, assert_never

from tlcomm_core.errors import InputError
from tlcomm_core.game.solver import Solver
from tlcomm_core.method import Method
from tlcomm_core.pace import Pace
from tlcomm_core.records import RunRecords
from tlcomm_core.result import RunFacts, result_document
from tlcomm_core.scenario.loader import dumps
from tlcomm_core.scenario.model import Scenario
from tlcomm_core.units import seconds
from tlcomm_tools.bag.compression import DEFAULT, Compression
from tlcomm_tools.bag.reader import RecordedRun, read_run
from tlcomm_tools.folder import RunFolder
from tlcomm_tools.limit import time_limit_s
from tlcomm_tools.runtime.domain import claim_domain, process_environment
from tlcomm_tools.runtime.notify import Note, Progress, Ready
from tlcomm_tools.runtime.onlooker import Onlooker
from tlcomm_tools.runtime.supervisor import (
    ProcessSpec,
    RunFailed,
    RunFinished,
    RunInterrupted,
    RunOutcome,
    run_processes,
)
from tlcomm_tools.status import Status

__all__ = ["RunOptions", "RunReport", "launch", "run_mission"]

_PROCESS = ("-P", "-m", "tlcomm_tools.runtime.process")
_VIEW = ("-P", "-m", "tlcomm_tools.runtime.view")


@dataclass(frozen=True, slots=True)
class RunOptions:
    """What is run.

    Attributes:
        scenario: the scenario.
        method: of coordination.
        solver: of the rounds.
        seed: of all that is random.
        pace: lock step or a factor.
        rounds: the run ends D_c after the meeting of this round, or ``None``.
        until_s: the run ends at this simulated time, or ``None``.
        out: folder to write to, or ``None`` for a new one.
        has_view: whether a browser can look on.
        compression: of the bag.
    """

    scenario: Scenario
    method: Method
    solver: Solver
    seed: int
    pace: Pace
    rounds: int | None
    until_s: float | None
    out: Path | None
    has_view: bool = False
    compression: Compression = DEFAULT


@dataclass(frozen=True, slots=True)
class RunReport:
    """How a run went.

    Attributes:
        result: the result document.
        folder: all that the run left behind.
        status: for the command's exit.
        failure: who broke the run, why, and the end of its log; or ``None``.
    """

    result: dict[str, Any]
    folder: RunFolder
    status: Status
    failure: RunFailed | None


def run_mission(
    options: RunOptions,
    on_progress: Callable[[float, int], None],
    tell: Callable[[str], None] = lambda _: None,
) -> RunReport:
    """Run a scenario with a process per agent; write its results, whatever happens.

    Args:
        options: what to run.
        on_progress: called with the simulated time (s) and the number of meetings that have ended.
        tell: is told what a user should know meanwhile, a line at a time, by another thread too.

    Raises:
        InputError: the folder can't be used, or the processes are too many for this machine.
    """
    folder = RunFolder.create(options.scenario.name, options.method, options.out)
    folder.write_scenario(dumps(options.scenario))
    folder.logs.mkdir()
    specs = _specs(options, folder)
    count = len(specs) + options.has_view
    with claim_domain() as domain, contextlib.ExitStack() as stack:
        tell(f"ROS domain {domain}")
        environment = process_environment(os.environ, domain, folder.logs.absolute(), count)
        view = _view(options, folder, environment, tell) if options.has_view else None
        onlooker = None if view is None else stack.enter_context(view)
        return _run(options, folder, specs, environment, on_progress, onlooker)


def _run(
    options: RunOptions,
    folder: RunFolder,
    specs: Sequence[ProcessSpec],
    environment: Mapping[str, str],
    on_progress: Callable[[float, int], None],
    onlooker: Onlooker | None,
) -> RunReport:
    last = Progress(0.0, 0)
    unready = {spec.name for spec in specs}

    def note(name: str, news: Note) -> None:
        nonlocal last
        if isinstance(news, Progress):
            last = news
            on_progress(news.sim_s, news.meetings_ended)
        elif isinstance(news, Ready) and unready:
            unready.discard(name)
            if not unready and onlooker is not None:
                onlooker.begin()

    begun_s = time.monotonic()
    outcome = run_processes(specs, environment, note)
    report = _report(options, folder, outcome, time.monotonic() - begun_s, last)
    if onlooker is not None:
        onlooker.end(report.result["verdict"])
    return report


def _view(
    options: RunOptions,
    folder: RunFolder,
    environment: Mapping[str, str],
    tell: Callable[[str], None],
) -> Onlooker:
    command = (
        *(sys.executable, *_VIEW),
        *("--scenario", str(folder.scenario.absolute()), "--bag", str(folder.bag.absolute())),
        *("--method", options.method.value, "--seed", str(options.seed)),
        *("--solver", options.method.solver(options.solver).name),
    )
    return Onlooker(command, environment, folder.logs / "view.log", tell)


def launch(
    options: RunOptions,
    folder: RunFolder,
    on_note: Callable[[str, Note], None],
    *,
    is_recorded: bool,
) -> RunOutcome:
    """Run a scenario's processes to their end, with no results written.

    Args:
        options: what to run.
        folder: where scenario, logs and bag go.
        on_note: called with a process's name and each of its notes.
        is_recorded: whether there is a recorder; without one no bag is left.

    Raises:
        InputError: the processes are too many for this machine.
    """
    folder.write_scenario(dumps(options.scenario))
    folder.logs.mkdir()
    specs = _specs(options, folder, is_recorded=is_recorded)
    with claim_domain() as domain:
        environment = process_environment(os.environ, domain, folder.logs.absolute(), len(specs))
        return run_processes(specs, environment, on_note)


def _specs(
    options: RunOptions, folder: RunFolder, *, is_recorded: bool = True
) -> list[ProcessSpec]:
    """Return the recorder, the sim and the agents, in the order in which they start."""
    scenario = ("--scenario", str(folder.scenario.absolute()))
    world = (*scenario, "--seed", str(options.seed), "--pace", str(options.pace))
    common = (*world, "--recorder") if is_recorded else world
    solver, method = options.method.solver(options.solver).name, options.method.value
    coordination = ("--solver", solver, "--method", method)
    limit_s = time_limit_s(options.scenario, options.rounds, options.until_s, options.method)
    end: tuple[str, ...] = ("--until", repr(limit_s))
    if options.rounds is not None and options.method.meets_in_windows:
        end += ("--rounds", str(options.rounds))

    def spec(name: str, *arguments: str, stop_last: bool = False) -> ProcessSpec:
        command = (sys.executable, *_PROCESS, *arguments)
        return ProcessSpec(name, command, folder.logs / f"{name}.log", stop_last)

    bag = ("--bag", str(folder.bag.absolute()), "--compression", options.compression.value)
    recorder = spec("recorder", "recorder", *bag, *world, *coordination, stop_last=True)
    return [
        *([recorder] if is_recorded else []),
        spec("sim", "sim", *common, *end),
        *(
            spec(name, "agent", "--name", name, *coordination, *common)
            for name in options.scenario.agents
        ),
    ]


def _report(
    options: RunOptions, folder: RunFolder, outcome: RunOutcome, wall_s: float, last: Progress
) -> RunReport:
    recorded, failures = _read_bag(folder)
    failure = outcome if isinstance(outcome, RunFailed) else None
    facts = RunFacts(
        method=options.method,
        solver=options.method.solver(options.solver).name,
        seed=options.seed,
        pace="lockstep" if options.pace.factor is None else options.pace.factor,
        sim_s=_simulated_s(recorded, outcome, last),
        wall_s=wall_s,
        failures=(*_failures(outcome), *failures),
    )
    records = RunRecords() if recorded is None else recorded.records
    result = result_document(options.scenario, records, facts)
    folder.write_results(result, records)
    return RunReport(result, folder, _status(outcome, result), failure)


def _read_bag(folder: RunFolder) -> tuple[RecordedRun | None, Sequence[str]]:
    try:
        recorded = read_run(folder.bag)
    except InputError as error:
        return None, (f"nothing was recorded: {error}",)
    return recorded, (f"the bag is damaged: {recorded.damage}",) if recorded.damage else ()


def _simulated_s(recorded: RecordedRun | None, outcome: RunOutcome, last: Progress) -> float:
    """Return the time at the end; of a run that broke, the last time recorded."""
    recorded_s = 0.0 if recorded is None else seconds(recorded.end_ns)
    return max(recorded_s, last.sim_s) if isinstance(outcome, RunFinished) else recorded_s


def _failures(outcome: RunOutcome) -> tuple[str, ...]:
    match outcome:
        case RunFinished():
            return ()
        case RunInterrupted():
            return ("interrupted",)
        case RunFailed(name, reason):
            return (f"{name}: {reason}",)
        case _:
            assert_never(outcome)


def _status(outcome: RunOutcome, result: dict[str, Any]) -> Status:
    match outcome:
        case RunFinished():
            return Status.FINE if result["verdict"] == "ok" else Status.PROPERTY_FAILED
        case RunInterrupted():
            return Status.INTERRUPTED
        case RunFailed(status=status):
            return Status(status)
        case _:
            assert_never(outcome)
