"""One agent as a shell holds it: brain, radio and estimate, on integer nanoseconds.

``Member``       the same in one process and over ROS
``create``       a member from a scenario
``team_of``      what all its members know
``check_start``  whether they can begin where they start
"""

import math
from collections.abc import Mapping
from dataclasses import replace
from typing import Final

import numpy as np
from numpy.typing import NDArray

from tlcomm_core.agent.actions import Action, CountIgnored
from tlcomm_core.agent.approach import check_approaches
from tlcomm_core.agent.avoidance import joint_travel, travel_of
from tlcomm_core.agent.brain import Brain
from tlcomm_core.agent.channel import Channel
from tlcomm_core.agent.charts import Charts
from tlcomm_core.agent.controller import CONTROL_PERIOD_S, Pacing
from tlcomm_core.agent.estimator import Estimator, create_estimator
from tlcomm_core.agent.events import (
    MapChanged,
    MessageHeard,
    OdometryReceived,
    TaskChanged,
    TimePassed,
)
from tlcomm_core.agent.faults import ActionFaults, fault_rng
from tlcomm_core.agent.methods import brain_for, rounds_for, rules_for
from tlcomm_core.agent.planner import Planner, local_plan, plan_for
from tlcomm_core.agent.radio import OUT_OF_RANGE, UNSEEN, Heard, Radio
from tlcomm_core.agent.settings import Settings
from tlcomm_core.errors import PlanningError
from tlcomm_core.game.solver import DEFAULT, Solver
from tlcomm_core.geometry import Pose
from tlcomm_core.method import Method
from tlcomm_core.planning.plan import LocalPlan
from tlcomm_core.protocol.messages import EstimateExchange, TeamMessage
from tlcomm_core.protocol.negotiation import Phase
from tlcomm_core.protocol.reception import Reception
from tlcomm_core.protocol.team import OnInfeasible, Team
from tlcomm_core.protocol.turns import TurnTeam, pause_s
from tlcomm_core.scenario.site import Site
from tlcomm_core.units import nanoseconds, seconds
from tlcomm_core.workspace.atlas import Atlas
from tlcomm_core.workspace.travel import TravelTimes

__all__ = ["Member", "check_start", "create", "team_of"]

# What a periodic controller may lose at the end of a turn or a straight: the rest of its period
# and a late timer.
_ALLOWANCE_S: Final = {Pacing.EVENT: 0.0, Pacing.PERIODIC: 1.2 * CONTROL_PERIOD_S}

# Running freely, an agent may learn late who is in range. It is told at least once a second, and
# what it knows when it hears a message may be as old as that.
_LAG_NS: Final = {Pacing.EVENT: None, Pacing.PERIODIC: 1_000_000_000}

# Further off its leg than a cell, an agent is where the leg never leads. (What a late controller
# overshoots is less, and no displacement.)
_OFF_CELLS: Final = 1.0
_OFF_TOLERANCES: Final = 5.0


class Member:
    """One agent: what its radio lets through and its odometry reach its brain, at given times.

    What neighbours say of the field reaches its estimator, and no brain.
    """

    def __init__(
        self,
        name: str,
        brain: Brain,
        radio: Radio,
        planner: Planner,
        charts: Charts,
        estimator: Estimator | None = None,
    ) -> None:
        """Join a brain and a radio, with what makes plans for other tasks, and the maps.

        Without an ``estimator`` nothing is measured.
        """
        self.name: Final = name
        self._brain = brain
        self._radio = radio
        self._planner = planner
        self._charts = charts
        self._estimator = estimator
        self._measured_at = ""
        self._heard: tuple[Heard, ...] = ()
        self._brain_need_ns: int | None = 0
        self._odometry: list[OdometryReceived] = []
        self._maps: list[MapChanged] = []
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

    @property
    def measured_at(self) -> str:
        """The region in which the last step ended the action that reads the field, or ""."""
        return self._measured_at

    @property
    def heard(self) -> tuple[Heard, ...]:
        """What the radio let through to the last step, in that order."""
        return self._heard

    @property
    def undelivered(self) -> Mapping[str, int]:
        """How many messages of others the radio hasn't let through, by reason."""
        return self._radio.undelivered

    def see_odometry(
        self, stamp_ns: int, pose: Pose, linear_mps: float, angular_radps: float
    ) -> None:
        """Take an odometry; the next step makes use of it."""
        self._odometry.append(OdometryReceived(seconds(stamp_ns), pose, linear_mps, angular_radps))

    def see_map(self, stamp_ns: int, free: NDArray[np.bool_]) -> None:
        """Take a map; the next step makes use of it, if it is later than those before.

        Args:
            stamp_ns: from when on it holds.
            free: which cells are free, bool[rows, columns], as on the scenario's map.
        """
        if self._charts.take(stamp_ns, free):
            travel = self._brain.travel
            now = self._charts.latest.travel(travel.motion, frozenset(travel.grid.avoided))
            self._maps.append(MapChanged(stamp_ns, now))

    def see_neighbours(self, stamp_ns: int, distances_m: Mapping[str, float]) -> None:
        """Note who is in range from ``stamp_ns`` on, and how far away."""
        self._radio.see_neighbours(stamp_ns, distances_m)
        if self._estimator is not None:
            self._estimator.see_neighbours(stamp_ns, distances_m)

    def see_reading(self, stamp_ns: int, value: float) -> None:
        """Take what the agent measured; the next step makes use of it."""
        if self._estimator is not None:
            self._estimator.read(value, stamp_ns)

    def receive(self, message: TeamMessage, said_ns: int, taken_ns: int | None = None) -> None:
        """Take a message off the air; the radio decides whether the brain hears it.

        Args:
            message: what was said.
            said_ns: when, by the sender's clock.
            taken_ns: when it was taken, if clocks may differ.
        """
        self._radio.receive(message, said_ns, taken_ns)

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
        travel = self._brain.travel
        plan = self._planner(task, start, travel)
        self._brain.handle(TaskChanged(task, plan, travel.grid), seconds(now_ns))
        return plan

    def step(self, now_ns: int) -> tuple[Action, ...]:
        """Do all that is due by now.

        Raises:
            InfeasibleRoundError: the team has no admissible next meeting.
        """
        now_s = seconds(now_ns)
        actions: list[Action] = []
        # Odometry first, whichever came first: from where a new map finds the agent, it goes on.
        odometry, self._odometry = self._odometry, []
        maps, self._maps = self._maps, []
        seen: list[OdometryReceived | MapChanged] = [*odometry, *maps]
        for event in seen:
            actions += self._brain.handle(event, now_s)
        is_told = bool(seen)
        self._heard = tuple(self._radio.heard(now_ns))
        for own in self._heard:
            if isinstance(own.message, EstimateExchange):
                actions += self._hear_estimate(own.message, now_ns)
            else:
                is_told = True
                actions += self._brain.handle(MessageHeard(own.message), now_s)
        if is_told or (self._brain_need_ns is not None and now_ns >= self._brain_need_ns):
            actions += self._proceed(now_ns, now_s)
        if self._estimator is not None:
            self._measured_at = self._estimator.measured_at(actions)
            actions += self._estimator.proceed(now_ns)
        self._next_need_ns = self._needed_ns()
        return tuple(actions)

    def _hear_estimate(self, word: EstimateExchange, now_ns: int) -> tuple[Action, ...]:
        if self._estimator is None:
            return (CountIgnored(Reception.UNNEEDED.value),)
        return self._estimator.hear(word, now_ns)

    def _proceed(self, now_ns: int, now_s: float) -> tuple[Action, ...]:
        """Let the brain do what is due."""
        meetings = self._brain.meetings_ended
        actions = self._brain.handle(TimePassed(), now_s)
        if self._brain.meetings_ended != meetings:
            self._charts.forget()
        need_s = self._brain.next_need_s
        # Rounding must not ask for the instant that just was.
        self._brain_need_ns = None if need_s == math.inf else max(nanoseconds(need_s), now_ns + 1)
        return actions

    def _needed_ns(self) -> int | None:
        """Return when brain or estimator want to be called again, or a message is heard."""
        estimate_ns = None if self._estimator is None else self._estimator.next_need_ns
        needs_ns = (self._brain_need_ns, self._radio.next_due_ns, estimate_ns)
        return min((time_ns for time_ns in needs_ns if time_ns is not None), default=None)


def team_of(site: Site, solver: Solver = DEFAULT, method: Method = Method.TEAM) -> Team:
    """Return what every member of the scenario's team knows of it."""
    communication = site.scenario.communication
    kind = TurnTeam if method.goes_together else Team
    team = kind(
        members=frozenset(site.scenario.agents),
        planned_range_m=site.planned_range_m,
        period_s=communication.period_s,
        duration_s=communication.duration_s,
        rules=rules_for(method, communication),
        margin_s=communication.margin_s,
        on_infeasible=OnInfeasible(communication.on_infeasible),
        clearance_m=site.planned_clearance_m,
        solver=method.solver(solver),
    )
    if not isinstance(team, TurnTeam):
        return team
    radio, latency_s = site.scenario.radio, communication.hop_latency_s
    return replace(
        team,
        duration_s=pause_s(team, latency_s, radio.jitter_s, radio.loss),
        off_m=site.scenario.position_tolerance_m,
    )


def check_start(site: Site, method: Method) -> None:
    """See whether a method can begin where the agents start.

    Raises:
        PlanningError: a team that stays together can't come together.
    """
    if method.goes_together:
        travel = joint_travel(site, Atlas(site.grid, site.region_discs))
        check_approaches(site.scenario, team_of(site, method=method), travel)


def create(
    name: str,
    site: Site,
    pacing: Pacing,
    atlas: Atlas,
    seed: int = 0,
    solver: Solver = DEFAULT,
    method: Method = Method.TEAM,
) -> Member:
    """Return a member of the scenario's team, with its local plan made.

    Args:
        name: the agent's name.
        site: the scenario.
        pacing: how often its controller is asked.
        atlas: travel times on the scenario's grid and round its regions; members in one
            process may share it.
        seed: of what befalls it, the run's.
        solver: how its team finds the next meetings, where the method leaves the choice.
        method: of coordination.

    Raises:
        PlanningError: the agent's task has no plan.
    """
    scenario = site.scenario
    allowance_s = _ALLOWANCE_S[pacing]
    tolerance_m = scenario.drive_of(name).position_tolerance_m
    team = team_of(site, solver, method)
    if method.goes_together:
        travel = joint_travel(site, atlas, allowance_s)
        check_approaches(scenario, team, travel)
    else:
        travel = travel_of(name, site, atlas, allowance_s)
    # Members' plans lead through regions: with this done, the first round takes no longer than
    # later ones.
    travel.prepare(site.region_location.values())
    charts = Charts(atlas)

    def planner(task: str | None, start: Pose, now: TravelTimes) -> LocalPlan:
        return plan_for(task, start, name, site, now)

    brain = brain_for(
        method,
        Settings(
            name=name,
            plan=local_plan(name, site, travel),
            travel=travel,
            team=team,
            planner=planner,
            rounds=rounds_for(team, charts, allowance_s),
            position_tolerance_m=tolerance_m,
            most_deviation_m=max(_OFF_CELLS * site.grid.cell_m, _OFF_TOLERANCES * tolerance_m),
            pacing=pacing,
            faults=ActionFaults(scenario.faults.action_failure, fault_rng(seed, name)),
            retries=scenario.faults.retries,
        ),
        site,
    )
    # Free running, a message is heard when it comes; in lock step, one hop's latency after.
    latency_s = scenario.communication.hop_latency_s if pacing is Pacing.EVENT else 0.0
    channel = Channel(scenario.radio, scenario.communication.range_m, seed, name)
    unlinked = UNSEEN if scenario.radio.line_of_sight else OUT_OF_RANGE
    radio = Radio(nanoseconds(latency_s), channel, unlinked, _LAG_NS[pacing])
    # Whose method is not to meet doesn't talk by chance either.
    partners = () if method is Method.NONE else scenario.agents
    estimator = create_estimator(name, scenario, partners)
    return Member(name, brain, radio, planner, charts, estimator)
