"""An agent's local plan from its scenario: formula, regions, actions and travel times put together.

``local_plan``      its plan for its task
``explained_plan``  the same beside what else there is
``plan_for``        its plan for another task, or on another map
``check_tasks``     whether all agents have one
``Planner``         what makes plans during a run
"""

from collections.abc import Callable
from dataclasses import replace
from typing import TypeVar

from tlcomm_core.agent.avoidance import avoided_regions, joint_travel, obstruction, travel_of
from tlcomm_core.errors import InputError, PlanningError
from tlcomm_core.geometry import Pose
from tlcomm_core.ltl import parse
from tlcomm_core.method import Method
from tlcomm_core.planning.explanation import Explanation, explain_plan
from tlcomm_core.planning.lasso import SUFFIX_FIRST, Objective
from tlcomm_core.planning.plan import LocalPlan
from tlcomm_core.planning.relaxation import SoftTask, soft_task
from tlcomm_core.planning.repertoire import Condition
from tlcomm_core.planning.synthesis import plan_task
from tlcomm_core.planning.transition_system import TransitionSystem, build
from tlcomm_core.scenario.checks import check_formulas
from tlcomm_core.scenario.site import Site
from tlcomm_core.scenario.task import Task, hard_formula, task_field, task_of
from tlcomm_core.workspace.atlas import Atlas
from tlcomm_core.workspace.travel import TravelTimes

__all__ = ["Planner", "check_tasks", "explained_plan", "local_plan", "plan_for"]

_Plan = TypeVar("_Plan", LocalPlan, Explanation)

Planner = Callable[[str | None, Pose, TravelTimes], LocalPlan]
"""Makes an agent's plan for a task (its text; ``None``: the scenario's) from a pose, on the map of
travel times; raises InputError or PlanningError."""


def local_plan(
    name: str, site: Site, travel: TravelTimes, objective: Objective = SUFFIX_FIRST
) -> LocalPlan:
    """Return an agent's optimal local plan.

    Args:
        name: the agent's name.
        site: the scenario.
        travel: its travel times, as ``travel_of`` gives them.
        objective: what is to be least.

    Raises:
        PlanningError: there is none; the message says whose.
    """
    return _made(plan_task, name, site, travel, objective)


def explained_plan(
    name: str, site: Site, travel: TravelTimes, objective: Objective = SUFFIX_FIRST
) -> Explanation:
    """Return an agent's optimal local plan beside the best ones without a part of it.

    Args:
        name: as for ``local_plan``.
        site: the scenario.
        travel: as for ``local_plan``.
        objective: as for ``local_plan``.

    Raises:
        PlanningError: there is none; the message says whose.
    """
    return _made(explain_plan, name, site, travel, objective)


def _made(
    make: Callable[[Task, TransitionSystem, Objective, SoftTask | None], _Plan],
    name: str,
    site: Site,
    travel: TravelTimes,
    objective: Objective,
) -> _Plan:
    """Return what is made of an agent's task; why there is none is told by agent and field."""
    system, soft = _system(name, site, travel), _soft_task(name, site)
    agent = site.scenario.agents[name]
    try:
        return make(task_of(agent), system, objective, soft)
    except PlanningError as error:
        blocked = obstruction(site, system.states[0].location, hard_formula(agent), travel)
        reason = f"{error}; {blocked}" if blocked else f"{error}"
        raise type(error)(f"agents.{name}.{task_field(agent)}: {reason}") from error


def _system(name: str, site: Site, travel: TravelTimes) -> TransitionSystem:
    actions = site.scenario.conditional_actions_of(name)
    conditions = {
        action: Condition(None if own.at is None else frozenset(own.at), frozenset(own.after))
        for action, own in actions.items()
    }
    return build(
        travel,
        site.start_of(name),
        site.region_location,
        site.regions_at,
        site.action_durations(name),
        conditions,
    )


def _soft_task(name: str, site: Site) -> SoftTask | None:
    soft = site.scenario.agents[name].soft
    if soft is None:
        return None
    try:
        return soft_task(parse(soft.task), soft.weight_s)
    except PlanningError as error:
        raise type(error)(f"agents.{name}.soft.task: {error}") from error


def plan_for(
    task: str | None, start: Pose, name: str, site: Site, travel: TravelTimes
) -> LocalPlan:
    """Return an agent's plan for another task than the scenario's, from another start or map.

    Args:
        task: takes the place of all the agent's hard tasks; its soft one stays. With ``None`` all
            stay.
        start: where the agent begins.
        name: the agent's name.
        site: the scenario.
        travel: the agent's travel times, on the scenario's map or another.

    Raises:
        InputError: the task isn't a formula over the scenario's regions and the agent's actions.
        PlanningError: there is no plan.
    """
    changed: dict[str, object] = {"start": (start.x_m, start.y_m, start.yaw_rad)}
    if task is not None:
        changed |= {"task": task, "tasks": (), "automaton": None}
    agent = site.scenario.agents[name].model_copy(update=changed)
    scenario = site.scenario.model_copy(update={"agents": {name: agent}})
    for finding in check_formulas(scenario):
        raise InputError(f"task: {finding.what}")
    if travel.grid.location_at(start.x_m, start.y_m) is None:
        raise PlanningError(f"the map has closed the start ({start.x_m!r}, {start.y_m!r})")
    other = replace(site.on(travel.grid.avoiding({})), scenario=scenario)
    plan = local_plan(name, other, travel)
    avoided = avoided_regions(name, other, hard_formula(agent), start)
    for region in sorted(avoided - travel.grid.avoided.keys()):
        raise PlanningError(
            f"task: it forbids region {region!r} always, and agreed ways may touch it"
        )
    return plan


def check_tasks(site: Site, method: Method = Method.TEAM) -> None:
    """Make every agent's plan, to see that there is one.

    Raises:
        PlanningError: an agent's task has no plan.
    """
    atlas = Atlas(site.grid, site.region_discs)
    for name in site.scenario.agents:
        travel = joint_travel(site, atlas) if method.goes_together else travel_of(name, site, atlas)
        local_plan(name, site, travel)
