"""Show one round's problem and its solution: what the team decides on at the meeting before it."""

import json
from argparse import ArgumentParser, Namespace
from collections.abc import Mapping
from pathlib import Path
from typing import Any, Final

from tlcomm_core.errors import InfeasibleRoundError, InputError
from tlcomm_core.game.algorithm import Solution, solve
from tlcomm_core.game.document import profile_document, round_document
from tlcomm_core.game.exact import MOST_AGENTS, Optimum, solve_exactly
from tlcomm_core.game.problem import RoundProblem
from tlcomm_core.scenario.loader import load_scenario
from tlcomm_core.scenario.site import Site
from tlcomm_tools.rounds import pose_round
from tlcomm_tools.status import Status
from tlcomm_tools.table import format_table
from tlcomm_tools.verbs.options import not_negative_int, positive_int, print_json

__all__ = ["EXAMPLE", "add_arguments", "run"]

EXAMPLE: Final = "tlcomm round scenarios/plant.yaml --round 3 --out round_3.json"


def add_arguments(parser: ArgumentParser) -> None:
    """Add the verb's arguments."""
    parser.add_argument("scenario", type=Path, metavar="SCENARIO", help="a scenario file (YAML)")
    parser.add_argument(
        "--round", type=positive_int, required=True, metavar="R", help="which round, from 1 on"
    )
    parser.add_argument(
        "--exact",
        action="store_true",
        help=f"also find the optimum, of at most {MOST_AGENTS} agents, and prove it",
    )
    parser.add_argument("--out", type=Path, metavar="FILE", help="write the JSON document here")
    parser.add_argument(
        "--seed", type=not_negative_int, default=0, metavar="N", help="of all noise (default 0)"
    )


def run(options: Namespace) -> Status:
    """Simulate up to the round, solve it and show it."""
    site = Site.from_scenario(load_scenario(options.scenario))
    if options.exact and len(site.scenario.agents) > MOST_AGENTS:
        raise InputError(
            f"--exact: the optimum of {len(site.scenario.agents)} agents takes too long; "
            f"expected at most {MOST_AGENTS}"
        )
    problem = pose_round(site, options.round, options.seed)
    try:
        solution = solve(problem)
    except InfeasibleRoundError as error:
        raise InputError(f"round {options.round}: {error}") from error
    optimum = solve_exactly(problem, solution.nash) if options.exact else None
    document = round_document(problem, solution)
    if optimum is not None:
        document["exact"] = profile_document(problem, optimum.profile) | {"bound": optimum.bound_s}
    if options.out is not None:
        _write(options.out, document)
    if options.json:
        print_json(document)
    else:
        print(_format_round(problem, solution, optimum))
        if options.out is not None:
            print(f"\nwritten to {options.out}")
    return Status.FINE


def _write(path: Path, document: Mapping[str, Any]) -> None:
    try:
        path.write_text(json.dumps(document) + "\n", "utf-8")
    except OSError as error:
        raise InputError(f"--out: can't write {str(path)!r}: {error.strerror}") from error


def _format_round(problem: RoundProblem, solution: Solution, optimum: Optimum | None) -> str:
    opens_s, closes_s = problem.window_s
    rows = []
    initial = problem.strategies(solution.initial)
    final = problem.strategies(solution.nash if optimum is None else optimum.profile)
    for before, after in zip(initial, final, strict=True):
        rows.append(
            (
                after.agent,
                f"({before.x_m:g}, {before.y_m:g})",
                str(before.task_index),
                f"({after.x_m:g}, {after.y_m:g})",
                str(after.task_index),
                f"{after.arrival_s:.2f}",
                f"{abs(after.extra_travel_s):.2f}",
            )
        )
    header = ("agent", "z in S⁰", "h", "z", "h", "arrives/s", "detour/s")
    return (
        f"round {problem.round}, t_c in [{opens_s:g} s, {closes_s:g} s)\n"
        f"  {len(problem.locations_m)} locations, range {problem.range_m:g} m\n"
        f"  Φ(S⁰) = {solution.potentials_s[0]:.3f} s, Φ = {solution.potentials_s[-1]:.3f} s "
        f"after {solution.iterations} moves\n"
        f"{_format_optimum(optimum)}\n"
        f"{format_table(header, rows)}"
    )


def _format_optimum(optimum: Optimum | None) -> str:
    if optimum is None:
        return ""
    least_s, bound_s = optimum.potential_s, optimum.bound_s
    return f"  optimum Φ = {least_s:.3f} s, as shown; none is below {bound_s:.3f} s\n"
