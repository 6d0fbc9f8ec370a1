"""Local plans from a scenario."""

import pytest

from support.danger_hall import danger_hall
from support.hall import hall
from tlcomm_core.agent.avoidance import travel_of
from tlcomm_core.agent.planner import local_plan
from tlcomm_core.errors import UnsatisfiableTaskError
from tlcomm_core.planning.plan import LocalPlan
from tlcomm_core.scenario.loader import dumps, loads
from tlcomm_core.scenario.site import Site
from tlcomm_core.workspace.atlas import Atlas
from tlcomm_core.workspace.travel import TravelTimes


def test_a_plan_keeps_the_conditions_of_actions() -> None:
    """What is weighed in the east was loaded after the last time that anything was weighed."""
    actions = "load: {duration_s: 2.0, at: [west]}, weigh: {duration_s: 1.0, after: [load]}"
    site = Site.from_scenario(danger_hall("G F (east & weigh)", actions))
    plan = local_plan("careful", site, travel_of("careful", site, Atlas(site.grid)))
    acts = [(step.region, step.action) for step in plan.suffix if step.action is not None]
    assert sorted(acts) == [("east", "weigh"), ("west", "load")]


def _plan_with(fields: str) -> LocalPlan:
    """Return the only agent's plan with some fields more."""
    text = dumps(hall(1).scenario).replace("    tasks: []\n", fields)
    site = Site.from_scenario(loads(text))
    return local_plan("one", site, TravelTimes(site.grid, site.motion_of("one")))


def test_all_of_an_agents_tasks_are_done() -> None:
    """A task in the list counts as much as the task."""
    plan = _plan_with('    tasks: ["F (b & pick)", "G !(a & place)"]\n')
    done = [step.label for step in (*plan.prefix, *plan.suffix)]
    assert {"b", "pick"} in done
    assert any(step.satisfies for step in plan.suffix)


def test_a_soft_task_is_planned_for() -> None:
    """It changes the plan where its weight is worth it, and is ignored where it has none."""
    soft = "    soft: {task: G F (b & pick), weight_s: WEIGHT}\n"
    assert {"b", "pick"} in [step.label for step in _plan_with(soft.replace("WEIGHT", "9")).suffix]
    assert _plan_with(soft.replace("WEIGHT", "1")).suffix_price_s == 1.0
    assert _plan_with(soft.replace("WEIGHT", "0")) == _plan_with("")


def test_a_contradiction_is_told_with_its_place() -> None:
    """The message says in which of the agent's fields it is."""
    for fields, place in (
        ("    soft: {task: G F (a & !a), weight_s: 1}\n", r"agents\.one\.soft\.task: soft task "),
        ('    tasks: ["G !b"]\n', r"agents\.one\.tasks: "),
    ):
        with pytest.raises(UnsatisfiableTaskError, match=place):
            _plan_with(fields)
