"""Driving that never touches what an agent's task forbids for ever.

``avoided_regions``  the regions that an agent keeps out of
``travel_of``        its travel times, keeping out of them
``joint_travel``     those of a team that goes together
``obstruction``      what that makes impossible
"""

from tlcomm_core.errors import PlanningError
from tlcomm_core.geometry import Pose
from tlcomm_core.ltl import Formula, atoms, forbidden
from tlcomm_core.scenario.site import Site
from tlcomm_core.scenario.task import hard_formula, task_field
from tlcomm_core.workspace.atlas import Atlas
from tlcomm_core.workspace.travel import Motion, TravelTimes

__all__ = ["avoided_regions", "joint_travel", "obstruction", "travel_of"]


def avoided_regions(name: str, site: Site, task: Formula, start: Pose) -> frozenset[str]:
    """Return the regions in which an agent never satisfies its task, whatever it does there.

    Args:
        name: the agent's name.
        site: the scenario.
        task: the agent's task.
        start: where it begins with it.

    Raises:
        PlanningError: the agent starts in a cell that such a region touches.
    """
    actions = site.action_durations(name).keys()
    beside = {region: actions | others for region, others in site.regions_beside.items()}
    avoided = forbidden(task, beside)
    _check_start(site, avoided, start, "is forbidden always")
    return avoided


def travel_of(name: str, site: Site, atlas: Atlas, segment_allowance_s: float = 0.0) -> TravelTimes:
    """Return an agent's travel times for its tasks, keeping out of what these forbid always.

    Raises:
        PlanningError: the agent starts in such a region.
    """
    motion = site.motion_of(name, segment_allowance_s)
    return atlas.travel(motion, _avoided_by(name, site))


def joint_travel(site: Site, atlas: Atlas, segment_allowance_s: float = 0.0) -> TravelTimes:
    """Return the travel times of a team that goes together.

    It is as slow as its slowest members, and keeps out of what any of its tasks forbids always.

    Raises:
        PlanningError: an agent starts in such a region.
    """
    names = site.scenario.agents
    motions = [site.motion_of(name) for name in names]
    avoided = frozenset[str]().union(*(_avoided_by(name, site) for name in names))
    for name in names:
        try:
            _check_start(
                site,
                avoided,
                site.start_of(name),
                "is forbidden always to one of a team that goes together",
            )
        except PlanningError as error:
            raise PlanningError(f"agents.{name}.start: {error}") from error
    slowest = Motion(
        min(motion.linear_mps for motion in motions),
        min(motion.angular_radps for motion in motions),
        segment_allowance_s,
    )
    return atlas.travel(slowest, avoided)


def _avoided_by(name: str, site: Site) -> frozenset[str]:
    """Return the regions that an agent of the scenario keeps out of."""
    agent = site.scenario.agents[name]
    try:
        return avoided_regions(name, site, hard_formula(agent), site.start_of(name))
    except PlanningError as error:
        raise PlanningError(f"agents.{name}.{task_field(agent)}: {error}") from error


def _check_start(site: Site, avoided: frozenset[str], start: Pose, why: str) -> None:
    home = site.grid.location_at(start.x_m, start.y_m)
    for region in sorted(avoided):
        if home in site.grid.touched_by(*site.region_discs[region]):
            raise PlanningError(
                f"region {region!r} {why}, but the start "
                f"({start.x_m!r}, {start.y_m!r}) lies in a cell that it touches; move the start"
            )


def obstruction(site: Site, start: int, task: Formula, travel: TravelTimes) -> str:
    """Return which of the regions that a task names are out of reach because of others; or "".

    Args:
        site: the scenario.
        start: the location that the agent starts at.
        task: its task.
        travel: its travel times.
    """
    free, left = site.grid.components, travel.grid.components
    named = [region for region in atoms(task) if region in site.region_location]
    lost = [
        region
        for region in named
        if region not in travel.grid.avoided
        and free[site.region_location[region]] == free[start]
        and left[site.region_location[region]] != left[start]
    ]
    if not lost:
        return ""
    around = ", ".join(map(repr, sorted(travel.grid.avoided)))
    return (
        f"{', '.join(map(repr, lost))} can't be reached without touching {around}, forbidden always"
    )
