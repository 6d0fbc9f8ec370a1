"""One body: contacts, counts and reports."""

import math

import pytest

from tlcomm_core.errors import LocalMisuseError
from tlcomm_core.geometry import Pose
from tlcomm_core.workspace.grid import Grid
from tlcomm_core.world.collision import Obstacles
from tlcomm_core.world.vehicle import Body, Vehicle

SECOND_NS = 1_000_000_000
OBSTACLES = Obstacles(Grid((10.0, 10.0), 0.5, [(3.0, 3.0, 4.0, 5.0)]))


def vehicle(x_m: float = 2.0, yaw_rad: float = 0.0) -> Vehicle:
    """Return a body west of the obstacle, facing it."""
    return Vehicle(Body("a", Pose(x_m, 4.0, yaw_rad), 1.0, 1.5), OBSTACLES)


def run_to_stop(body: Vehicle) -> int:
    """Advance from event to event until it stands; return when."""
    for _ in range(100):
        now_ns = body.due_ns
        body.advance_to(now_ns)
        body.report(now_ns)
        if not body.course.moving:
            return now_ns
    raise AssertionError("it never stops")


def test_a_start_inside_an_obstacle_is_our_own_mistake() -> None:
    """Scenarios are checked before, so this is misuse; the message names the agent."""
    with pytest.raises(LocalMisuseError, match="'a' starts inside"):
        vehicle(3.5)


@pytest.mark.parametrize("angular_radps", [0.0, 0.3])
def test_it_is_stopped_before_the_obstacle(angular_radps: float) -> None:
    """At the contact both speeds are zero and the point is outside."""
    body = vehicle()
    body.drive(0, 1.0, angular_radps)
    stop_ns = run_to_stop(body)
    assert stop_ns == pytest.approx(SECOND_NS, rel=0.03)
    assert 0.0 <= 3.0 - body.course.anchor.x_m < 3e-9
    assert body.collisions == 1


def test_pushing_on_counts_once() -> None:
    """Commands into the wall at the wall change nothing and are the same contact."""
    body = vehicle()
    body.drive(0, 1.0, 0.0)
    now_ns = run_to_stop(body)
    assert not body.drive(now_ns, 1.0, 0.0)
    assert body.drive(now_ns, 0.0, 1.0)
    assert body.drive(now_ns + 100_000_000, 1.0, 0.0)
    assert not body.course.moving
    assert body.collisions == 1


def test_coming_back_is_another_contact() -> None:
    """After backing away it may run into the wall again."""
    body = vehicle()
    body.drive(0, 1.0, 0.0)
    now_ns = run_to_stop(body)
    assert body.drive(now_ns, -1.0, 0.0)
    assert body.drive(now_ns + 100_000_000, 1.0, 0.0)
    run_to_stop(body)
    assert body.collisions == 2


def test_it_may_turn_at_the_wall_and_drive_away() -> None:
    """After half a turn at the wall the way is free up to the border."""
    body = vehicle()
    body.drive(0, 1.0, 0.0)
    stop_ns = run_to_stop(body)
    assert body.drive(stop_ns, 0.0, 1.0)
    turned_ns = stop_ns + round(math.pi * 1e9)
    assert body.drive(turned_ns, 1.0, 0.0)
    assert run_to_stop(body) == pytest.approx(turned_ns + 3 * SECOND_NS, abs=10)


def test_an_arc_is_watched_from_heartbeat_to_heartbeat() -> None:
    """A contact three heartbeats ahead is found in time."""
    body = vehicle(1.3)
    body.drive(0, 1.0, 0.01)
    assert run_to_stop(body) == pytest.approx(1.7e9, rel=1e-3)
    assert body.collisions == 1
