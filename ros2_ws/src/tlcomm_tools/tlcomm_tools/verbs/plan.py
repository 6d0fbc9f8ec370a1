"""Show each agent's local plan: prefix, suffix, what they take, and why none is better."""

import textwrap
import time
from argparse import ArgumentParser, Namespace
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, Final

from tlcomm_core.agent.avoidance import travel_of
from tlcomm_core.agent.planner import explained_plan, local_plan
from tlcomm_core.errors import InputError
from tlcomm_core.planning.explanation import Explanation, Rival
from tlcomm_core.planning.lasso import Objective
from tlcomm_core.planning.plan import LocalPlan, PlanStep
from tlcomm_core.scenario.loader import load_scenario
from tlcomm_core.scenario.model import Soft
from tlcomm_core.scenario.site import Site
from tlcomm_core.workspace.atlas import Atlas
from tlcomm_tools.status import Status
from tlcomm_tools.table import format_number, format_table
from tlcomm_tools.verbs.options import positive_fraction, print_json

__all__ = ["EXAMPLE", "add_arguments", "run"]

EXAMPLE: Final = "tlcomm plan scenarios/plant.yaml --agent agent_1"

_WIDTH: Final = 80


def add_arguments(parser: ArgumentParser) -> None:
    """Add the verb's arguments."""
    parser.add_argument("scenario", type=Path, metavar="SCENARIO", help="a scenario file (YAML)")
    parser.add_argument("--agent", metavar="NAME", help="only this agent's")
    parser.add_argument(
        "--gamma",
        type=positive_fraction,
        metavar="G",
        help="minimise the first satisfaction's time + G × the suffix's "
        "(default: the suffix's time, then the first satisfaction's)",
    )
    parser.add_argument(
        "--explain",
        action="store_true",
        help="also tell what the best plans cost that do without a part of it",
    )


def run(options: Namespace) -> Status:
    """Make the plans and show them."""
    scenario = load_scenario(options.scenario)
    site = Site.from_scenario(scenario)
    names = list(scenario.agents)
    if options.agent is not None:
        if options.agent not in names:
            known = ", ".join(names)
            raise InputError(f"--agent: no agent {options.agent!r} (the agents are {known})")
        names = [options.agent]
    objective = Objective(options.gamma)
    plans = {name: _plan(name, site, objective, is_explained=options.explain) for name in names}
    if options.json:
        print_json({"format": "tlcomm-plan/1", "scenario": scenario.name, "agents": plans})
    else:
        print("\n\n".join(_format_plan(name, plan) for name, plan in plans.items()))
    return Status.FINE


def _plan(name: str, site: Site, objective: Objective, *, is_explained: bool) -> dict[str, Any]:
    agent = site.scenario.agents[name]
    begun_s = time.perf_counter()
    travel = travel_of(name, site, Atlas(site.grid, site.region_discs))
    explanation = explained_plan(name, site, travel, objective) if is_explained else None
    plan = local_plan(name, site, travel, objective) if explanation is None else explanation.plan
    planning_wall_s = time.perf_counter() - begun_s
    stem, loop = plan.word
    told: dict[str, Any] = {
        "task": agent.whole_task if agent.automaton is None else None,
        "soft": None if agent.soft is None else _soft(agent.soft, plan),
        "prefix": [_step(step, site) for step in plan.prefix],
        "suffix": [_step(step, site) for step in plan.suffix],
        "prefix_s": plan.prefix_s,
        "suffix_s": plan.suffix_s,
        "first_s": plan.first_s,
        "prefix_m": plan.prefix_m,
        "suffix_m": plan.suffix_m,
        "word": {"stem": list(map(sorted, stem)), "loop": list(map(sorted, loop))},
        "planning_wall_s": planning_wall_s,
    }
    if explanation is not None:
        told["explanation"] = _explanation(explanation)
    return told


def _explanation(explanation: Explanation) -> dict[str, Any]:
    second_best = explanation.second_best
    return {
        "second_best": None if second_best is None else _rival(second_best),
        "rivals": list(map(_rival, explanation.rivals)),
    }


def _rival(rival: Rival) -> dict[str, Any]:
    move, plan = rival.without, rival.plan
    return {
        "without": {"from": move.source, "to": move.target, "action": move.action},
        "suffix_s": None if plan is None else plan.suffix_s,
        "suffix_price_s": None if plan is None else plan.suffix_price_s,
        "first_s": None if plan is None else plan.first_s,
    }


def _soft(soft: Soft, plan: LocalPlan) -> dict[str, Any]:
    """Return the soft task and how a plan violates it; figures are ``None`` if it is ignored."""
    figures = {
        "prefix_violation": plan.prefix_violation,
        "prefix_price_s": plan.prefix_price_s,
        "suffix_violation": plan.suffix_violation,
        "suffix_price_s": plan.suffix_price_s,
    }
    return {
        "task": soft.task,
        "weight_s": soft.weight_s,
        "start_wants": list(plan.initial_wanted),
        **(figures if plan.weight_s is not None else dict.fromkeys(figures)),
    }


def _step(step: PlanStep, site: Site) -> dict[str, Any]:
    return {
        "region": step.region,
        "action": step.action,
        "at": site.grid.locations_m[step.location].tolist(),
        "duration": step.duration_s,
        "satisfies": step.satisfies,
        "soft_wants": list(step.wanted),
    }


def _format_plan(name: str, plan: Mapping[str, Any]) -> str:
    steps = [("prefix", step) for step in plan["prefix"]]
    steps += [("suffix", step) for step in plan["suffix"]]
    rows = [
        (
            str(index),
            part,
            step["region"],
            step["action"] or "visit",
            "({:g}, {:g})".format(*step["at"]),
            f"{step['duration']:g}",
            "satisfied" if step["satisfies"] else "",
            " ".join(step["soft_wants"]),
        )
        for index, (part, step) in enumerate(steps)
    ]
    header = ("step", "part", "region", "action", "at/m", "stays/s", "task", "soft task wants")
    columns = len(header) - (plan["soft"] is None)
    return (
        f"{name}: {plan['task'] or 'the given automaton'}\n"
        f"  prefix {plan['prefix_s']:.2f} s and {plan['prefix_m']:.2f} m, "
        f"suffix {plan['suffix_s']:.2f} s and {plan['suffix_m']:.2f} m\n"
        f"  satisfied first at {plan['first_s']:.2f} s; "
        f"planned in {1e3 * plan['planning_wall_s']:.0f} ms\n"
        f"{_format_soft(plan['soft'])}"
        f"{format_table(header[:columns], [row[:columns] for row in rows], left=5)}\n"
        f"{_format_word(plan['word'])}"
        f"{_format_explanation(plan)}"
    )


def _format_soft(soft: Mapping[str, Any] | None) -> str:
    """Return lines on the soft task, if there is one."""
    if soft is None:
        return ""
    if soft["suffix_violation"] is None:
        return f"  soft task {soft['task']}: ignored, as its weight is 0\n"
    wants = " ".join(soft["start_wants"])
    return (
        f"  soft task {soft['task']}, {soft['weight_s']:g} s per atom\n"
        f"  violated by {_format_violation(soft, 'prefix')} in the prefix, "
        f"{_format_violation(soft, 'suffix')} in each suffix\n"
        + (f"  at the start the soft task wants {wants}\n" if wants else "")
    )


def _format_violation(soft: Mapping[str, Any], part: str) -> str:
    count, price_s = soft[f"{part}_violation"], soft[f"{part}_price_s"]
    return f"{count} atom{'s' * (count != 1)} ({price_s:.2f} s)"


def _format_explanation(plan: Mapping[str, Any]) -> str:
    """Return why the suffix is the best, if that was asked for."""
    explanation = plan.get("explanation")
    if explanation is None:
        return ""
    figures = {"suffix_s": "suffix/s", "first_s": "first/s"}
    if plan["soft"] is not None:
        figures["suffix_price_s"] = "price/s"
    rows = [
        (
            _format_move(rival["without"]),
            *(format_number(rival[figure], 2) for figure in figures),
            "second best" if rival == explanation["second_best"] else "",
        )
        for rival in explanation["rivals"]
    ]
    header = ("suffix without", *figures.values(), "")
    return f"\n  why   {_reason(plan)}\n{format_table(header, rows)}"


def _reason(plan: Mapping[str, Any]) -> str:
    second_best = plan["explanation"]["second_best"]
    if second_best is None:
        return "it is the only suffix: each of its moves is needed"
    price_s = None if plan["soft"] is None else plan["soft"]["suffix_price_s"]
    return (
        f"the second best does without {_format_move(second_best['without'])}: "
        f"{_format_cost(second_best['suffix_s'], second_best['suffix_price_s'])} against "
        f"{_format_cost(plan['suffix_s'], price_s)}"
    )


def _format_cost(suffix_s: float, price_s: float | None) -> str:
    """Return a suffix's time, and the price of what it violates."""
    return f"{suffix_s:.2f} s" + (f" + {price_s:.2f} s" if price_s else "")


def _format_move(move: Mapping[str, Any]) -> str:
    source, target = (move[end] or "start" for end in ("from", "to"))
    if source != target:
        return f"{source} → {target}"
    return f"{target} {move['action'] or 'idle'}"


def _format_word(word: Mapping[str, Sequence[Sequence[str]]]) -> str:
    """Return the word, its letters in braces, within the width of a terminal."""
    stem, loop = (
        " ".join("{" + ", ".join(letter) + "}" for letter in word[part])
        for part in ("stem", "loop")
    )
    return textwrap.fill(
        f"{stem} ({loop})^ω",
        width=_WIDTH,
        initial_indent="  word  ",
        subsequent_indent=" " * 8,
        break_long_words=False,
    )
