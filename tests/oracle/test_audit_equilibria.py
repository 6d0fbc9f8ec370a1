"""The audit's own travel times and game against the agents', on random maps and teams."""

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
import pytest

from tlcomm_core.agent.charts import Charts
from tlcomm_core.agent.controller import Pacing
from tlcomm_core.agent.member import create, team_of
from tlcomm_core.agent.rounds import MeetingRounds
from tlcomm_core.game.offer import MemberOffer
from tlcomm_core.game.problem import RoundProblem
from tlcomm_core.geometry import Pose
from tlcomm_core.protocol.actions import SendMessage
from tlcomm_core.protocol.messages import PlanOffer
from tlcomm_core.scenario.generator import random_scenario
from tlcomm_core.scenario.model import Change, Radio, Region, Scenario, Workspace
from tlcomm_core.scenario.site import Site, later_grids
from tlcomm_core.units import nanoseconds
from tlcomm_core.workspace.atlas import Atlas
from tlcomm_core.workspace.travel import HEADINGS_RAD, Motion, TravelTimes
from tlcomm_tools.audit.equilibria.candidates import Ground, grounds_of
from tlcomm_tools.audit.equilibria.cells import Cells
from tlcomm_tools.audit.equilibria.finding import LATE_S
from tlcomm_tools.audit.equilibria.travel import Gait, Travel, Waypoint

RULES = (
    {},
    {"separation_m": 0.5},
    {"resilience": 1},
    {"separation_m": 0.7, "resilience": 1},
)


def random_workspace(seed: int) -> Workspace:
    """Return a small workspace whose boxes don't keep to cells, with regions to keep out of."""
    rng = np.random.default_rng(seed)
    corners = rng.uniform(0.0, 4.0, (5, 2))
    sides = rng.uniform(0.05, 1.2, (5, 2))
    boxes = np.concatenate([corners, corners + sides], axis=1).round(2).tolist()
    regions = {
        f"place_{index}": Region(at_m=(float(x_m), float(y_m)), radius_m=0.3)
        for index, (x_m, y_m) in enumerate(rng.uniform(0.0, 4.5, (2, 2)))
    }
    origin_m = (-1.0, 0.5) if seed % 2 else (0.0, 0.0)
    return Workspace(
        size_m=(4.6, 4.0),
        cell_m=0.5 if seed % 3 else 0.4,
        origin_m=origin_m,
        obstacles_m=tuple(map(tuple, boxes)),
        regions=regions,
    )


def poses_on(cells: Cells, rng: np.random.Generator) -> Iterator[Pose]:
    """Yield poses in the middle of cells and off it, at the eight headings and between."""
    for _ in range(6):
        x_m, y_m = cells.centres_m[rng.integers(len(cells))].tolist()
        heading_rad = HEADINGS_RAD[rng.integers(8)]
        yield Pose(x_m, y_m, heading_rad)
        yield Pose(x_m, y_m, float(rng.uniform(-3.0, 3.0)))
        yield Pose(x_m + 0.1, y_m - 0.05, heading_rad)


@pytest.mark.parametrize("seed", range(8))
@pytest.mark.parametrize("late_s", [0.0, LATE_S])
def test_travel_times_are_the_same(seed: int, late_s: float) -> None:
    """From any pose to any place by way of every cell, round what is to be kept out of."""
    workspace, rng = random_workspace(seed), np.random.default_rng(seed)
    scenario = random_scenario(rng, agents=2).model_copy(update={"workspace": workspace})
    site = Site.from_scenario(scenario)
    cells = Cells(workspace, workspace.obstacles_m)
    assert np.array_equal(cells.free, site.grid.free)
    assert cells.centres_m == pytest.approx(site.grid.locations_m)
    avoided = np.zeros(len(cells), dtype=np.bool_)
    names = list(workspace.regions)[: seed % 3]
    for name in names:
        avoided |= cells.touching(workspace.regions[name])
    grid = Atlas(site.grid, site.region_discs).grid_avoiding(frozenset(names))
    theirs = TravelTimes(grid, Motion(0.8, 1.3, late_s / 2.0))
    own = Travel(cells, avoided, Gait(0.8, 1.3, late_s))
    for pose in poses_on(cells, rng):
        target = int(rng.integers(len(cells)))
        end_m = tuple(cells.centres_m[target].tolist())
        detour = own.detour(Waypoint(pose.x_m, pose.y_m, pose.yaw_rad), end_m)
        if not grid.leads(pose.x_m, pose.y_m, target):
            assert detour is None
            continue
        assert detour is not None
        expected = theirs.detour(pose, target)
        assert detour.there_s == pytest.approx(expected.there_s, abs=1e-9)
        assert detour.extra_s == pytest.approx(expected.extra_s, abs=1e-9)


@dataclass(frozen=True)
class Posed:
    """A round as agents pose it, and as the audit does."""

    problem: RoundProblem
    offers: tuple[MemberOffer, ...]
    departure_s: float
    ground: Ground


def posed(seed: int, rules: dict[str, float], *, sees: bool) -> Posed:
    """Return the first round of a random team, on the later of two maps in every other case."""
    scenario = random_scenario(np.random.default_rng(seed), 4 + seed % 2, size_m=(6.0, 6.0))
    communication = scenario.communication.model_copy(update=rules)
    update = {"communication": communication, "radio": Radio(line_of_sight=sees)}
    scenario = with_a_change(scenario).model_copy(update=update)
    site = Site.from_scenario(scenario)
    atlas = Atlas(site.grid, site.region_discs)
    charts = Charts(atlas)
    change_ns = nanoseconds(scenario.workspace.changes[0].at_s)
    charts.take(change_ns, later_grids(scenario.workspace)[0].free)
    offers = []
    for name in sorted(scenario.agents):
        member = create(name, site, Pacing.EVENT, atlas)
        member.see_odometry(0, site.start_of(name), 0.0, 0.0)
        said = next(own.message for own in member.step(0) if isinstance(own, SendMessage))
        assert isinstance(said, PlanOffer)
        offers.append(said.offers[0])
    if seed % 2:
        offers = [replaced(offer, change_ns) for offer in offers]
    rounds = MeetingRounds(charts, team_of(site), 0.0)
    departure_s = communication.duration_s
    ground = grounds_of(scenario, 0.0)[offers[0].map_ns]
    problem = rounds.problem(1, departure_s, offers)
    return Posed(problem, tuple(offers), departure_s, ground)


def replaced(offer: MemberOffer, map_ns: int) -> MemberOffer:
    """Return an offer as if it had been made with another map."""
    fields = {name: getattr(offer, name) for name in MemberOffer.__slots__}
    return MemberOffer(**(fields | {"map_ns": map_ns}))


def with_a_change(scenario: Scenario) -> Scenario:
    """Return the scenario with an obstacle less, and another, from 1 s on."""
    boxes = (*scenario.workspace.obstacles_m[1:], (2.0, 2.0, 2.5, 3.2))
    changes = (Change(at_s=1.0, obstacles_m=boxes),)
    workspace = scenario.workspace.model_copy(update={"changes": changes})
    return scenario.model_copy(update={"workspace": workspace})


@pytest.mark.parametrize("seed", range(4))
def test_candidates_are_the_same(seed: int) -> None:
    """Of each agent all that agents know of, and of those in the window no other."""
    case = posed(seed, {}, sees=False)
    for offer, theirs in zip(case.offers, case.problem.candidates, strict=True):
        own = case.ground.candidates(offer, case.departure_s)
        rows = [own.steps.index(step) for step in theirs.task_index.tolist()]
        in_time = own.arrival_s < case.problem.window_s[1] - 0.001
        assert in_time.sum() == np.isfinite(theirs.arrival_s).sum() > 0
        for name in ("arrival_s", "extra_s"):
            mine = np.where(in_time, getattr(own, name), np.inf)[rows]
            assert mine == pytest.approx(getattr(theirs, name), abs=1e-9)


@pytest.mark.parametrize("seed", range(4))
@pytest.mark.parametrize("rules", RULES, ids=str)
@pytest.mark.parametrize("sees", [False, True])
def test_open_places_are_the_same(seed: int, rules: dict[str, float], *, sees: bool) -> None:
    """Wherever the others are: near each other, and anywhere."""
    case, rng = posed(seed, rules, sees=sees), np.random.default_rng(seed)
    links = case.problem.links
    is_some_open = False
    for attempt in range(40):
        places = [int(rng.integers(len(links)))]
        while len(places) < len(case.offers):
            near = links.near(places[-1] if attempt % 2 else places[0])
            places.append(int(rng.choice(near if attempt % 8 else np.arange(len(links)))))
        for agent, is_open in enumerate(case.ground.openings.open_to(places)):
            others = [*places[:agent], *places[agent + 1 :]]
            expected = case.problem.open_places(others)
            assert np.array_equal(is_open, expected)
            is_some_open |= bool(expected.any())
    assert is_some_open


def test_what_late_controllers_are_reckoned_with_is_the_same() -> None:
    """A freely running agent's steps take as long as the audit says; in lock step, less."""
    scenario = random_scenario(np.random.default_rng(3), agents=2)
    site = Site.from_scenario(scenario)
    cells = Cells(scenario.workspace, scenario.workspace.obstacles_m)
    free = np.zeros(len(cells), dtype=np.bool_)
    member = create("agent_1", site, Pacing.PERIODIC, Atlas(site.grid, site.region_discs))
    member.see_odometry(0, site.start_of("agent_1"), 0.0, 0.0)
    said = next(own.message for own in member.step(0) if isinstance(own, SendMessage))
    assert isinstance(said, PlanOffer)
    first, second = next(
        (one, other)
        for one, other in pairwise(said.offers[0].stops)
        if (one.x_m, one.y_m) != (other.x_m, other.y_m)
    )
    target = cells.at(second.x_m, second.y_m)
    taken_s = second.finish_offset_s - first.finish_offset_s
    for late_s, is_true in ((LATE_S, True), (0.0, False)):
        travel = Travel(cells, free, Gait(1.0, 1.5, late_s))
        begin = Waypoint(first.x_m, first.y_m, first.yaw_rad)
        detour = travel.detour(begin, (second.x_m, second.y_m))
        assert detour is not None
        acting_s = taken_s - float(detour.there_s[target])
        assert (min(abs(acting_s), abs(acting_s - 4.0)) < 1e-9) is is_true
