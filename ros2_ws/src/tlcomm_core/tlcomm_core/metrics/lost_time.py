"""What an agent loses beside its own work, whatever the method of coordination.

``LostTime``   an agent's steps done, and the time that each takes alone
``lost_time``  of each agent that has done any

Agent i finishes the steps of its plan at t_{i,1} < t_{i,2} < …, standing in poses p_{i,1}, p_{i,2},
…, from p_{i,0} at t_{i,0} = 0 on. Step k alone takes

    w_{i,k} = T_i(p_{i,k−1}, π_{i,k}) + D_i(a_{i,k}),

the direct way from where step k − 1 left the agent, and the action. What it has lost by t_{i,k} is

    λ_i(k) = t_{i,k} − Σ_{l ≤ k} w_{i,l}.

No meeting strategies are needed, so this is the same for all methods: what remains is detours,
waits and meetings, moving for others' sake, actions that fail, and what noise adds.

*Where nothing fails, and the team meets by agreed strategies, each increment of λ_i is the
additional time and D_c of the one meeting between two steps, or 0.* For with a meeting after step
h, t_{h+1} − t_h = T(π^h, z) + (t_c − t_i) + D_c + T(z, π^{h+1}) + D(a^{h+1}), and w_{h+1} takes
T(π^h, π^{h+1}) + D(a^{h+1}) off: δ + (t_c − t_i) + D_c remains. The meeting at t = 0 has no detour
and no wait, and leaves D_c.
"""

from bisect import bisect_right
from collections import defaultdict
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import accumulate
from typing import Final

from tlcomm_core.agent.actions import TaskEventKind
from tlcomm_core.agent.avoidance import travel_of
from tlcomm_core.geometry import Pose, wrap_angle
from tlcomm_core.planning.transition_system import IDLE_S
from tlcomm_core.records import RunRecords
from tlcomm_core.scenario.model import Scenario
from tlcomm_core.scenario.site import Site, later_grids
from tlcomm_core.units import nanoseconds, seconds
from tlcomm_core.workspace.atlas import Atlas
from tlcomm_core.workspace.travel import HEADINGS_RAD, TravelTimes
from tlcomm_core.world.observation import Odometry
from tlcomm_core.world.unicycle import integrate

__all__ = ["LostTime", "lost_time"]

# Nearer than this to the heading in which a leg ends, the rest is the controller's business.
_YAW_TOLERANCE_RAD: Final = 0.1
_DIGITS: Final = 6


@dataclass(frozen=True, slots=True)
class LostTime:
    """What one agent did, and what that takes alone; all ascending.

    Attributes:
        finished_s: when it finished each step, t_{i,k}.
        own_work_s: what the steps up to each take alone, Σ_{l ≤ k} w_{i,l}.
        ended_s: when meetings ended that it attended, that at t = 0 among them.
    """

    finished_s: tuple[float, ...]
    own_work_s: tuple[float, ...]
    ended_s: tuple[float, ...]

    @property
    def lost_s(self) -> tuple[float, ...]:
        """What was lost by the end of each step, λ_i(k), to the microsecond.

        Less is rounding: each time of an event is the nearest nanosecond.
        """
        pairs = zip(self.finished_s, self.own_work_s, strict=True)
        # Adding 0 makes 0 of −0.
        return tuple(round(t - w, _DIGITS) + 0.0 for t, w in pairs)

    @property
    def per_meeting_s(self) -> float | None:
        """What was lost between the first and the last step per meeting that ended in between.

        ``None`` if none did.
        """
        first_s, last_s = self.finished_s[0], self.finished_s[-1]
        count = sum(first_s < time_s <= last_s for time_s in self.ended_s)
        return self._lost_after_first_s / count if count else None

    def per_window_s(self, period_s: float) -> float | None:
        """Return what was lost between the first and the last step per T_c; ``None`` for one step.

        Args:
            period_s: T_c.
        """
        span_s = self.finished_s[-1] - self.finished_s[0]
        return self._lost_after_first_s * period_s / span_s if span_s > 0.0 else None

    @property
    def _lost_after_first_s(self) -> float:
        return self.lost_s[-1] - self.lost_s[0]


def lost_time(scenario: Scenario, records: RunRecords) -> dict[str, LostTime]:
    """Return what each agent lost; without those that finished no step.

    Nor those of which a step's direct way isn't known, since no map of the scenario that held
    between the two steps has it. T_i is reckoned without what controllers lose.

    Cost: a search on the map per place of work, motion and map.
    """
    logs = _logs(scenario, records)
    if not any(log.steps for log in logs.values()):
        return {}
    site = Site.from_scenario(scenario)
    atlases = _atlases(site)
    found = {}
    for name, log in logs.items():
        own_s = _own_work_s(log, name, site, atlases)
        if own_s:
            finished_s = tuple(seconds(step.finished_ns) for step in log.steps)
            found[name] = LostTime(finished_s, own_s, tuple(log.ended_s))
    return found


@dataclass(frozen=True, slots=True)
class _Step:
    """A step done: when, and how long its action took; ``None`` for a visit."""

    finished_ns: int
    action_s: float | None


@dataclass(frozen=True, slots=True)
class _Log:
    """What an agent did, and where it was."""

    steps: list[_Step]
    ended_s: list[float]
    odometry: list[Odometry]

    def pose_at(self, time_ns: int) -> Pose | None:
        """Return where the agent was, by its last odometry until then."""
        last = bisect_right(self.odometry, time_ns, key=lambda seen: seen.stamp_ns) - 1
        if last < 0:
            return None
        seen = self.odometry[last]
        elapsed_s = seconds(time_ns - seen.stamp_ns)
        return integrate(seen.pose, seen.linear_mps, seen.angular_radps, elapsed_s)


def _logs(scenario: Scenario, records: RunRecords) -> dict[str, _Log]:
    logs = {name: _Log([], [], []) for name in scenario.agents}
    for seen in records.odometry:
        logs[seen.agent].odometry.append(seen)
    started_ns: dict[str, int] = defaultdict(int)
    for record in records.tasks:
        log, now_ns = logs[record.agent], record.stamp_ns
        match record.event.kind:
            case TaskEventKind.ACTION_STARTED:
                # Of several attempts the last: the time of those that failed is lost.
                started_ns[record.agent] = now_ns
            case TaskEventKind.ACTION_FINISHED:
                log.steps.append(_Step(now_ns, seconds(now_ns - started_ns[record.agent])))
            case TaskEventKind.REGION_VISITED:
                log.steps.append(_Step(now_ns, None))
            case TaskEventKind.MEETING_ENDED:
                log.ended_s.append(seconds(now_ns))
            case _:
                pass
    return logs


def _atlases(site: Site) -> list[tuple[int, Atlas]]:
    """Return the maps of the scenario, each with the time (ns) from which it holds."""
    first = Atlas(site.grid, site.region_discs)
    workspace = site.scenario.workspace
    changed = zip(workspace.changes, later_grids(workspace), strict=True)
    return [(0, first), *((nanoseconds(own.at_s), first.on(grid.free)) for own, grid in changed)]


def _own_work_s(
    log: _Log, name: str, site: Site, atlases: Sequence[tuple[int, Atlas]]
) -> tuple[float, ...] | None:
    """Return what an agent's steps up to each take alone; ``None`` if that isn't known."""
    if not log.steps:
        return ()
    ways = [(from_ns, travel_of(name, site, atlas)) for from_ns, atlas in atlases]
    tolerance_m = site.scenario.drive_of(name).position_tolerance_m
    before_ns, pose = 0, log.pose_at(0)
    works_s = []
    for step in log.steps:
        there = log.pose_at(step.finished_ns)
        if pose is None or there is None:
            return None
        drive_s = _direct_s(
            pose, there, _maps_between(ways, before_ns, step.finished_ns), tolerance_m
        )
        if drive_s is None:
            return None
        works_s.append(drive_s + _stay_s(step, drive_s))
        before_ns, pose = step.finished_ns, there
    return tuple(accumulate(works_s))


def _stay_s(step: _Step, drive_s: float) -> float:
    """Return D_i: the action's time; of staying put without one, the idle time."""
    if step.action_s is not None:
        return step.action_s
    return IDLE_S if drive_s == 0.0 else 0.0


def _maps_between(
    ways: Sequence[tuple[int, TravelTimes]], from_ns: int, to_ns: int
) -> list[TravelTimes]:
    """Return travel times on the maps that held between two times."""
    first = bisect_right(ways, from_ns, key=lambda way: way[0]) - 1
    return [travel for since_ns, travel in ways[first:] if since_ns <= to_ns]


def _direct_s(
    pose: Pose, there: Pose, maps: Sequence[TravelTimes], tolerance_m: float
) -> float | None:
    """Return the time of the direct way on the first map that has one; ``None`` without any."""
    for travel in maps:
        target = travel.grid.location_at(there.x_m, there.y_m)
        if target is not None and travel.grid.leads(pose.x_m, pose.y_m, target):
            return travel.leg_to(_settled(pose, travel, tolerance_m), target).duration_s
    return None


def _settled(pose: Pose, travel: TravelTimes, tolerance_m: float) -> Pose:
    """Return the pose that an agent was to stand in: over a centre, along a lattice heading.

    The pose itself, as far as it is further from that than a controller leaves it.
    """
    location = travel.grid.location_at(pose.x_m, pose.y_m)
    assert location is not None, "ways lead out of free cells only"
    x_m, y_m = travel.grid.locations_m[location].tolist()
    if pose.distance_m(x_m, y_m) > tolerance_m:
        return pose
    off_rad = {heading: abs(wrap_angle(pose.yaw_rad - heading)) for heading in HEADINGS_RAD}
    nearest_rad = min(off_rad, key=lambda heading: off_rad[heading])
    is_near = off_rad[nearest_rad] <= _YAW_TOLERANCE_RAD
    return Pose(x_m, y_m, nearest_rad if is_near else pose.yaw_rad)
