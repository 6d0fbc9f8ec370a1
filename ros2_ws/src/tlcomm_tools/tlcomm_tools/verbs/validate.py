"""Check a scenario file: syntax, types and ranges, places, connectedness, formulas."""

from argparse import ArgumentParser, Namespace
from pathlib import Path
from typing import Final

from tlcomm_core.agent.planner import check_tasks
from tlcomm_core.scenario.loader import load_scenario
from tlcomm_core.scenario.site import Site
from tlcomm_tools.status import Status
from tlcomm_tools.verbs.options import print_json

__all__ = ["EXAMPLE", "add_arguments", "run"]

EXAMPLE: Final = "tlcomm validate scenarios/plant.yaml"


def add_arguments(parser: ArgumentParser) -> None:
    """Add the verb's arguments."""
    parser.add_argument("scenario", type=Path, metavar="SCENARIO", help="a scenario file (YAML)")


def run(options: Namespace) -> Status:
    """Check the file."""
    scenario = load_scenario(options.scenario)
    site = Site.from_scenario(scenario)
    check_tasks(site)
    links = scenario.communication
    if options.json:
        print_json(
            {
                "format": "tlcomm-validation/1",
                "scenario": scenario.name,
                "agents": list(scenario.agents),
                "regions": list(scenario.workspace.regions),
                "locations": len(site.grid),
                "verdict": "ok",
            }
        )
    else:
        width_m, height_m = scenario.workspace.size_m
        print(
            f"{options.scenario}: ok\n"
            f"  scenario   {scenario.name}\n"
            f"  workspace  {width_m:g} m × {height_m:g} m, cells of "
            f"{scenario.workspace.cell_m:g} m, {len(site.grid)} of them free\n"
            f"  regions    {len(scenario.workspace.regions)}\n"
            f"  agents     {len(scenario.agents)}\n"
            f"  meetings   R = {links.range_m:g} m, T_c = {links.period_s:g} s, "
            f"D_c = {links.duration_s:g} s"
        )
    return Status.FINE
