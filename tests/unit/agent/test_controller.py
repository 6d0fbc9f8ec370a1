"""Following a leg, from wherever the agent is."""

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
import pytest

from tlcomm_core.agent.controller import CONTROL_PERIOD_S, LONGEST_STEP_S, Follower, Pacing
from tlcomm_core.geometry import Pose, wrap_angle
from tlcomm_core.workspace.grid import Grid
from tlcomm_core.workspace.travel import Leg, Motion, TravelTimes
from tlcomm_core.world.unicycle import integrate

V_MPS, W_RADPS, TOLERANCE_M = 1.0, 1.5, 0.02
TRAVEL = TravelTimes(Grid((5.0, 5.0), 0.5, [(2.0, 1.0, 3.0, 4.0)]), Motion(V_MPS, W_RADPS))
START = Pose(0.25, 2.25, math.pi)
FIRST, LAST = (4.25, 2.25), (0.25, 4.75)


@dataclass(frozen=True)
class Control:
    """One control step: when, where, what was commanded and until when."""

    time_s: float
    pose: Pose
    linear_mps: float
    angular_radps: float
    until_s: float


def leg_between(pose: Pose, target_m: tuple[float, float]) -> Leg:
    """Return the leg from a pose to a place."""
    target = TRAVEL.grid.location_at(*target_m)
    assert target is not None
    return TRAVEL.leg_to(pose, target)


def follower(leg: Leg, pacing: Pacing = Pacing.EVENT, start: Pose = START) -> Follower:
    """Return a follower of a leg."""
    return Follower(leg, start, V_MPS, W_RADPS, TOLERANCE_M, pacing)


def driven(
    leg: Leg,
    pose: Pose,
    begin_s: float = 0.0,
    pacing: Pacing = Pacing.EVENT,
    noise: float = 0.0,
    seed: int = 0,
) -> Iterator[Control]:
    """Yield the control steps of a leg as they are carried out; the last is at rest."""
    rng = np.random.default_rng(seed)
    follows = follower(leg, pacing)
    now_s = begin_s
    for _ in range(10_000):
        control = follows.control(pose, now_s)
        if control is None:
            yield Control(now_s, pose, 0.0, 0.0, math.inf)
            return
        drive, until_s = control
        yield Control(now_s, pose, drive.linear_mps, drive.angular_radps, until_s)
        until_s = max(until_s, now_s + CONTROL_PERIOD_S) if pacing is Pacing.PERIODIC else until_s
        linear, angular = 1.0 + noise * rng.standard_normal(2)
        velocity = (linear * drive.linear_mps, angular * drive.angular_radps)
        pose = integrate(pose, *velocity, until_s - now_s)
        now_s = until_s
    pytest.fail("the leg had no end")


def test_a_leg_takes_the_time_that_was_predicted() -> None:
    """Turns and straights end exactly, so that arrivals are those the plan reckons with."""
    leg = leg_between(START, FIRST)
    end = list(driven(leg, START, begin_s=3.21))[-1]
    assert end.time_s == pytest.approx(3.21 + leg.duration_s, abs=1e-9)
    assert end.pose.distance_m(leg.arrival.x_m, leg.arrival.y_m) < 1e-9
    assert wrap_angle(end.pose.yaw_rad - leg.arrival.yaw_rad) == pytest.approx(0.0, abs=1e-9)


def test_every_waypoint_is_passed_in_order() -> None:
    """Corners aren't cut: each is the place of some control step."""
    leg = leg_between(START, FIRST)
    assert len(leg.waypoints_m) > 1
    controls = list(driven(leg, START))
    hits = [
        next(k for k, control in enumerate(controls) if control.pose.distance_m(*corner_m) < 1e-6)
        for corner_m in leg.waypoints_m
    ]
    assert hits == sorted(hits)


def test_only_turns_and_straights_are_driven() -> None:
    """Either at full rate or at full speed, never both."""
    controls = list(driven(leg_between(START, FIRST), START))[:-1]
    assert {(c.linear_mps, abs(c.angular_radps)) for c in controls} == {(V_MPS, 0), (0, W_RADPS)}


def test_event_steps_end_on_the_half_second_grid_at_the_latest() -> None:
    """A long straight is asked for at every multiple of half a second, wherever it began."""
    controls = list(driven(leg_between(START, FIRST), START, begin_s=0.3))[:-1]
    assert all(c.time_s < c.until_s <= c.time_s + LONGEST_STEP_S + 1e-9 for c in controls)
    times = [c.time_s for c in controls]
    ticks = np.arange(0.5, times[-1], LONGEST_STEP_S)
    assert all(any(abs(t - tick) < 1e-9 for t in times) for tick in ticks.tolist())


def test_a_step_on_the_grid_goes_on_to_the_next_tick() -> None:
    """Also if the time is a rounding short of it, as times in nanoseconds are."""
    leg = Leg(((4.0, 0.0),), 4.0, 4.0, Pose(4.0, 0.0, 0.0))
    for now_s in (1.5, 1.5 - 1e-9, 1.5 + 1e-9):
        control = follower(leg).control(Pose(0.0, 0.0, 0.0), now_s)
        assert control is not None
        assert control[1] == pytest.approx(2.0, abs=1e-12)


@pytest.mark.parametrize("pacing", Pacing)
@pytest.mark.parametrize("yaw_rad", [math.pi, -math.pi, math.pi - 1e-9, 3.0])
def test_it_turns_round_where_it_stands(pacing: Pacing, yaw_rad: float) -> None:
    """With the waypoint right behind, it turns on the spot and never drives away from it."""
    leg = Leg(((1.0, 0.0),), 0.0, 1.0, Pose(1.0, 0.0, 0.0))
    controls = list(driven(leg, Pose(0.0, 0.0, yaw_rad), pacing=pacing))
    assert controls[0].linear_mps == 0.0
    assert min(c.pose.x_m for c in controls) > -1e-9
    assert controls[-1].time_s <= math.pi / W_RADPS + 1.0 / V_MPS + 4 * CONTROL_PERIOD_S


@pytest.mark.parametrize("pacing", Pacing)
@pytest.mark.parametrize(
    "pose",
    [
        Pose(0.25, 2.25, 1.0),
        Pose(0.21, 2.28, -0.4),
        Pose(0.27, 2.25, math.pi / 2),
        Pose(0.25 + 1e-5, 2.25, 0.0),
    ],
)
def test_it_arrives_from_a_perturbed_pose(pose: Pose, pacing: Pacing) -> None:
    """Whatever the agent is off by at the beginning, it ends within the tolerance."""
    leg = leg_between(START, LAST)
    end = list(driven(leg, pose, pacing=pacing))[-1]
    assert end.pose.distance_m(*leg.waypoints_m[-1]) <= TOLERANCE_M
    assert end.time_s < leg.duration_s + 3.0


def test_an_empty_leg_is_done_at_once() -> None:
    """There is nothing to drive."""
    assert follower(Leg((), 0.0, 0.0, START)).control(START, 0.0) is None


@pytest.mark.parametrize("latency_steps", [1.0, 1.1])
def test_a_periodic_step_never_overshoots(latency_steps: float) -> None:
    """The last step of a move is slowed down to last a period; a late one goes on slightly."""
    leg = Leg(((1.03, 0.0),), 0.0, 1.03, Pose(1.03, 0.0, 0.0))
    follows, pose, now_s = follower(leg, Pacing.PERIODIC), Pose(0.0, 0.0, 0.4), 0.0
    while (control := follows.control(pose, now_s)) is not None:
        drive, again_s = control
        assert again_s == now_s
        pose = integrate(
            pose, drive.linear_mps, drive.angular_radps, latency_steps * CONTROL_PERIOD_S
        )
        now_s += latency_steps * CONTROL_PERIOD_S
        assert pose.x_m <= 1.03 + (latency_steps - 1.0) * V_MPS * CONTROL_PERIOD_S + 1e-9
    assert pose.distance_m(1.03, 0.0) <= TOLERANCE_M


def test_a_periodic_leg_keeps_to_the_allowance() -> None:
    """It takes no longer than predicted with what periodic control may lose per segment."""
    slow = TravelTimes(TRAVEL.grid, Motion(V_MPS, W_RADPS, 1.2 * CONTROL_PERIOD_S))
    for target_m in (FIRST, LAST, (4.75, 0.25)):
        target = slow.grid.location_at(*target_m)
        assert target is not None
        leg = slow.leg_to(START, target)
        end = list(driven(leg, START, pacing=Pacing.PERIODIC))[-1]
        assert end.time_s <= leg.duration_s


@pytest.mark.parametrize("noise", [0.02, 0.1, 0.2])
@pytest.mark.parametrize("pacing", Pacing)
def test_noise_delays_but_does_not_divert(pacing: Pacing, noise: float) -> None:
    """With speeds off by a fifth it still ends within the tolerance, without driving in circles."""
    leg = leg_between(START, FIRST)
    for seed in range(10):
        controls = list(driven(leg, START, pacing=pacing, noise=noise, seed=seed))
        end = controls[-1]
        assert end.pose.distance_m(*leg.waypoints_m[-1]) <= TOLERANCE_M
        assert abs(wrap_angle(end.pose.yaw_rad - leg.arrival.yaw_rad)) < 0.1
        assert end.time_s < leg.duration_s * (1.1 + 2.0 * noise)


def test_what_was_overshot_is_backed_up_to() -> None:
    """Just past a waypoint beyond the tolerance, it goes back straight, then turns to the next."""
    leg = Leg(((1.0, 0.0), (1.0, 2.0)), 0.0, 3.0, Pose(1.0, 2.0, math.pi / 2))
    follows = follower(leg)
    assert follows.control(Pose(0.0, 0.0, 0.0), 0.0) is not None
    control = follows.control(Pose(1.05, 0.0, 0.0), 1.05)
    assert control is not None
    drive, until_s = control
    assert (drive.linear_mps, drive.angular_radps) == (-V_MPS, 0.0)
    assert until_s == pytest.approx(1.10)
    turn = follows.control(Pose(1.0, 0.0, 0.0), 1.10)
    assert turn is not None
    assert (turn[0].linear_mps, turn[0].angular_radps) == (0.0, W_RADPS)


def test_a_waypoint_passed_within_the_tolerance_is_done() -> None:
    """It isn't returned to."""
    leg = Leg(((1.0, 0.0), (1.0, 2.0)), 0.0, 3.0, Pose(1.0, 2.0, math.pi / 2))
    follows = follower(leg)
    assert follows.control(Pose(0.0, 0.0, 0.0), 0.0) is not None
    turn = follows.control(Pose(1.015, 0.0, 0.0), 1.015)
    assert turn is not None
    assert turn[0].angular_radps == W_RADPS


def test_the_deviation_is_from_the_straight_being_driven() -> None:
    """Beside it, behind its begin and beyond its end; other straights of the leg don't count."""
    leg = Leg(((2.25, 2.25), (2.25, 4.25)), 0.0, 0.0, Pose(2.25, 4.25, math.pi / 2.0))
    follows = follower(leg, start=Pose(0.25, 2.25, 0.0))
    poses = [(0.25, 2.25), (1.25, 2.25), (1.25, 2.75), (-0.75, 2.25), (3.25, 2.25), (2.25, 4.25)]
    first = [follows.deviation_m(Pose(*place, 0.0)) for place in poses]
    assert first == pytest.approx([0.0, 0.0, 0.5, 1.0, 1.0, 2.0])
    follows.control(Pose(2.25, 2.25, 0.0), 0.0)
    second = [follows.deviation_m(Pose(*place, 0.0)) for place in poses]
    assert second == pytest.approx([2.0, 1.0, 1.0, 3.0, 1.0, 0.0])
    follows.control(Pose(2.25, 4.25, math.pi / 2.0), 0.0)
    assert follows.deviation_m(Pose(2.25, 3.25, 0.0)) == pytest.approx(1.0)
