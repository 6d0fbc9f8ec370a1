"""One agent as a shell holds it: brain and radio, on integer nanoseconds.

``Member``          the same in one process and over ROS
``create``          a member from a scenario
``team_of``         what all its members know
``local_plan``      an agent's plan for its task
``explained_plan``  the same beside what else there is
``plan_for``        its plan for another task
``check_tasks``     whether all agents have one
"""

import math
from collections.abc import Callable
from dataclasses import replace
from typing import Final

from tlcomm_core.agent.actions import Action
from tlcomm_core.agent.avoidance import avoided_regions, hard_task, obstruction, travel_of
from tlcomm_core.agent.brain import Brain, Settings
from tlcomm_core.agent.controller import CONTROL_PERIOD_S, Pacing
from tlcomm_core.agent.events import MessageHeard, OdometryReceived, TaskChanged, TimePassed
from tlcomm_core.agent.faults import ActionFaults, fault_rng
from tlcomm_core.agent.radio import Radio
from tlcomm_core.agent.rounds import MeetingRounds
from tlcomm_core.errors import InputError, PlanningError
from tlcomm_core.geometry import Pose
from tlcomm_core.ltl import parse
from tlcomm_core.planning.explanation import Explanation, explain_plan
from tlcomm_core.planning.lasso import SUFFIX_FIRST, Objective
from tlcomm_core.planning.plan import LocalPlan
from tlcomm_core.planning.relaxation import SoftTask, soft_task
from tlcomm_core.planning.repertoire import Condition
from tlcomm_core.planning.synthesis import plan_task
from tlcomm_core.planning.transition_system import TransitionSystem, build
from tlcomm_core.protocol.actions import CountIgnored
from tlcomm_core.protocol.messages import Message
from tlcomm_core.protocol.negotiation import Phase
from tlcomm_core.protocol.team import Team
from tlcomm_core.scenario.checks import check_formulas
from tlcomm_core.scenario.site import Site
from tlcomm_core.scenario.task import task_of
from tlcomm_core.units import nanoseconds, seconds
from tlcomm_core.workspace.atlas import Atlas
from tlcomm_core.workspace.travel import TravelTimes

__all__ = [
    "Member",
    "Planner",
    "check_tasks",
    "create",
    "explained_plan",
    "local_plan",
    "plan_for",
    "team_of",
]

Planner = Callable[[str, Pose], LocalPlan]
"""Makes an agent's plan for a task (its text) from a pose; raises InputError or PlanningError."""

# What a periodic controller may lose at the end of a turn or a straight: the rest of its period
# and a late timer.
_ALLOWANCE_S: Final = {Pacing.EVENT: 0.0, Pacing.PERIODIC: 1.2 * CONTROL_PERIOD_S}

# Further off its leg than a cell, an agent is where the leg never leads. (What a late controller
# overshoots is less, and no displacement.)
_OFF_CELLS: Final = 1.0
_OFF_TOLERANCES: Final = 5.0


class Member:
    """One agent: what its radio lets through and its odometry reach its brain, at given times."""

    def __init__(self, name: str, brain: Brain, radio: Radio, planner: Planner) -> None:
        """Join a brain and a radio, with what makes plans for other tasks."""
        self.name: Final = name
        self._brain = brain
        self._radio = radio
        self._planner = planner
        self._odometry: list[OdometryReceived] = []
        self._next_need_ns: int | None = None

    @property
    def next_need_ns(self) -> int | None:
        """When, after the last step, the next one is needed at the latest; ``None`` if never."""
        return self._next_need_ns

    @property
    def meetings_ended(self) -> int:
        """How many meetings have ended; that of round 0 is the first."""
        return self._brain.meetings_ended

    @property
    def awaited(self) -> str | None:
        """A member without whose word a meeting can't go on; ``None`` if anyone's may matter."""
        return self._brain.awaited

    @property
    def phase(self) -> Phase | None:
        """Where planning the next round stands; ``None`` when not at a meeting."""
        return self._brain.phase

    def see_odometry(
        self, stamp_ns: int, pose: Pose, linear_mps: float, angular_radps: float
    ) -> None:
        """Take an odometry; the next step makes use of it."""
        self._odometry.append(OdometryReceived(seconds(stamp_ns), pose, linear_mps, angular_radps))

    def see_neighbours(self, stamp_ns: int, neighbours: frozenset[str]) -> None:
        """Note who is in range from ``stamp_ns`` on."""
        self._radio.see_neighbours(stamp_ns, neighbours)

    def receive(self, message: Message, sent_ns: int) -> None:
        """Take a message off the air; the radio decides whether the brain hears it."""
        self._radio.receive(message, sent_ns)

    def change_task(self, task: str, now_ns: int) -> LocalPlan:
        """Plan for another task, to be begun at the next meeting; return the plan.

        The old task goes on until then, or for good if there is no plan. Of several changes before
        one meeting the last counts.

        Raises:
            InputError: the task isn't a formula over the agent's regions and actions.
            PlanningError: there is no plan, or it isn't agreed yet where the next meeting is.
        """
        start = self._brain.next_start
        if start is None:
            raise PlanningError("the next meeting isn't agreed on yet: ask again when it is")
        plan = self._planner(task, start)
        self._brain.handle(TaskChanged(task, plan), seconds(now_ns))
        return plan

    def step(self, now_ns: int) -> tuple[Action, ...]:
        """Do all that is due by now.

        Raises:
            InfeasibleRoundError: the team has no admissible next meeting.
        """
        now_s = seconds(now_ns)
        actions: list[Action] = []
        odometry, self._odometry = self._odometry, []
        for event in odometry:
            actions += self._brain.handle(event, now_s)
        before = self._radio.out_of_range
        for message in self._radio.heard(now_ns):
            actions += self._brain.handle(MessageHeard(message), now_s)
        actions += [CountIgnored("out of range")] * (self._radio.out_of_range - before)
        actions += self._brain.handle(TimePassed(), now_s)
        need_s = self._brain.next_need_s
        # Rounding must not ask for the instant that just was.
        self._next_need_ns = None if need_s == math.inf else max(nanoseconds(need_s), now_ns + 1)
        return tuple(actions)


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
    system, soft = _system(name, site, travel), _soft_task(name, site)
    agent = site.scenario.agents[name]
    task = task_of(agent)
    try:
        return plan_task(task, system, objective, soft)
    except PlanningError as error:
        blocked = obstruction(site, system.states[0].location, hard_task(name, site), travel)
        reason = f"{error}; {blocked}" if blocked else f"{error}"
        place = "tasks" if agent.tasks else "task" if agent.automaton is None else "automaton"
        raise type(error)(f"agents.{name}.{place}: {reason}") from error


def explained_plan(
    name: str, site: Site, travel: TravelTimes, objective: Objective = SUFFIX_FIRST
) -> Explanation:
    """Return an agent's optimal local plan beside the best ones without a part of it.

    Args:
        name: of an agent that has a plan.
        site: the scenario.
        travel: as for ``local_plan``.
        objective: as for ``local_plan``.
    """
    system, soft = _system(name, site, travel), _soft_task(name, site)
    return explain_plan(task_of(site.scenario.agents[name]), system, objective, soft)


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


def plan_for(task: str, start: Pose, name: str, site: Site, travel: TravelTimes) -> LocalPlan:
    """Return an agent's plan for another task than the scenario's, from another start.

    The task takes the place of all the agent's hard ones; its soft one stays.

    Raises:
        InputError: the task isn't a formula over the scenario's regions and the agent's actions.
        PlanningError: there is no plan.
    """
    pose = (start.x_m, start.y_m, start.yaw_rad)
    changed = {"task": task, "tasks": (), "automaton": None, "start": pose}
    agent = site.scenario.agents[name].model_copy(update=changed)
    scenario = site.scenario.model_copy(update={"agents": {name: agent}})
    for finding in check_formulas(scenario):
        raise InputError(f"task: {finding.what}")
    other = replace(site, scenario=scenario)
    plan = local_plan(name, other, travel)
    avoided = avoided_regions(name, other, hard_task(name, other), start)
    for region in sorted(avoided - travel.grid.avoided.keys()):
        raise PlanningError(
            f"task: it forbids region {region!r} always, and agreed ways may touch it"
        )
    return plan


def check_tasks(site: Site) -> None:
    """Make every agent's plan, to see that there is one.

    Raises:
        PlanningError: an agent's task has no plan.
    """
    atlas = Atlas(site.grid, site.region_discs)
    for name in site.scenario.agents:
        local_plan(name, site, travel_of(name, site, atlas))


def team_of(site: Site) -> Team:
    """Return what every member of the scenario's team knows of it."""
    communication = site.scenario.communication
    return Team(
        members=frozenset(site.scenario.agents),
        planned_range_m=site.planned_range_m,
        period_s=communication.period_s,
        duration_s=communication.duration_s,
    )


def create(name: str, site: Site, pacing: Pacing, atlas: Atlas, seed: int = 0) -> Member:
    """Return a member of the scenario's team, with its local plan made.

    Args:
        name: the agent's name.
        site: the scenario.
        pacing: how often its controller is asked.
        atlas: travel times on the scenario's grid and round its regions; members in one
            process may share it.
        seed: of what befalls it, the run's.

    Raises:
        PlanningError: the agent's task has no plan.
    """
    scenario = site.scenario
    allowance_s = _ALLOWANCE_S[pacing]
    tolerance_m = scenario.drive_of(name).position_tolerance_m
    travel = travel_of(name, site, atlas, allowance_s)
    team = team_of(site)
    # Members' plans lead through regions: with this done, the first round takes no longer than
    # later ones.
    travel.prepare(site.region_location.values())
    brain = Brain(
        Settings(
            name=name,
            plan=local_plan(name, site, travel),
            travel=travel,
            team=team,
            rounds=MeetingRounds(atlas, team, allowance_s),
            position_tolerance_m=tolerance_m,
            most_deviation_m=max(_OFF_CELLS * site.grid.cell_m, _OFF_TOLERANCES * tolerance_m),
            pacing=pacing,
            faults=ActionFaults(scenario.faults.action_failure, fault_rng(seed, name)),
            retries=scenario.faults.retries,
        )
    )
    # Free running, a message is heard when it comes; in lock step, one hop's latency after.
    latency_s = scenario.communication.hop_latency_s if pacing is Pacing.EVENT else 0.0
    radio = Radio(nanoseconds(latency_s))
    return Member(name, brain, radio, lambda task, start: plan_for(task, start, name, site, travel))
