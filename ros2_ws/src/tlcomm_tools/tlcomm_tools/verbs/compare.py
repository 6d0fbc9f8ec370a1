"""Compare methods: all of them in the same world, from the same starts, for the same time.

Runs are made in parallel, on all cores or on a Dask cluster, and kept in a folder each; the same
command with the same --out goes on where it was interrupted.
"""

from argparse import ArgumentParser, ArgumentTypeError, Namespace
from collections.abc import Iterator, Mapping, Sequence
from concurrent.futures import Executor
from contextlib import contextmanager
from pathlib import Path
from typing import Any, Final

from tlcomm_core.agent.planner import check_tasks
from tlcomm_core.errors import InputError
from tlcomm_core.method import Method
from tlcomm_core.scenario.loader import load_scenario
from tlcomm_core.scenario.model import Scenario
from tlcomm_core.scenario.site import Site
from tlcomm_tools.comparison.archive import Archive
from tlcomm_tools.comparison.cluster import remote_workers
from tlcomm_tools.comparison.design import Design, jobs_of
from tlcomm_tools.comparison.execution import run_missing
from tlcomm_tools.comparison.findings import Row, csv_text, document
from tlcomm_tools.comparison.interruption import held_interruption
from tlcomm_tools.comparison.job import Job
from tlcomm_tools.comparison.report import format_findings, markdown
from tlcomm_tools.comparison.sweep import QUANTITIES, Sweep, parse_sweep
from tlcomm_tools.comparison.workers import local_workers
from tlcomm_tools.folder import dumps_json
from tlcomm_tools.status import Status
from tlcomm_tools.verbs.options import (
    add_solver_argument,
    method,
    not_negative_int,
    positive_float,
    positive_int,
    print_json,
)

__all__ = ["EXAMPLE", "add_arguments", "run"]

EXAMPLE: Final = "tlcomm compare scenarios/plant.yaml --seeds 10"

_ROUNDS: Final = 100
_ROUNDS_OF_PROCESSES: Final = 10


def add_arguments(parser: ArgumentParser) -> None:
    """Add the verb's arguments."""
    parser.add_argument("scenario", type=Path, metavar="SCENARIO", help="a scenario file (YAML)")
    parser.add_argument(
        "--methods",
        type=_methods,
        metavar="A,B,…",
        help=f"of {', '.join(Method)} (default: all that the team's size lets)",
    )
    end = parser.add_mutually_exclusive_group()
    end.add_argument(
        "--rounds",
        type=not_negative_int,
        metavar="N",
        help=f"run until the window of round N is over, and D_c more (default {_ROUNDS}; with"
        f" --processes {_ROUNDS_OF_PROCESSES})",
    )
    end.add_argument(
        "--until", type=positive_float, metavar="S", help="run until this simulated time (s)"
    )
    parser.add_argument(
        "--seeds",
        type=positive_int,
        default=1,
        metavar="K",
        help="repeat from K starts; seed 0 is the scenario as given (default 1)",
    )
    parser.add_argument(
        "--sweep",
        type=_sweep,
        metavar="NAME=V1,V2,…",
        help=f"vary one of {', '.join(QUANTITIES)}",
    )
    add_solver_argument(parser)
    where = parser.add_mutually_exclusive_group()
    where.add_argument(
        "--processes",
        action="store_true",
        help="run teams of ROS processes, one after the other, as 'tlcomm run' does",
    )
    where.add_argument(
        "--scheduler", metavar="ADDRESS", help="send the runs to this Dask scheduler's workers"
    )
    parser.add_argument(
        "--out",
        type=Path,
        metavar="DIR",
        help="write here, or go on here (default runs/NAME-compare-TIME)",
    )


def run(options: Namespace) -> Status:
    """Compare and show the table."""
    scenario = load_scenario(options.scenario)
    # An agent without a plan would let all runs fail.
    check_tasks(Site.from_scenario(scenario))
    design = _design(scenario, options)
    jobs = jobs_of(design)
    with held_interruption() as act, _workers(options) as workers:
        archive = Archive.open(scenario.name, options.out, design.terms())
        failed = run_missing(jobs, archive, workers, act)
    rows = [
        Row(job, None, failed[job]) if job in failed else Row(job, archive.result(job), None)
        for job in jobs
    ]
    found = document(design, rows)
    archive.write("comparison.json", dumps_json(found))
    archive.write("comparison.csv", csv_text(found))
    archive.write("comparison.md", markdown(found))
    _draw(found, archive, [row.job for row in rows if row.result is not None])
    if options.json:
        print_json({**found, "folder": str(archive.path)})
    else:
        print(f"{format_findings(found)}\n\nfiles   {archive.path}")
    return Status.PROPERTY_FAILED if any(row.flaws for row in rows) else Status.FINE


def _design(scenario: Scenario, options: Namespace) -> Design:
    """Return what is compared, for how long unless told otherwise."""
    rounds = options.rounds
    if rounds is None and options.until is None:
        rounds = _ROUNDS_OF_PROCESSES if options.processes else _ROUNDS
    return Design(
        scenario=scenario,
        methods=options.methods,
        seeds=options.seeds,
        rounds=rounds,
        until_s=options.until,
        solver=options.solver,
        sweep=options.sweep,
        with_processes=options.processes,
    )


@contextmanager
def _workers(options: Namespace) -> Iterator[Executor | None]:
    """Give who does the jobs; ``None`` for ROS processes, a team at a time."""
    if options.processes:
        yield None
        return
    address = options.scheduler
    with local_workers() if address is None else remote_workers(address) as workers:
        yield workers


def _draw(found: Mapping[str, Any], archive: Archive, done: Sequence[Job]) -> None:
    """Draw the first seed's methods side by side and the team's run by itself, or the sweep."""
    # Not for those whose options are refused: matplotlib takes its time.
    from tlcomm_tools.figures.gallery import draw_comparison, draw_run, draw_sweep  # noqa: PLC0415

    if found["sweep"] is None:
        traces = archive.traces(done)
        draw_comparison(traces, archive.figures, found)
        for trace in traces:
            if trace.method == Method.TEAM:
                draw_run(trace, archive.figures)
    else:
        draw_sweep(found, archive.figures, QUANTITIES[found["sweep"]["name"]].label)


def _methods(text: str) -> tuple[Method, ...]:
    """Read names of methods; each counts once."""
    return tuple(dict.fromkeys(method(name) for name in text.split(",")))


def _sweep(text: str) -> Sweep:
    try:
        return parse_sweep(text)
    except InputError as error:
        raise ArgumentTypeError(str(error)) from None
