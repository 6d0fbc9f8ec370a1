"""Driving round what a task forbids."""

import pytest

from support.danger_hall import danger_hall
from tlcomm_core.agent.avoidance import avoided_regions, joint_travel, travel_of
from tlcomm_core.agent.planner import check_tasks, local_plan
from tlcomm_core.errors import PlanningError, UnreachableTaskError
from tlcomm_core.ltl import parse
from tlcomm_core.method import Method
from tlcomm_core.scenario.model import DriveOverride, Region, Scenario
from tlcomm_core.scenario.site import Site
from tlcomm_core.workspace.atlas import Atlas
from tlcomm_core.workspace.travel import Motion
from tlcomm_tools.audit.trespass import forbidden_regions


def site_with(task: str, **regions: Region) -> Site:
    """Return the hall with another task for ``careful`` and further or other regions."""
    scenario = danger_hall()
    careful = scenario.agents["careful"].model_copy(update={"task": task})
    workspace = scenario.workspace.model_copy(
        update={"regions": scenario.workspace.regions | regions}
    )
    update = {"agents": scenario.agents | {"careful": careful}, "workspace": workspace}
    return Site.from_scenario(scenario.model_copy(update=update))


def avoided_of(site: Site, task: str) -> frozenset[str]:
    """Return what ``careful`` would avoid for a task."""
    return avoided_regions("careful", site, parse(task), site.start_of("careful"))


@pytest.mark.parametrize(
    ("task", "avoided"),
    [
        ("G !danger & G F west", {"danger"}),
        ("G F west", set()),
        ("G (danger -> load) & G F west", set()),
        ("G (danger -> F west)", set()),
        ("G !(danger & load)", set()),
        ("G (west | !danger)", {"danger"}),
    ],
)
def test_what_the_task_forbids_always_is_avoided(task: str, avoided: set[str]) -> None:
    """Not what it forbids without an action, with one, or until something happens."""
    assert avoided_of(Site.from_scenario(danger_hall()), task) == avoided


def test_a_region_that_is_allowed_inside_another_stays_open() -> None:
    """Where the danger overlaps a shelter one may be in it."""
    task = "G (danger -> shelter) & G F shelter"
    shelter = Region(at_m=(4.25, 2.75), radius_m=0.3)
    site = site_with(task, shelter=shelter)
    assert avoided_of(site, task) == set()
    check_tasks(site)


def test_travel_times_are_those_round_the_forbidden_cells() -> None:
    """The way is longer than for who doesn't mind, and its plan takes the longer time."""
    site = Site.from_scenario(danger_hall())
    atlas = Atlas(site.grid, site.region_discs)
    careful, bold = (travel_of(name, site, atlas) for name in ("careful", "bold"))
    east, west = (site.region_location[name] for name in ("east", "west"))
    assert careful.time_to(east)[west].min() > bold.time_to(east)[west].min() + 0.5
    assert careful is travel_of("careful", site, atlas)
    plan = local_plan("careful", site, careful)
    assert plan.suffix_s > local_plan("bold", site, bold).suffix_s + 1.0


def test_a_start_that_the_danger_touches_is_refused() -> None:
    """The region, the start and what to do are named."""
    danger = Region(at_m=(2.75, 1.6), radius_m=0.5)
    site = site_with("G !danger & G F west", danger=danger)
    with pytest.raises(PlanningError, match=r"agents\.careful\.task: region 'danger' .* start \(2"):
        check_tasks(site)


@pytest.mark.parametrize(
    ("east", "task"),
    [
        (Region(at_m=(4.3, 3.3), radius_m=0.08), "G !danger & G F east"),
        (Region(at_m=(3.75, 2.75), radius_m=0.3), "G !danger & G F (east & load)"),
    ],
)
def test_a_region_that_the_task_needs_and_forbids_is_named(east: Region, task: str) -> None:
    """Both the region that is wanted and the one that is in the way."""
    with pytest.raises(
        UnreachableTaskError, match="'east' can't be reached without touching 'danger'"
    ):
        check_tasks(site_with(task, east=east))


def test_a_region_that_the_task_may_do_without_is_no_mistake() -> None:
    """West or east: east lies in the danger, so west it is."""
    east = Region(at_m=(3.75, 2.75), radius_m=0.3)
    check_tasks(site_with("G !danger & G F (east | west)", east=east))


def test_the_hall_is_what_it_says() -> None:
    """Both agents have a plan."""
    scenario: Scenario = danger_hall()
    check_tasks(Site.from_scenario(scenario))


def test_any_of_several_tasks_may_forbid() -> None:
    """What one of them forbids is avoided, and told from the poses too."""
    scenario = danger_hall("G F west")
    careful = scenario.agents["careful"].model_copy(update={"tasks": ("G !danger",)})
    agents = scenario.agents | {"careful": careful}
    site = Site.from_scenario(scenario.model_copy(update={"agents": agents}))
    travel = travel_of("careful", site, Atlas(site.grid, site.region_discs))
    assert travel.grid.avoided.keys() == {"danger"}
    assert forbidden_regions(site.scenario, "careful") == ["danger"]


def test_a_team_that_goes_together_keeps_out_of_what_any_forbids() -> None:
    """It drives as its slowest members do, on one and the same travel times."""
    scenario = danger_hall()
    slow = scenario.agents["bold"].model_copy(
        update={"motion": DriveOverride(linear_mps=0.3, angular_radps=9.0)}
    )
    agents = scenario.agents | {"bold": slow}
    site = Site.from_scenario(scenario.model_copy(update={"agents": agents}))
    atlas = Atlas(site.grid, site.region_discs)
    travel = joint_travel(site, atlas)
    careful = travel_of("careful", site, atlas)
    assert travel.grid.avoided.keys() == {"danger"}
    assert travel.motion == Motion(0.3, careful.motion.angular_radps)
    check_tasks(site, Method.ALL_TIME)


def test_a_team_that_goes_together_starts_where_all_may_be() -> None:
    """The message names who starts where another mustn't be."""
    scenario = danger_hall()
    x_m, y_m = scenario.workspace.regions["danger"].at_m
    bold = scenario.agents["bold"].model_copy(update={"start": (x_m, y_m, 0.0)})
    site = Site.from_scenario(
        scenario.model_copy(update={"agents": scenario.agents | {"bold": bold}})
    )
    with pytest.raises(PlanningError, match=r"agents\.bold\.start: region 'danger' is forbidden"):
        joint_travel(site, Atlas(site.grid, site.region_discs))
