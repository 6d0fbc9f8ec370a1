"""What of an itinerary a new map leaves possible, and when it leads to the meeting."""

import pytest

from support.small_plant import START, SmallPlant
from tlcomm_core.agent.itinerary import Itinerary
from tlcomm_core.game.strategy import Strategy
from tlcomm_core.geometry import Pose
from tlcomm_core.ltl import parse
from tlcomm_core.planning.synthesis import plan_task
from tlcomm_core.workspace.grid import Box, Grid
from tlcomm_core.workspace.travel import TravelTimes

PLANT = SmallPlant()
PLAN = plan_task(parse("G F ((p & collect) & F (r & unload))"), PLANT.system())
UNLOADED = next(index for index in range(10) if PLAN.step(index).action == "unload")
PLACE_M = (1.75, 0.25)
MEETING_S = 100.0
# Between p and r, where the way round the wall in the middle is longer; in no way at all.
BETWEEN, ASIDE = (1.0, 0.0, 1.5, 1.0), (3.5, 1.5, 4.0, 2.0)


def plant_with(*boxes: Box) -> TravelTimes:
    """Return travel times in the plant with some more boxes."""
    grid = Grid((4.0, 4.0), 0.5, [*PLANT.times.grid.boxes.tolist(), *boxes])
    return TravelTimes(grid, PLANT.times.motion)


def meeting(arrival_s: float = MEETING_S) -> Strategy:
    """Return an agreement to meet after both actions."""
    return Strategy("one", *PLACE_M, UNLOADED, arrival_s, 0.0)


@pytest.fixture(name="itinerary")
def fixture_itinerary() -> Itinerary:
    """Return an itinerary from START, with all still to do."""
    itinerary = Itinerary(PLAN, PLANT.times, 2)
    itinerary.agree(meeting(), MEETING_S)
    return itinerary


def left_s(itinerary: Itinerary) -> float:
    """Return what all takes that is left from START, the place of meeting included."""
    total_s, pose = 0.0, START
    for index in range(UNLOADED + 1):
        step = PLAN.step(index)
        place = PLANT.times.grid.locations_m[step.location].tolist()
        target = itinerary.travel.grid.location_at(*place)
        assert target is not None
        leg = itinerary.travel.leg_to(pose, target)
        total_s, pose = total_s + leg.duration_s + step.duration_s, leg.arrival
    return total_s + itinerary.leg(pose, meeting()).duration_s


def test_where_ways_become_longer_time_decides(itinerary: Itinerary) -> None:
    """Until the next agreement, as after a failure."""
    assert itinerary.next_meeting(START, MEETING_S) is None
    itinerary.change_map(plant_with(BETWEEN), START)
    assert itinerary.next_meeting(START, MEETING_S) == meeting()
    assert itinerary.next_meeting(START, 0.0) is None
    itinerary.agree(meeting(), MEETING_S)
    assert itinerary.next_meeting(START, MEETING_S) is None


@pytest.mark.parametrize("boxes", [[], [ASIDE]])
def test_where_ways_stay_as_they_are_steps_do(itinerary: Itinerary, boxes: list[Box]) -> None:
    """Nothing takes longer: what was agreed holds."""
    itinerary.change_map(plant_with(*boxes), START)
    assert itinerary.next_meeting(START, MEETING_S) is None


@pytest.mark.parametrize(("spare_s", "decides"), [(-1.0, True), (0.0, False), (5.0, False)])
def test_what_was_agreed_with_an_older_map_is_heeded(
    itinerary: Itinerary, spare_s: float, decides: bool
) -> None:
    """If it takes longer on the newer one than agreed, time decides."""
    itinerary.change_map(plant_with(BETWEEN), START)
    arrival_s = 10.0 + left_s(itinerary) + spare_s
    itinerary.agree(meeting(arrival_s), MEETING_S)
    itinerary.heed_map(START, 10.0)
    assert (itinerary.next_meeting(START, MEETING_S) is not None) is decides


def test_without_a_newer_map_an_agreement_is_never_doubted(itinerary: Itinerary) -> None:
    """Nor is the next one after it."""
    itinerary.heed_map(START, MEETING_S)
    assert itinerary.next_meeting(START, MEETING_S) is None
    itinerary.change_map(plant_with(BETWEEN), START)
    for arrival_s in (1e6, 0.0):
        itinerary.agree(meeting(arrival_s), MEETING_S)
        itinerary.heed_map(START, 10.0)
        assert itinerary.next_meeting(START, MEETING_S) is None


def test_a_step_out_of_reach_gives_way_to_the_meeting(itinerary: Itinerary) -> None:
    """However early it is, and with another way open it comes first again."""
    while itinerary.step.region != "r":
        itinerary.finish_step()
    assert not itinerary.is_blocked(START)
    itinerary.change_map(plant_with((2.5, 0.0, 3.0, 3.0), (2.0, 2.5, 3.0, 4.0)), START)
    assert itinerary.next_meeting(START, 0.0) == meeting()
    assert itinerary.is_blocked(START)
    assert not itinerary.can_go_on(START)
    itinerary.change_map(plant_with(BETWEEN), START)
    assert itinerary.next_meeting(START, 0.0) is None
    assert not itinerary.is_blocked(START)


def test_a_place_of_meeting_that_has_closed_is_replaced(itinerary: Itinerary) -> None:
    """By the nearest cell that can be reached, the lowest of equals."""
    itinerary.change_map(plant_with((1.5, 0.0, 2.0, 0.5)), Pose(0.25, 0.25, 0.0))
    assert itinerary.is_cut_off(Pose(0.25, 0.25, 0.0))
    leg = itinerary.leg(Pose(0.25, 0.25, 0.0), meeting())
    assert (leg.arrival.x_m, leg.arrival.y_m) == (1.25, 0.25)
    assert not itinerary.calls_away(leg.arrival)
    itinerary.change_map(PLANT.times, leg.arrival)
    assert itinerary.calls_away(leg.arrival)
    assert not itinerary.calls_away(START)


def test_after_the_meeting_is_reached_nothing_comes_before_it(itinerary: Itinerary) -> None:
    """Also if another plan has been begun; after the next agreement its steps come."""
    itinerary.reach_meeting()
    itinerary.plan_anew(PLAN)
    assert itinerary.next_meeting(START, 0.0) == meeting()
    itinerary.agree(meeting(), MEETING_S)
    assert itinerary.next_meeting(START, 0.0) is None
    assert itinerary.step == PLAN.step(0)
