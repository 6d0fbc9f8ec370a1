"""Conditions of actions against the same conditions as parts of the task."""

import itertools

import pytest

from support.lasso_semantics import holds
from support.small_plant import START, SmallPlant
from tlcomm_core.errors import UnreachableTaskError
from tlcomm_core.geometry import Pose
from tlcomm_core.ltl import parse
from tlcomm_core.planning.plan import LocalPlan
from tlcomm_core.planning.repertoire import Condition
from tlcomm_core.planning.synthesis import plan_task

PLANT = SmallPlant(("p", "hall", "r", "m"))
ACTIONS = {"collect": 4.0, "unload": 2.5, "wipe": 0.0}
TASKS = [
    "G F (m & unload) & G F r",
    "G F unload & G F wipe",
    "F unload & G F (hall | m)",
    "G F (r & wipe) & !(F unload)",
    "F (r & unload & X F (r & unload)) & G F p",
]
CONDITIONS: list[dict[str, Condition]] = [
    {"unload": Condition(after=frozenset({"collect"}))},
    {"unload": Condition(at=frozenset({"r", "m"}), after=frozenset({"collect"}))},
    {"collect": Condition(at=frozenset({"hall"})), "wipe": Condition(after=frozenset({"collect"}))},
    {
        "unload": Condition(after=frozenset({"collect", "wipe"})),
        "wipe": Condition(at=frozenset({"r", "p"}), after=frozenset({"collect"})),
    },
]


def as_formula(conditions: dict[str, Condition]) -> str:
    """Return the conditions as a conjunction: where, and not again before the others."""
    parts = ["true"]
    for action, condition in conditions.items():
        if condition.at is not None:
            parts.append(f"G ({action} -> {' | '.join(sorted(condition.at))})")
        for other in sorted(condition.after):
            waits = f"(!{action} W {other})"
            parts.append(f"{waits} & G ({action} -> X {waits})")
    return " & ".join(f"({part})" for part in parts)


def plan_or_none(task: str, conditions: dict[str, Condition], start: Pose) -> LocalPlan | None:
    """Return a plan, or None if there is none."""
    try:
        return plan_task(parse(task), PLANT.system(start, ACTIONS, conditions))
    except UnreachableTaskError:
        return None


@pytest.mark.parametrize("conditions", CONDITIONS)
@pytest.mark.parametrize("task", TASKS)
def test_a_plan_under_conditions_is_one_under_the_conditions_as_formulas(
    task: str, conditions: dict[str, Condition]
) -> None:
    """What it reads fits them, and nothing that does is cheaper; from a centre or beside one."""
    for start in (START, Pose(0.3, 0.2, 0.4)):
        own = plan_or_none(task, conditions, start)
        other = plan_or_none(f"{task} & {as_formula(conditions)}", {}, start)
        assert (own is None) == (other is None)
        if own is not None and other is not None:
            assert own.suffix_s == pytest.approx(other.suffix_s)
            assert holds(parse(as_formula(conditions)), *map(list, own.word))


def test_conditions_matter() -> None:
    """Most of the problems above would be solved sooner without them."""
    dearer = 0
    for task, conditions in itertools.product(TASKS, CONDITIONS):
        free, bound = (plan_or_none(task, given, START) for given in ({}, conditions))
        assert free is not None
        dearer += bound is None or bound.suffix_s + bound.first_s > free.suffix_s + free.first_s
    assert dearer > len(TASKS) * len(CONDITIONS) / 2
