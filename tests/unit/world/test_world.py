"""The world as its users see it: reports, commands, links."""

import math
from collections.abc import Sequence
from itertools import pairwise

import numpy as np
import pytest

from tlcomm_core.errors import LocalMisuseError
from tlcomm_core.geometry import Pose
from tlcomm_core.workspace.grid import Grid
from tlcomm_core.world.observation import Connectivity, Observation, Occupancy, Odometry
from tlcomm_core.world.unicycle import integrate
from tlcomm_core.world.world import Body, Noise, World

SECOND_NS = 1_000_000_000
HALF_NS = SECOND_NS // 2
NO_NOISE = Noise()


def world(*starts_m: Sequence[float], noise: Noise = NO_NOISE, seed: int = 0) -> World:
    """Return a world of 10 m × 10 m with an obstacle, R = 1 m, all facing +x."""
    bodies = [
        Body(f"agent_{index}", Pose(x_m, y_m, 0.0), 1.0, 1.5)
        for index, (x_m, y_m) in enumerate(starts_m)
    ]
    grid = Grid((10.0, 10.0), 0.5, [(3.0, 3.0, 4.0, 5.0)])
    return World(bodies, grid, 1.0, noise, np.random.default_rng(seed))


def run(simulated: World, until_ns: int) -> list[Observation]:
    """Advance from change to change."""
    seen: list[Observation] = []
    while simulated.now_ns < until_ns or simulated.next_change_ns() == until_ns:
        seen += simulated.advance_to(min(simulated.next_change_ns(), until_ns))
    return seen


def connectivity(seen: Sequence[Observation]) -> list[tuple[int, tuple[tuple[int, int], ...]]]:
    """Return time and edges of each connectivity."""
    return [(one.stamp_ns, one.edges) for one in seen if isinstance(one, Connectivity)]


def test_at_the_start_everything_is_told() -> None:
    """At t = 0: the map, each agent's odometry in order, then connectivity."""
    simulated = world((1.0, 1.0), (2.0, 1.0), (5.0, 1.0))
    assert simulated.next_change_ns() == 0
    assert simulated.neighbours("agent_0") == {"agent_1"}
    occupancy, *others = simulated.advance_to(0)
    assert isinstance(occupancy, Occupancy)
    assert (occupancy.stamp_ns, occupancy.grid.shape) == (0, (20, 20))
    assert others == [
        Odometry(0, "agent_0", Pose(1.0, 1.0, 0.0), 0.0, 0.0),
        Odometry(0, "agent_1", Pose(2.0, 1.0, 0.0), 0.0, 0.0),
        Odometry(0, "agent_2", Pose(5.0, 1.0, 0.0), 0.0, 0.0),
        Connectivity(0, ((0, 1),), connected=False, distances_m=(1.0,)),
    ]
    assert simulated.advance_to(0) == ()


def test_distances_are_those_at_the_time() -> None:
    """Each connectivity tells how far apart linked agents are then, moving or not."""
    simulated = world((1.0, 1.0), (1.0, 1.5), (9.0, 9.0))
    simulated.advance_to(0)
    simulated.command("agent_0", 0.5, 0.0)
    seen = [one for one in run(simulated, 2 * SECOND_NS) if isinstance(one, Connectivity)]
    assert [(one.stamp_ns, one.distances_m) for one in seen[:1]] == [
        (SECOND_NS, (pytest.approx(math.hypot(0.5, 0.5)),))
    ]
    assert (seen[1].edges, seen[1].distances_m) == ((), ())


def test_where_sight_matters_a_pillar_breaks_a_link() -> None:
    """Driving past a pillar, an agent is out of another's sight from corner to corner."""
    bodies = [Body(name, Pose(1.0, y_m, 0.0), 1.0, 1.5) for name, y_m in (("a", 1.0), ("b", 2.0))]
    grid = Grid((10.0, 10.0), 0.5, [(2.0, 1.4, 3.0, 1.6)])
    links = []
    for line_of_sight in (False, True):
        simulated = World(
            bodies, grid, 1.0, NO_NOISE, np.random.default_rng(0), line_of_sight=line_of_sight
        )
        simulated.advance_to(0)
        for name in ("a", "b"):
            simulated.command(name, 1.0, 0.0)
        links.append(connectivity(run(simulated, 3 * SECOND_NS)))
    assert {edges for _, edges in links[0]} == {((0, 1),)}
    changes = [after for before, after in pairwise(links[1]) if after[1] != before[1]]
    assert changes == [
        (pytest.approx(SECOND_NS, abs=10), ()),
        (pytest.approx(2 * SECOND_NS, abs=10), ((0, 1),)),
    ]


def test_heartbeats_at_rest_and_in_motion() -> None:
    """Odometry every second at rest and every half in motion, connectivity every second."""
    simulated = world((1.0, 1.0), (1.0, 2.0))
    run(simulated, 0)
    simulated.advance_to(SECOND_NS // 4)
    (turning,) = simulated.command("agent_1", 0.0, 0.1)
    seen = [turning, *run(simulated, 2 * SECOND_NS)]
    stamps = {
        name: [one.stamp_ns for one in seen if isinstance(one, Odometry) and one.agent == name]
        for name in ("agent_0", "agent_1")
    }
    quarter_ns = SECOND_NS // 4
    assert stamps["agent_0"] == [SECOND_NS, 2 * SECOND_NS]
    assert stamps["agent_1"] == [quarter_ns, 3 * quarter_ns, 5 * quarter_ns, 7 * quarter_ns]
    assert connectivity(seen) == [(SECOND_NS, ((0, 1),)), (2 * SECOND_NS, ((0, 1),))]


def test_a_link_change_is_told_at_once_and_restarts_the_heartbeat() -> None:
    """Driving apart from 0.75 m at 1 m/s ends the link at 0.25 s; the next is a second later."""
    simulated = world((1.0, 1.0), (1.75, 1.0))
    run(simulated, 0)
    simulated.command("agent_1", 1.0, 0.0)
    seen = connectivity(run(simulated, 2 * SECOND_NS))
    assert seen == [(HALF_NS // 2 + 1, ()), (HALF_NS // 2 + 1 + SECOND_NS, ())]
    assert simulated.neighbours("agent_0") == frozenset()


def test_connected_means_the_whole_team() -> None:
    """A middle agent that joins the ends makes the team connected."""
    simulated = world((1.2, 1.0), (2.0, 3.0), (2.8, 1.0))
    assert not run(simulated, 0)[-1].connected  # type: ignore[union-attr]
    simulated.command("agent_1", 0.0, -1.5)
    run(simulated, round(math.pi / 3 * 1e9))
    simulated.command("agent_1", 1.0, 0.0)
    changes = [one for one in run(simulated, 4 * SECOND_NS) if isinstance(one, Connectivity)]
    joined = next(one for one in changes if one.connected)
    assert joined.edges == ((0, 1), (1, 2))
    assert all(one.edges != joined.edges for one in changes if not one.connected)


def test_commands_are_clamped_to_the_limits() -> None:
    """Faster is as fast as can be, in either direction."""
    simulated = world((5.0, 1.0))
    (forward,) = simulated.command("agent_0", 7.0, -9.0)
    assert isinstance(forward, Odometry)
    assert (forward.linear_mps, forward.angular_radps) == (1.0, -1.5)
    (backward,) = simulated.command("agent_0", -7.0, 0.5)
    assert isinstance(backward, Odometry)
    assert (backward.linear_mps, backward.angular_radps) == (-1.0, 0.5)


@pytest.mark.parametrize("value", [math.nan, math.inf, -math.inf])
def test_a_command_that_is_not_finite_is_refused_and_counted(value: float) -> None:
    """The velocity stays as it was."""
    simulated = world((5.0, 1.0), (7.0, 1.0))
    simulated.command("agent_0", 0.5, 0.0)
    assert simulated.command("agent_0", value, 0.0) == ()
    assert simulated.command("agent_0", 0.0, value) == ()
    assert simulated.odometry("agent_0").linear_mps == 0.5
    assert simulated.refused == {"agent_0": 2, "agent_1": 0}


def test_the_same_command_again_tells_nothing() -> None:
    """Odometry comes when the velocity changes, not when it is repeated."""
    simulated = world((5.0, 1.0))
    assert len(simulated.command("agent_0", 0.5, 0.0)) == 1
    assert simulated.command("agent_0", 0.5, 0.0) == ()
    assert len(simulated.command("agent_0", 0.0, 0.0)) == 1


def test_a_collision_is_told_with_zero_velocity_and_counted() -> None:
    """At the obstacle the odometry says that it stands, 1 m on; the other one isn't touched."""
    simulated = world((2.0, 4.0), (8.0, 4.0))
    run(simulated, 0)
    simulated.command("agent_0", 1.0, 0.0)
    seen = run(simulated, 3 * SECOND_NS)
    stop = next(one for one in seen if isinstance(one, Odometry) and one.linear_mps == 0.0)
    assert stop.agent == "agent_0"
    assert stop.stamp_ns == pytest.approx(SECOND_NS, abs=5)
    assert 0.0 <= 3.0 - stop.pose.x_m < 3e-9
    assert simulated.odometry("agent_0").pose == stop.pose
    assert simulated.collisions == {"agent_0": 1, "agent_1": 0}


def test_noise_is_a_seeded_factor_per_command() -> None:
    """Same seed, same factors; they scatter around 1 as told, after clamping; rest stays rest."""
    noisy = [world((5.0, 5.5), noise=Noise(0.1, 0.2), seed=3) for _ in range(2)]
    for _ in range(500):
        for simulated in noisy:
            simulated.command("agent_0", 2.0, 1.0)
    velocities = []
    for _ in range(500):
        (one,), (other,) = (simulated.command("agent_0", 2.0, 1.0) for simulated in noisy)
        assert one == other
        assert isinstance(one, Odometry)
        velocities.append((one.linear_mps, one.angular_radps))
    assert np.mean(velocities, axis=0) == pytest.approx([1.0, 1.0], abs=0.03)
    assert np.std(velocities, axis=0) == pytest.approx([0.1, 0.2], rel=0.15)
    noisy[0].command("agent_0", 0.0, 0.0)
    assert noisy[0].odometry("agent_0").linear_mps == 0.0


def test_without_noise_nothing_is_drawn() -> None:
    """The generator is left as it was."""
    rng = np.random.default_rng(1)
    grid = Grid((2.0, 2.0), 0.5)
    simulated = World([Body("a", Pose(1.0, 1.0, 0.0), 1.0, 1.0)], grid, 1.0, Noise(), rng)
    simulated.command("a", 1.0, 1.0)
    assert rng.random() == np.random.default_rng(1).random()


def test_time_runs_forward_and_not_past_a_change() -> None:
    """Going back, or beyond what the world has to show, is misuse."""
    simulated = world((5.0, 1.0))
    with pytest.raises(LocalMisuseError, match="1 isn't between now, 0, and 0"):
        simulated.advance_to(1)
    simulated.advance_to(0)
    simulated.advance_to(5)
    with pytest.raises(LocalMisuseError, match="4 isn't between"):
        simulated.advance_to(4)


def test_an_unknown_agent_is_misuse() -> None:
    """The message names it and those that exist."""
    with pytest.raises(LocalMisuseError, match=r"'ghost' among \['agent_0'\]"):
        world((5.0, 1.0)).command("ghost", 0.0, 0.0)


def test_agents_compute_the_same_pose_from_odometry() -> None:
    """Dead reckoning from the last odometry agrees with the world to 1e-9."""
    simulated = world((5.0, 2.0))
    last = simulated.odometry("agent_0")
    rng = np.random.default_rng(5)
    for step in range(200):
        simulated.command("agent_0", *rng.uniform(-1.0, 1.0, 2))
        last = simulated.odometry("agent_0")
        for one in run(simulated, (step + 1) * 137_000_000):
            last = one if isinstance(one, Odometry) else last
        duration_s = (simulated.now_ns - last.stamp_ns) * 1e-9
        found = integrate(last.pose, last.linear_mps, last.angular_radps, duration_s)
        actual = simulated.odometry("agent_0").pose
        assert actual.distance_m(found.x_m, found.y_m) < 1e-9
        assert math.cos(found.yaw_rad - actual.yaw_rad) == pytest.approx(1.0, abs=1e-15)


DOOR = (6.0, 0.0, 6.5, 10.0)
CLOSES_NS = 2 * SECOND_NS + 7


def with_door(x_m: float, *, opens: bool = False) -> World:
    """Return a body that drives along x towards a door that closes, or opens."""
    doors = [Grid((10.0, 10.0), 0.5, [DOOR]), Grid((10.0, 10.0), 0.5)]
    first, then = doors if opens else doors[::-1]
    body = Body("agent_0", Pose(x_m, 5.0, 0.0), 1.0, 1.5)
    rng = np.random.default_rng(0)
    simulated = World([body], first, 1.0, Noise(), rng, changes=[(CLOSES_NS, then)])
    run(simulated, 0)
    simulated.command("agent_0", 1.0, 0.0)
    return simulated


def test_the_map_is_shown_when_it_changes() -> None:
    """At that very time, which is one of the world's changes."""
    simulated = with_door(1.0)
    shown = [one for one in run(simulated, 5 * SECOND_NS) if isinstance(one, Occupancy)]
    assert [one.stamp_ns for one in shown] == [CLOSES_NS]
    assert shown[0].grid.location_at(6.25, 5.0) is None


def test_a_door_that_closes_stops_what_drives_towards_it() -> None:
    """Where it is, from then on; before, it was driven through."""
    simulated = with_door(3.0)
    run(simulated, 6 * SECOND_NS)
    assert simulated.odometry("agent_0").pose.x_m == pytest.approx(6.0, abs=1e-8)
    assert simulated.collisions == {"agent_0": 1}
    through = with_door(5.0)
    run(through, 4 * SECOND_NS)
    assert through.odometry("agent_0").pose.x_m == pytest.approx(9.0, abs=1e-8)
    assert through.collisions == {"agent_0": 0}


def test_a_door_that_opens_lets_through_what_drives_towards_it() -> None:
    """What would have been the contact isn't any more."""
    simulated = with_door(3.5, opens=True)
    run(simulated, 6 * SECOND_NS)
    assert simulated.odometry("agent_0").pose.x_m == pytest.approx(9.5, abs=1e-8)
    stopped = with_door(5.0, opens=True)
    run(stopped, 6 * SECOND_NS)
    assert stopped.odometry("agent_0").pose.x_m == pytest.approx(6.0, abs=1e-8)


def test_a_door_that_closes_on_a_body_lets_it_out_and_not_in_again() -> None:
    """It drives on as before; once out and told to turn back, it is stopped at the door."""
    simulated = with_door(4.25)
    run(simulated, 3 * SECOND_NS)
    assert simulated.odometry("agent_0").pose.x_m == pytest.approx(7.25, abs=1e-8)
    assert simulated.collisions == {"agent_0": 0}
    simulated.command("agent_0", -1.0, 0.0)
    run(simulated, 6 * SECOND_NS)
    assert simulated.odometry("agent_0").pose.x_m == pytest.approx(6.5, abs=1e-8)
    assert simulated.collisions == {"agent_0": 1}


def test_inside_a_closed_door_the_walls_of_before_still_count() -> None:
    """What doesn't hold it is only what has come."""
    wall = (6.2, 4.0, 6.4, 6.0)
    grids = [Grid((10.0, 10.0), 0.5, [wall]), Grid((10.0, 10.0), 0.5, [DOOR, wall])]
    body = Body("agent_0", Pose(6.1, 5.0, 0.0), 1.0, 1.5)
    rng = np.random.default_rng(0)
    simulated = World([body], grids[0], 1.0, Noise(), rng, changes=[(SECOND_NS, grids[1])])
    run(simulated, 2 * SECOND_NS)
    simulated.command("agent_0", 0.1, 0.0)
    run(simulated, 5 * SECOND_NS)
    assert simulated.odometry("agent_0").pose.x_m == pytest.approx(6.2, abs=1e-8)
    assert simulated.collisions == {"agent_0": 1}


@pytest.mark.parametrize("line_of_sight", [True, False])
def test_a_door_hides_bodies_from_each_other_while_it_is_closed(*, line_of_sight: bool) -> None:
    """If radios need sight, links go and come with it, at the very time."""
    bodies = [Body(name, Pose(x_m, 5.0, 0.0), 1.0, 1.5) for name, x_m in (("a", 5.8), ("b", 6.7))]
    shut, opened = Grid((10.0, 10.0), 0.5, [DOOR]), Grid((10.0, 10.0), 0.5)
    changes = [(SECOND_NS + 3, shut), (2 * SECOND_NS + 5, opened)]
    rng = np.random.default_rng(0)
    simulated = World(
        bodies, opened, 1.0, Noise(), rng, changes=changes, line_of_sight=line_of_sight
    )
    seen = connectivity(run(simulated, 3 * SECOND_NS))
    lost = [time_ns for time_ns, edges in seen if not edges]
    assert lost == ([SECOND_NS + 3, 2 * SECOND_NS + 3] if line_of_sight else [])
    assert (2 * SECOND_NS + 5, ((0, 1),)) in seen or not line_of_sight
