"""Run a scenario with one ROS 2 process per agent, the sim and the recorder."""

import sys
from argparse import ArgumentParser, Namespace
from pathlib import Path
from typing import Final

from tlcomm_core.agent.member import check_start
from tlcomm_core.agent.planner import check_tasks
from tlcomm_core.scenario.loader import load_scenario
from tlcomm_core.scenario.model import Scenario
from tlcomm_core.scenario.site import Site
from tlcomm_tools.limit import time_limit_s
from tlcomm_tools.progress import Progress
from tlcomm_tools.run import RunOptions, run_mission
from tlcomm_tools.status import Status
from tlcomm_tools.summary import format_summary
from tlcomm_tools.verbs.options import (
    add_compression_argument,
    add_mission_arguments,
    add_pace_argument,
    add_view_argument,
    mission_end,
    print_json,
)

__all__ = ["EXAMPLE", "add_arguments", "run", "run_scenario"]

EXAMPLE: Final = "tlcomm run scenarios/plant.yaml --rounds 3 --pace 1.0"


def add_arguments(parser: ArgumentParser) -> None:
    """Add the verb's arguments."""
    parser.add_argument("scenario", type=Path, metavar="SCENARIO", help="a scenario file (YAML)")
    add_mission_arguments(parser)
    add_pace_argument(parser)
    add_compression_argument(parser)
    add_view_argument(parser)


def run(options: Namespace) -> Status:
    """Run the scenario and show the results."""
    scenario = load_scenario(options.scenario)
    # Before any process starts: an agent without a plan would only take the others down with it.
    site = Site.from_scenario(scenario)
    check_tasks(site, options.method)
    check_start(site, options.method)
    return run_scenario(scenario, options)


def run_scenario(scenario: Scenario, options: Namespace) -> Status:
    """Run a scenario with the options that ``add_arguments`` describes; show the results."""
    options.method.solver(options.solver).check_team(len(scenario.agents))
    rounds, until_s = mission_end(options)
    limit_s = time_limit_s(scenario, rounds, until_s, options.method)
    what = RunOptions(
        scenario=scenario,
        method=options.method,
        solver=options.solver,
        seed=options.seed,
        pace=options.pace,
        rounds=rounds,
        until_s=until_s,
        out=options.out,
        compression=options.compression,
        has_view=options.view,
    )
    with Progress.towards(rounds, limit_s, options.method) as progress:
        report = run_mission(what, progress.show, lambda line: progress.tell(f"tlcomm: {line}"))
    if options.json:
        print_json({**report.result, "folder": str(report.folder.path)})
    else:
        print(format_summary(report.result, report.folder, has_bag=True))
    if report.failure is not None:
        failure = report.failure
        tail = "".join(f"\n  {line}" for line in failure.log_tail)
        print(f"tlcomm: error: {failure.name}: {failure.reason}", file=sys.stderr)
        if tail:
            print(f"the end of its log:{tail}", file=sys.stderr)
    return report.status
