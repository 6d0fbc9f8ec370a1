"""How far an agent goes on with its plan before it leaves for the meeting."""

import math

import pytest

from support.small_plant import START, SmallPlant
from tlcomm_core.agent.convoy import AgreedLeg
from tlcomm_core.agent.itinerary import Itinerary
from tlcomm_core.errors import LocalMisuseError
from tlcomm_core.game.strategy import Strategy
from tlcomm_core.geometry import Pose
from tlcomm_core.ltl import parse
from tlcomm_core.planning.synthesis import plan_task
from tlcomm_core.workspace.grid import Grid
from tlcomm_core.workspace.travel import Leg, TravelTimes

PLANT = SmallPlant()
PLAN = plan_task(parse("G F ((p & collect) & F (r & unload))"), PLANT.system())
# Whose attempt fails, at the region of the step.
STEP = next(index for index in range(10) if PLAN.step(index).action == "collect")
PLACE = Pose(1.75, 0.25, 0.0)
AWAY = Pose(3.25, 2.75, 0.0)
RETRIES = 2


def at_the_action(task_index: int, meeting_s: float) -> tuple[Itinerary, Pose]:
    """Return an itinerary with all done before the action, and where the agent is then."""
    itinerary = Itinerary(PLAN, PLANT.times, RETRIES)
    meeting = Strategy("one", PLACE.x_m, PLACE.y_m, task_index, meeting_s, 0.0)
    itinerary.agree(meeting, meeting_s)
    pose = START
    for _ in range(STEP):
        pose = itinerary.leg(pose, None).arrival
        itinerary.finish_step()
    return itinerary, itinerary.leg(pose, None).arrival


def needed_s(itinerary: Itinerary, pose: Pose) -> float:
    """Return what one more attempt and the way to the meeting take."""
    place = PLANT.times.grid.location_at(PLACE.x_m, PLACE.y_m)
    assert place is not None
    return itinerary.step.duration_s + PLANT.times.leg_from(pose, place).duration_s


def test_without_failures_step_h_decides() -> None:
    """However late it is: steps up to h come first, then the meeting."""
    itinerary, pose = at_the_action(STEP, 0.0)
    assert itinerary.next_meeting(pose, 1000.0) is None
    itinerary.finish_step()
    meeting = itinerary.next_meeting(pose, 0.0)
    assert meeting is not None
    arrival = itinerary.leg(pose, meeting).arrival
    assert arrival.distance_m(PLACE.x_m, PLACE.y_m) == 0.0


@pytest.mark.parametrize("leeway_s", [0.0, 3.0])
def test_who_keeps_time_leaves_out_what_is_too_late(leeway_s: float) -> None:
    """From the agreed arrival less what is left: later by more than the leeway, time decides."""
    agreed_s = 100.0
    itinerary, pose = at_the_action(STEP, agreed_s)
    before = itinerary.leg(pose, None)
    by_s = agreed_s + leeway_s - before.duration_s - needed_s(itinerary, before.arrival)
    itinerary.keep_time(pose, leeway_s)
    assert itinerary.next_meeting(pose, by_s - 1e-3) is None
    assert itinerary.next_meeting(pose, by_s + 1e-3) is not None
    itinerary.agree(Strategy("one", PLACE.x_m, PLACE.y_m, STEP, agreed_s, 0.0), agreed_s)
    assert itinerary.next_meeting(pose, by_s + 1e-3) is None


def test_who_keeps_time_counts_all_steps_that_are_left() -> None:
    """An agent that is late for them all leaves out the first that doesn't fit, not the last."""
    late = Itinerary(PLAN, PLANT.times, RETRIES)
    late.agree(Strategy("one", PLACE.x_m, PLACE.y_m, STEP + 3, 200.0, 0.0), 200.0)
    total_s, pose = 0.0, START
    for index in range(STEP + 4):
        leg = PLANT.times.leg_to(pose, PLAN.step(index).location)
        total_s += leg.duration_s + PLAN.step(index).duration_s
        pose = leg.arrival
    place = PLANT.times.grid.location_at(PLACE.x_m, PLACE.y_m)
    assert place is not None
    total_s += PLANT.times.leg_from(pose, place).duration_s
    late.keep_time(START, 0.0)
    assert late.next_meeting(START, 200.0 - total_s) is None
    # One step alone still fits in: time decides on each.
    assert late.next_meeting(START, 200.0 - total_s + 1.0) is None
    assert late.next_meeting(START, 199.9) is not None


def test_after_a_failure_time_decides() -> None:
    """Another attempt begins if it can end, and the place be reached, by t_c; not if it can't."""
    itinerary, pose = at_the_action(STEP + 5, 100.0)
    latest_s = 100.0 - needed_s(itinerary, pose)
    assert itinerary.fail_step() == 1
    assert itinerary.next_meeting(pose, latest_s) is None
    assert itinerary.next_meeting(pose, latest_s + 1e-3) is not None
    assert itinerary.step == PLAN.step(STEP)


def test_after_a_failure_time_decides_on_later_steps_too() -> None:
    """What the failure cost is lacking until the meeting."""
    itinerary, pose = at_the_action(STEP + 5, 100.0)
    itinerary.fail_step()
    itinerary.finish_step()
    assert itinerary.next_meeting(pose, 0.0) is None
    assert itinerary.next_meeting(pose, 99.0) is not None


def test_the_retries_are_counted_from_meeting_to_meeting() -> None:
    """After the last it goes to meet, however early; after the meeting it begins anew."""
    itinerary, pose = at_the_action(STEP + 5, 1e6)
    for attempt in range(1, RETRIES + 2):
        assert itinerary.next_meeting(pose, 0.0) is None
        assert itinerary.fail_step() == attempt
    meeting = itinerary.next_meeting(pose, 0.0)
    assert meeting is not None
    itinerary.agree(meeting, 1e6)
    assert itinerary.next_meeting(pose, 0.0) is None
    assert itinerary.done == STEP - 1


def test_after_a_failure_the_way_to_the_meeting_is_in_time() -> None:
    """Whenever an attempt was begun, the place is reached by t_c though it fails."""
    itinerary, pose = at_the_action(STEP + 5, 100.0)
    now_s = 60.0
    itinerary.fail_step()
    meeting = None
    while meeting is None:
        meeting = itinerary.next_meeting(pose, now_s)
        if meeting is None:
            leg = itinerary.leg(pose, None)
            pose, now_s = leg.arrival, now_s + leg.duration_s + itinerary.step.duration_s
            itinerary.finish_step()
    assert now_s + itinerary.leg(pose, meeting).duration_s <= 100.0 + 1e-6


def test_the_pose_at_the_meeting_is_foreseen() -> None:
    """Leg by leg through the steps up to h, then to the place; nothing is changed by asking."""
    itinerary, pose = at_the_action(STEP + 1, 100.0)
    expected = itinerary.meeting_pose(pose)
    assert expected.distance_m(PLACE.x_m, PLACE.y_m) == 0.0
    for _ in range(2):
        pose = itinerary.leg(pose, None).arrival
        itinerary.finish_step()
    meeting = itinerary.next_meeting(pose, 0.0)
    assert meeting is not None
    assert itinerary.leg(pose, meeting).arrival == expected


def test_without_a_meeting_ahead_steps_follow_one_another() -> None:
    """However long that goes on; to leave for a meeting that nobody has agreed on is a bug."""
    itinerary, pose = Itinerary(PLAN, PLANT.times, RETRIES), START
    for _ in range(20):
        assert itinerary.next_meeting(pose, 1e6) is None
        pose = itinerary.leg(pose, None).arrival
        itinerary.finish_step()
    with pytest.raises(LocalMisuseError, match="before any meeting"):
        itinerary.meeting_pose(pose)


def test_an_agreed_way_is_gone_at_the_agreed_hours() -> None:
    """From where it begins, be it to the meeting or to a step; from elsewhere, after a step or once
    the meeting is reached, the shortest way at any time.
    """
    itinerary = Itinerary(PLAN, PLANT.times, RETRIES)
    meeting = Strategy("one", PLACE.x_m, PLACE.y_m, 0, 100.0, 0.0)
    round_about = Leg(((AWAY.x_m + 0.5, AWAY.y_m), (AWAY.x_m, AWAY.y_m)), 9.0, 1.0, AWAY)
    itinerary.agree(meeting, math.inf, AgreedLeg(AWAY, round_about, 20.0, 30.0))
    for goal in (meeting, None):
        leg = itinerary.leg(AWAY, goal)
        assert leg is round_about
        assert itinerary.hours(leg) == (20.0, 30.0)
    elsewhere = itinerary.leg(itinerary.leg(PLACE, None).arrival, meeting)
    assert elsewhere.arrival.distance_m(PLACE.x_m, PLACE.y_m) == 0.0
    assert itinerary.hours(elsewhere) == (-math.inf, -math.inf)
    for goes_on in (itinerary.finish_step, itinerary.reach_meeting):
        itinerary.agree(meeting, math.inf, AgreedLeg(AWAY, round_about, 20.0, 30.0))
        goes_on()
        assert itinerary.leg(AWAY, meeting) is not round_about


def test_an_agreed_way_that_the_map_has_closed_isnt_gone() -> None:
    """Another one is, that all who agreed find alike: into the place, not out of the own pose."""
    itinerary = Itinerary(PLAN, PLANT.times, RETRIES)
    meeting = Strategy("one", PLACE.x_m, PLACE.y_m, 0, 100.0, 0.0)
    place = PLANT.times.grid.location_at(PLACE.x_m, PLACE.y_m)
    assert place is not None
    agreed = PLANT.times.leg_from(AWAY, place)
    itinerary.agree(meeting, math.inf, AgreedLeg(AWAY, agreed, 20.0, 30.0))
    assert itinerary.leg(AWAY, meeting) is agreed
    grid, (x_m, y_m) = PLANT.times.grid, agreed.waypoints_m[0]
    half_m = grid.cell_m / 2.0
    box = (x_m - half_m, y_m - half_m, x_m + half_m, y_m + half_m)
    closed = Grid(grid.size_m, grid.cell_m, [*grid.boxes.tolist(), box], grid.origin_m)
    travel = TravelTimes(closed, PLANT.times.motion)
    itinerary.change_map(travel, AWAY)
    leg = itinerary.leg(AWAY, meeting)
    assert leg is not agreed
    target = closed.location_at(PLACE.x_m, PLACE.y_m)
    assert target is None or leg == travel.leg_to(AWAY, target)


def test_how_many_steps_lead_to_the_next_action() -> None:
    """It counts itself; where there is none, the next step and the one after it."""
    itinerary = Itinerary(PLAN, PLANT.times, RETRIES)
    for _ in range(8):
        counted = itinerary.steps_to_action
        ahead = [PLAN.step(itinerary.done + count) for count in range(1, counted + 1)]
        assert counted >= 2
        assert [step.action is None for step in ahead[:-1]] == [True] * (
            counted - 1
        ) or counted == 2
        itinerary.finish_step()
    patrol = plan_task(parse("G F p & G F m & G F r"), PLANT.system())
    assert Itinerary(patrol, PLANT.times, RETRIES).steps_to_action == 2
