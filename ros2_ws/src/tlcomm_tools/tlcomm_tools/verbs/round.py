"""Show one round's problem and its solution: what the team decides on at the meeting before it."""

import json
import math
from argparse import ArgumentParser, Namespace
from collections.abc import Mapping
from pathlib import Path
from typing import Any, Final

from tlcomm_core.errors import InfeasibleRoundError, InputError
from tlcomm_core.game.algorithm import solve
from tlcomm_core.game.document import round_document, solved_document
from tlcomm_core.game.problem import RoundProblem
from tlcomm_core.game.rules import Rules
from tlcomm_core.game.solver import Solved, Solver, solve_with
from tlcomm_core.scenario.loader import load_scenario
from tlcomm_core.scenario.site import Site
from tlcomm_tools.meeting_reasons import explanation_document, format_explanation
from tlcomm_tools.rounds import pose_round
from tlcomm_tools.status import Status
from tlcomm_tools.table import format_table
from tlcomm_tools.verbs.options import (
    add_solver_argument,
    not_negative_int,
    positive_int,
    print_json,
)

__all__ = ["EXAMPLE", "add_arguments", "run"]

EXAMPLE: Final = "tlcomm round scenarios/plant.yaml --round 3 --out round_3.json"


def add_arguments(parser: ArgumentParser) -> None:
    """Add the verb's arguments."""
    parser.add_argument("scenario", type=Path, metavar="SCENARIO", help="a scenario file (YAML)")
    parser.add_argument(
        "--round", type=positive_int, required=True, metavar="R", help="which round, from 1 on"
    )
    add_solver_argument(parser)
    parser.add_argument(
        "--explain",
        action="store_true",
        help="also say what each agent pays, what else it could do, and how Φ came down",
    )
    parser.add_argument("--out", type=Path, metavar="FILE", help="write the JSON document here")
    parser.add_argument(
        "--seed",
        type=not_negative_int,
        default=0,
        metavar="N",
        help="of all that is random (default 0)",
    )


def run(options: Namespace) -> Status:
    """Simulate up to the round, solve it and show it."""
    site = Site.from_scenario(load_scenario(options.scenario))
    options.solver.check_team(len(site.scenario.agents))
    problem = pose_round(site, options.round, options.seed, options.solver)
    try:
        reference = solve(problem)
        solved = solve_with(options.solver, problem)
    except InfeasibleRoundError as error:
        raise InputError(f"round {options.round}: {error}") from error
    document = round_document(problem, reference)
    if options.solver.propose is not None:
        document[options.solver.name] = solved_document(problem, solved)
    if options.explain:
        document["explanation"] = explanation_document(problem, solved)
    if options.out is not None:
        _write(options.out, document)
    if options.json:
        print_json(document)
    else:
        print(_format_round(problem, options.solver, solved))
        if options.explain:
            print(f"\n{format_explanation(problem, solved)}")
        if options.out is not None:
            print(f"\nwritten to {options.out}")
    return Status.FINE


def _write(path: Path, document: Mapping[str, Any]) -> None:
    try:
        path.write_text(json.dumps(document) + "\n", "utf-8")
    except OSError as error:
        raise InputError(f"--out: can't write {str(path)!r}: {error.strerror}") from error


def _format_round(problem: RoundProblem, solver: Solver, solved: Solved) -> str:
    opens_s, closes_s = problem.window_s
    rows = []
    initial = problem.strategies(solved.initial)
    final = problem.strategies(solved.solution.nash)
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
        f"  {len(problem.locations_m)} locations, range {problem.range_m:g} m"
        f"{_format_rules(problem.rules)}\n"
        f"  Φ(S⁰) = {solved.initial_potential_s:.3f} s, "
        f"{_format_outcome(problem, solver, solved)}\n"
        f"\n{format_table(header, rows)}"
    )


def _format_rules(rules: Rules) -> str:
    apart = f", places at least {rules.separation_m:g} m apart" if rules.separation_m else ""
    return apart + (", connected without any one agent" if rules.resilience else "")


def _format_outcome(problem: RoundProblem, solver: Solver, solved: Solved) -> str:
    least_s, moves = solved.solution.potentials_s[-1], solved.solution.iterations
    if solved.proposer is None:
        return f"Φ = {least_s:.3f} s after {moves} moves by {solver.name}"
    proven = f", none is below {solved.bound_s:.3f} s" if math.isfinite(solved.bound_s) else ""
    return (
        f"Φ = {least_s:.3f} s by {solver.name}{proven}\n"
        f"  {problem.agents[solved.proposer]}'s proposal, then {moves} moves"
    )
