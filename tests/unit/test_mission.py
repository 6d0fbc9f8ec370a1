"""What is run."""

import pytest

from support.hall import STARTS, hall
from tlcomm_core.method import Method
from tlcomm_core.mission import Mission, create_world
from tlcomm_core.scenario.model import Noise
from tlcomm_core.scenario.site import Site
from tlcomm_core.units import nanoseconds
from tlcomm_core.world.lockstep import StopRule


def test_the_meeting_at_the_start_is_round_0() -> None:
    """So a run of N rounds ends after N + 1 meetings."""
    site = hall(1)
    assert Mission(site, 0, 3, None).stop == StopRule(4, None)
    assert Mission(site, 0, 0, 2.5).stop == StopRule(1, 2_500_000_000)
    assert Mission(site, 0, None, None).stop == StopRule(None, None)


@pytest.mark.parametrize("method", [Method.PAIRWISE, Method.ALL_TIME, Method.NONE])
def test_where_no_windows_are_met_in_the_last_ones_end_is_the_end(method: Method) -> None:
    """The windows 0 to N are over then, however often the team has met; or it is to end before."""
    site = hall(1)
    period_ns = nanoseconds(site.scenario.communication.period_s)
    assert Mission(site, 0, 3, None, method=method).stop == StopRule(None, 4 * period_ns)
    assert Mission(site, 0, 3, 2.5, method=method).stop == StopRule(None, 2_500_000_000)
    assert Mission(site, 0, None, 2.5, method=method).stop == StopRule(None, 2_500_000_000)


def test_the_world_is_the_scenarios() -> None:
    """Everyone stands at its start, in range of those within R."""
    world = create_world(hall(3), 0)
    for name, (x_m, y_m, yaw_rad) in STARTS.items():
        pose = world.odometry(name).pose
        assert (pose.x_m, pose.y_m, pose.yaw_rad) == (x_m, y_m, yaw_rad)
    assert world.neighbours("one") == {"two", "three"}


def test_speeds_are_limited_to_the_scenarios() -> None:
    """A command beyond them is clamped."""
    world = create_world(hall(1), 0)
    (seen,) = world.command("one", 9.0, -9.0)
    assert (seen.linear_mps, seen.angular_radps) == (1.0, -1.5)  # type: ignore[union-attr]


def test_noise_is_the_seeds() -> None:
    """The same seed disturbs the same, another one otherwise."""
    scenario = hall(1).scenario.model_copy(update={"noise": Noise(linear=0.1, angular=0.1)})
    site = Site.from_scenario(scenario)
    speeds = [create_world(site, seed).command("one", 1.0, 1.0) for seed in (1, 1, 2)]
    assert speeds[0] == speeds[1] != speeds[2]
