"""Run a scenario inside one process, without ROS: same agents, same world, same results."""

from argparse import ArgumentParser, Namespace
from pathlib import Path
from typing import Final

from tlcomm_core.errors import InputError
from tlcomm_core.mission import Mission
from tlcomm_core.scenario.loader import dumps, load_scenario
from tlcomm_core.scenario.site import Site
from tlcomm_core.units import seconds
from tlcomm_tools.folder import RunFolder
from tlcomm_tools.limit import time_limit_s
from tlcomm_tools.progress import Progress
from tlcomm_tools.status import Status
from tlcomm_tools.summary import format_summary
from tlcomm_tools.timed_simulation import simulate_timed
from tlcomm_tools.verbs.options import (
    LOCKSTEP,
    add_mission_arguments,
    add_pace_argument,
    mission_end,
    print_json,
)

__all__ = ["EXAMPLE", "add_arguments", "run"]

EXAMPLE: Final = "tlcomm simulate scenarios/plant.yaml --rounds 100"


def add_arguments(parser: ArgumentParser) -> None:
    """Add the verb's arguments."""
    parser.add_argument("scenario", type=Path, metavar="SCENARIO", help="a scenario file (YAML)")
    add_mission_arguments(parser)
    add_pace_argument(parser)


def run(options: Namespace) -> Status:
    """Simulate the scenario, write its files and show the results."""
    if not options.pace.is_lockstep:
        raise InputError(
            f"argument --pace: {str(options.pace)!r} is for 'tlcomm run'; "
            f"'tlcomm simulate' knows {LOCKSTEP!r} only"
        )
    scenario = load_scenario(options.scenario)
    solver = options.method.solver(options.solver)
    solver.check_team(len(scenario.agents))
    rounds, until_s = mission_end(options)
    limit_s = time_limit_s(scenario, rounds, until_s, options.method)
    mission = Mission(
        Site.from_scenario(scenario), options.seed, rounds, limit_s, solver, options.method
    )
    folder = RunFolder.create(scenario.name, options.method, options.out)
    folder.write_scenario(dumps(scenario))
    with Progress.towards(rounds, limit_s, options.method) as progress:
        left, result = simulate_timed(
            mission, lambda sim_ns, meetings: progress.show(seconds(sim_ns), meetings)
        )
    folder.write_results(result, left.records)
    if options.json:
        print_json({**result, "folder": str(folder.path)})
    else:
        print(format_summary(result, folder, has_bag=False))
    return Status.FINE if result["verdict"] == "ok" else Status.PROPERTY_FAILED
