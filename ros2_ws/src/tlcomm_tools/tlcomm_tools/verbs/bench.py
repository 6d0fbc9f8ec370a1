"""Measure planning, solving a round and simulating: medians over repeats, on this machine."""

import statistics
import sys
import time
from argparse import ArgumentParser, Namespace
from collections.abc import Callable, Mapping, Sequence
from dataclasses import asdict
from pathlib import Path
from typing import Any, Final

from tlcomm_core.agent.avoidance import travel_of
from tlcomm_core.agent.planner import local_plan
from tlcomm_core.game.algorithm import solve
from tlcomm_core.game.solver import SOLVERS
from tlcomm_core.ltl import parse, translate
from tlcomm_core.mission import Mission
from tlcomm_core.planning.product import build
from tlcomm_core.planning.synthesis import plan_task
from tlcomm_core.scenario.loader import load_scenario
from tlcomm_core.scenario.model import MAX_AGENTS, Scenario
from tlcomm_core.scenario.site import Site
from tlcomm_core.simulation import simulate
from tlcomm_core.units import seconds
from tlcomm_core.workspace.atlas import Atlas
from tlcomm_tools.instances import INSTANCES, plant_rounds, random_rounds
from tlcomm_tools.limit import time_limit_s
from tlcomm_tools.problems import PROBLEMS, Problem
from tlcomm_tools.recording_bench import format_recording, measure_recording
from tlcomm_tools.rounds import pose_round
from tlcomm_tools.solver_bench import SolverRow, growth, measure_solvers
from tlcomm_tools.status import Status
from tlcomm_tools.table import format_number, format_table
from tlcomm_tools.traffic import SIZES, format_traffic, measure_traffic
from tlcomm_tools.verbs.options import positive_int, print_json, team_size

__all__ = ["EXAMPLE", "add_arguments", "run"]

# Consecutive rounds of the scenario, and random ones of sizes without published figures.
_SCENARIO_ROUNDS: Final = 30
_FEWEST: Final = 3

EXAMPLE: Final = "tlcomm bench scenarios/plant.yaml scenarios/corridor.yaml --repeats 5"


def add_arguments(parser: ArgumentParser) -> None:
    """Add the verb's arguments."""
    parser.add_argument(
        "--solvers",
        action="store_true",
        help="measure the solvers instead, on the first scenario's rounds and on random ones",
    )
    parser.add_argument(
        "--traffic",
        action="store_true",
        help="measure what agents say instead, in random teams of growing size",
    )
    parser.add_argument(
        "--recording",
        action="store_true",
        help="measure what recording costs instead: runs in pairs, with a recorder and without",
    )
    parser.add_argument(
        "--agents",
        type=team_size(MAX_AGENTS),
        nargs="+",
        metavar="N",
        help=f"sizes of the random teams (default {' '.join(map(str, INSTANCES))} for solvers, "
        f"half an hour; {' '.join(map(str, SIZES))} for traffic)",
    )
    parser.add_argument(
        "--instances",
        type=positive_int,
        metavar="K",
        help="of each size (default as published: 30 of 8 agents, 10 of larger teams)",
    )
    parser.add_argument(
        "scenarios", type=Path, nargs="+", metavar="SCENARIO", help="scenario files (YAML)"
    )
    parser.add_argument(
        "--repeats", type=positive_int, default=3, metavar="N", help="of everything (default 3)"
    )
    parser.add_argument(
        "--rounds", type=positive_int, default=10, metavar="N", help="to simulate (default 10)"
    )


def run(options: Namespace) -> Status:
    """Measure and show the table."""
    sites = [Site.from_scenario(load_scenario(path)) for path in options.scenarios]
    if options.traffic:
        return _run_traffic(options)
    if options.recording:
        return _run_recording([site.scenario for site in sites], options)
    if options.solvers:
        return _run_solvers(sites[0], options)
    measured = [_measure(site, options.repeats, options.rounds) for site in sites]
    planning = [_measure_planning(problem, options.repeats) for problem in PROBLEMS]
    if options.json:
        print_json(
            {
                "format": "tlcomm-bench/1",
                "repeats": options.repeats,
                "rounds": options.rounds,
                "scenarios": measured,
                "planning": planning,
            }
        )
    else:
        print(_format_measured(measured, options.repeats, options.rounds))
        print(f"\n{_format_planning(planning)}")
    return Status.FINE


def _run_traffic(options: Namespace) -> Status:
    """Measure what agents say."""
    rows = measure_traffic(options.agents or SIZES, scenarios=options.instances or _FEWEST)
    if options.json:
        print_json({"format": "tlcomm-bench/1", "traffic": [asdict(row) for row in rows]})
    else:
        print(format_traffic(rows))
    return Status.FINE


def _run_recording(scenarios: Sequence[Scenario], options: Namespace) -> Status:
    """Measure what recording costs."""
    rows = [measure_recording(own, options.rounds, options.repeats) for own in scenarios]
    if options.json:
        print_json({"format": "tlcomm-bench/1", "recording": [asdict(row) for row in rows]})
    else:
        print(format_recording(rows, options.rounds, options.repeats))
    return Status.FINE


def _run_solvers(site: Site, options: Namespace) -> Status:
    """Measure the solvers; rows are shown on standard error as they come."""
    measured = [
        plant_rounds(site, options.instances or _SCENARIO_ROUNDS),
        *(
            random_rounds(agents, options.instances or INSTANCES.get(agents, _FEWEST))
            for agents in options.agents or INSTANCES
        ),
    ]
    rows = []
    for row in measure_solvers(measured, tuple(SOLVERS.values())):
        print(f"{row.instances} {row.agents} {row.solver}", file=sys.stderr)
        rows.append(row)
    if options.json:
        print_json({"format": "tlcomm-bench/1", "solvers": [asdict(row) for row in rows]})
    else:
        print(_format_solvers(rows))
    return Status.FINE


def _format_solvers(rows: Sequence[SolverRow]) -> str:
    cells = [
        (
            row.instances,
            row.solver,
            str(row.agents),
            str(row.count),
            format_number(1e3 * row.initial_s),
            format_number(1e3 * row.agent_s),
            format_number(row.mean_ratio, 3),
            format_number(row.worst_ratio, 3),
            row.reference,
        )
        for row in rows
    ]
    header = ("rounds", "solver", "N", "count", "S⁰/ms", "agent/ms", "mean", "worst", "of")
    grown = [(solver, growth(rows, solver)) for solver in SOLVERS]
    lines = [f"  {solver} grows like N^{p:.2f}" for solver, p in grown if p is not None]
    return (
        f"medians of processor time\n\n{format_table(header, cells, left=2)}\n\n"
        "  agent        from S⁰ to one agent's proposal, or to all agents' equilibrium\n"
        "  mean, worst  Φ over that of the solver named last\n" + "\n".join(lines)
    )


def _measure(site: Site, repeats: int, rounds: int) -> dict[str, Any]:
    scenario = site.scenario
    first = next(iter(scenario.agents))
    problem = pose_round(site, 1, seed=0)
    mission = Mission(site, 0, rounds, time_limit_s(scenario, rounds, None))
    left = simulate(mission)
    sim_s = seconds(left.sim_ns)
    simulate_s = _median_s(lambda: simulate(mission), repeats)
    return {
        "scenario": scenario.name,
        "agents": len(scenario.agents),
        "locations": len(site.grid),
        "plan_s": _median_s(lambda: _plan(first, site), repeats),
        "solve_s": _median_s(lambda: solve(problem), repeats),
        "own_solve_s": statistics.median(own.solve_wall_s for own in left.records.timings),
        "simulate_s": simulate_s,
        "sim_s": sim_s,
        "realtime_factor": sim_s / simulate_s,
    }


def _measure_planning(problem: Problem, repeats: int) -> dict[str, Any]:
    formula, system = parse(problem.task), problem.make()
    product = build(system, translate(formula))
    plan_s = _median_s(lambda: plan_task(formula, system), repeats)
    published_s = problem.published_s
    return {
        "problem": problem.name,
        "product_states": product.size,
        "product_edges": len(product.source),
        "system_s": _median_s(problem.make, repeats),
        "plan_s": plan_s,
        "published_s": None if published_s is None else list(published_s),
        "ratio": None if published_s is None else [own_s / plan_s for own_s in published_s],
    }


def _plan(name: str, site: Site) -> None:
    local_plan(name, site, travel_of(name, site, Atlas(site.grid, site.region_discs)))


def _median_s(work: Callable[[], object], repeats: int) -> float:
    times_s = []
    for _ in range(repeats):
        begun_s = time.perf_counter()
        work()
        times_s.append(time.perf_counter() - begun_s)
    return statistics.median(times_s)


def _format_measured(measured: Sequence[Mapping[str, Any]], repeats: int, rounds: int) -> str:
    rows = [
        (
            own["scenario"],
            str(own["agents"]),
            str(own["locations"]),
            format_number(1e3 * own["plan_s"]),
            format_number(1e3 * own["solve_s"]),
            format_number(1e3 * own["own_solve_s"]),
            format_number(own["simulate_s"], 2),
            format_number(own["realtime_factor"], 0),
        )
        for own in measured
    ]
    header = (
        "scenario",
        "agents",
        "places",
        "plan/ms",
        "solve/ms",
        "own/ms",
        f"{rounds} rounds/s",
        "× real time",
    )
    return (
        f"medians of {repeats}\n\n{format_table(header, rows)}\n\n"
        "  plan    one agent's local plan, travel times included\n"
        "  solve   round 1 by Algorithm 1 in one place, candidates given\n"
        "  own     an agent's own computing per round, in the simulation\n"
        "  rounds  the whole simulation in one process"
    )


def _format_planning(measured: Sequence[Mapping[str, Any]]) -> str:
    rows = [
        (
            own["problem"],
            str(own["product_states"]),
            str(own["product_edges"]),
            format_number(1e3 * own["system_s"]),
            format_number(1e3 * own["plan_s"]),
            "–" if own["ratio"] is None else "{:.0f}–{:.0f}".format(*own["ratio"]),
        )
        for own in measured
    ]
    header = ("planning", "states", "edges", "system/ms", "plan/ms", "ratio")
    return (
        f"{format_table(header, rows)}\n\n"
        "  states  of the product, and its edges\n"
        "  system  the transition system, with all of the workspace's legs\n"
        "  plan    automaton, product and search\n"
        "  ratio   the 23–38 s reported for P_MAS_TG on this shape, over ours"
    )
