"""What an agent's task forbids always, its whole way stays out of."""

import math
from collections.abc import Iterator
from contextlib import suppress
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from support.danger_hall import danger_hall
from tlcomm_core.agent.actions import TaskEventKind
from tlcomm_core.agent.planner import check_tasks
from tlcomm_core.errors import PlanningError
from tlcomm_core.geometry import Pose
from tlcomm_core.mission import Mission
from tlcomm_core.scenario.generator import random_scenario
from tlcomm_core.scenario.model import Agent, Scenario
from tlcomm_core.scenario.site import Site
from tlcomm_core.simulation import Simulated, simulate
from tlcomm_core.workspace.atlas import Atlas
from tlcomm_core.workspace.grid import Grid
from tlcomm_core.workspace.travel import HEADINGS_RAD, Motion
from tlcomm_tools.audit.tracks import build_tracks
from tlcomm_tools.audit.trespass import audit_trespass, forbidden_regions

SLACK_M = 1e-6
MOTION = Motion(1.0, 1.5)
Point = tuple[float, float]


def distance_m(point: Point, start: Point, end: Point) -> float:
    """Return how near a straight comes to a point."""
    step = (end[0] - start[0], end[1] - start[1])
    square = step[0] ** 2 + step[1] ** 2
    along = (point[0] - start[0]) * step[0] + (point[1] - start[1]) * step[1]
    share = min(max(along / square, 0.0), 1.0) if square else 0.0
    return math.dist(point, (start[0] + share * step[0], start[1] + share * step[1]))


@settings(max_examples=200, deadline=None)
@given(st.data())
def test_no_leg_enters_a_disc_that_is_avoided(data: st.DataObject) -> None:
    """Any disc, from any free pose to any location: both kinds of leg stay outside."""
    columns, rows = data.draw(st.integers(3, 9)), data.draw(st.integers(3, 9))
    boxes = data.draw(st.lists(st.tuples(st.integers(0, columns - 1), st.integers(0, rows - 1))))
    walls = [(0.5 * x, 0.5 * y, 0.5 * x + 0.5, 0.5 * y + 0.5) for x, y in boxes[:6]]
    grid = Grid((0.5 * columns, 0.5 * rows), 0.5, walls)
    middle = (
        data.draw(st.floats(0.0, 0.5 * columns, allow_subnormal=False)),
        data.draw(st.floats(0.0, 0.5 * rows, allow_subnormal=False)),
    )
    radius_m = data.draw(st.one_of(st.sampled_from([0.25, 0.5]), st.floats(0.01, 2.0)))
    cells = grid.touched_by(*middle, radius_m)
    travel = Atlas(grid, {"danger": (*middle, radius_m)}).travel(MOTION, frozenset({"danger"}))
    free = np.setdiff1d(np.arange(len(grid)), cells)
    assume(len(free) > 1)
    start, target = data.draw(st.tuples(*[st.sampled_from(free.tolist())] * 2))
    x_m, y_m = grid.locations_m[start].tolist()
    shift_m = data.draw(st.sampled_from([0.0, 0.1, -0.24]))
    pose = Pose(x_m + shift_m, y_m - shift_m, data.draw(st.sampled_from(HEADINGS_RAD)))
    assume(math.isfinite(travel.reach(pose).time_s[target]))
    for leg in (travel.leg_to(pose, target), travel.leg_from(pose, target)):
        for one, other in pairwise([(pose.x_m, pose.y_m), *leg.waypoints_m]):
            assert distance_m(middle, one, other) >= radius_m - SLACK_M
    assert np.isinf(travel.reach(pose).time_s[cells]).all()


def simulated(scenario: Scenario, rounds: int = 4) -> Simulated:
    """Return a run in lock step."""
    return simulate(Mission(Site.from_scenario(scenario), 0, rounds, 400.0))


def depths_m(scenario: Scenario, run: Simulated, agent: str) -> Iterator[float]:
    """Yield how deep in the danger each straight between two odometries leads."""
    danger = scenario.workspace.regions["danger"]
    points = [(own.pose.x_m, own.pose.y_m) for own in run.records.odometry if own.agent == agent]
    for one, other in pairwise(points):
        yield danger.radius_m - distance_m(danger.at_m, one, other)


@pytest.fixture(scope="module")
def run() -> Simulated:
    """Return a run in which one of two agents avoids the danger."""
    return simulated(danger_hall())


def test_a_whole_run_stays_out_of_the_danger(run: Simulated) -> None:
    """On the way to regions and to meetings; who doesn't mind drives straight through."""
    scenario = danger_hall()
    assert max(depths_m(scenario, run, "careful")) <= SLACK_M
    assert max(depths_m(scenario, run, "bold")) > 0.3


def test_the_team_still_meets(run: Simulated) -> None:
    """Both agree on every round though they don't drive alike, and are there when they said."""
    ended = [own for own in run.records.tasks if own.event.kind is TaskEventKind.MEETING_ENDED]
    assert len(ended) == 2 * 5
    late_s = [
        abs(float(own.event.detail.rpartition("=")[2]))
        for own in run.records.tasks
        if own.event.kind is TaskEventKind.MEETING_REACHED and own.event.round > 0
    ]
    assert late_s
    assert max(late_s) < 1e-3


def test_a_meeting_place_is_never_in_the_danger(run: Simulated) -> None:
    """Neither where an agent goes nor anything else of the strategies held."""
    site = Site.from_scenario(danger_hall())
    cells = site.grid.touched_by(*site.region_discs["danger"]).tolist()
    places = [
        site.grid.location_at(own.x_m, own.y_m)
        for record in run.records.strategies
        for own in record.strategy.strategies
        if own.agent == "careful"
    ]
    assert places
    assert not set(places) & set(cells)


@pytest.mark.parametrize("seed", range(4))
def test_members_that_avoid_different_regions_meet_and_stay_out(seed: int) -> None:
    """In random workspaces, each agent forbidden what it needn't visit and doesn't start in."""
    scenario = guarded_scenario(seed)
    run = simulated(scenario, rounds=3)
    ended = [own for own in run.records.tasks if own.event.kind is TaskEventKind.MEETING_ENDED]
    assert len(ended) == 4 * len(scenario.agents)
    end_s = run.sim_ns * 1e-9
    tracks, _ = build_tracks(run.records.odometry, tuple(scenario.agents), end_s)
    watched = sum(len(forbidden_regions(scenario, track.agent)) for track in tracks)
    assert watched >= len(scenario.agents)
    assert [line for own in tracks for line in audit_trespass(scenario, own.agent, own)] == []


def guarded_scenario(seed: int) -> Scenario:
    """Return a random scenario in which each agent's task forbids up to two regions."""
    scenario = random_scenario(np.random.default_rng(seed), 4, regions=9)
    agents = {}
    for name, agent in scenario.agents.items():
        own, whole = agent, agent.whole_task
        for region in sorted(scenario.workspace.regions, reverse=True):
            task = f"G !{region} & {whole}"
            with suppress(PlanningError):
                trial = own.model_copy(update={"task": task})
                check_tasks(alone(scenario, name, trial))
                own, whole = trial, task
            if whole.count("!") == 2:
                break
        agents[name] = own
    return scenario.model_copy(update={"agents": agents})


def alone(scenario: Scenario, name: str, agent: Agent) -> Site:
    """Return the site of one agent alone."""
    return Site.from_scenario(scenario.model_copy(update={"agents": {name: agent}}))
