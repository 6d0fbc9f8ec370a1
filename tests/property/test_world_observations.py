"""What holds for every world under any commands."""

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from support.random_world import BOXES, SIZE_M, played, random_commands, random_world
from tlcomm_core.world.observation import Connectivity, Odometry
from tlcomm_core.world.radio import is_connected
from tlcomm_core.world.world import Noise

COUNT = 5
SECOND_NS = 1_000_000_000
seeds = st.integers(0, 2**32)


@settings(max_examples=25, deadline=None)
@given(seeds, st.booleans(), st.integers(1, 300))
def test_extra_stops_change_no_bit(seed: int, arcs: bool, stops: int) -> None:
    """Same commands, other numbers of advances and readings between: the same observations."""
    commands = list(random_commands(seed, COUNT, 30, arcs=arcs))
    noise = Noise(0.05, 0.05)
    expected = played(random_world(seed, COUNT, noise), commands)
    last_ns = commands[-1].time_ns
    stops_ns = np.random.default_rng(seed).integers(0, last_ns, stops).tolist()
    assert played(random_world(seed, COUNT, noise), commands, stops_ns) == expected


@settings(max_examples=25, deadline=None)
@given(seeds, st.booleans())
def test_reports_are_ordered_and_never_late(seed: int, arcs: bool) -> None:
    """Per agent at most 0.5 s apart in motion and 1 s at rest; connectivity at most 1 s."""
    commands = list(random_commands(seed, COUNT, 30, arcs=arcs))
    seen = played(random_world(seed, COUNT), commands)
    stamps = [one.stamp_ns for one in seen]
    assert stamps == sorted(stamps)
    connectivity = [one for one in seen if isinstance(one, Connectivity)]
    assert all(b.stamp_ns - a.stamp_ns <= SECOND_NS for a, b in pairwise(connectivity))
    for index in range(COUNT):
        own = [one for one in seen if isinstance(one, Odometry) and one.agent == f"agent_{index}"]
        for one, following in pairwise(own):
            moving = one.linear_mps != 0.0 or one.angular_radps != 0.0
            assert following.stamp_ns - one.stamp_ns <= (SECOND_NS // 2 if moving else SECOND_NS)


@settings(max_examples=25, deadline=None)
@given(seeds, st.booleans())
def test_connectivity_is_true_and_told_when_it_changes(seed: int, arcs: bool) -> None:
    """Each message differs from the last or is a heartbeat, and ``connected`` fits its edges."""
    commands = list(random_commands(seed, COUNT, 30, arcs=arcs))
    seen = played(random_world(seed, COUNT), commands)
    connectivity = [one for one in seen if isinstance(one, Connectivity)]
    for one, following in pairwise(connectivity):
        assert one.edges != following.edges or following.stamp_ns - one.stamp_ns == SECOND_NS
    for one in connectivity:
        assert one.connected is is_connected(COUNT, one.edges)
        assert list(one.edges) == sorted(one.edges)


@settings(max_examples=25, deadline=None)
@given(seeds, st.booleans())
def test_nobody_is_ever_inside_an_obstacle(seed: int, arcs: bool) -> None:
    """Read every 20 ms, all are in the workspace and outside the boxes, up to a cut corner."""
    commands = list(random_commands(seed, COUNT, 30, arcs=arcs))
    world = random_world(seed, COUNT)
    slack_m = 1e-4 if arcs else 0.0
    for command in commands:
        while world.now_ns < command.time_ns or world.next_change_ns() == command.time_ns:
            step_ns = world.now_ns + 20_000_000
            world.advance_to(min(world.next_change_ns(), step_ns, command.time_ns))
            for index in range(COUNT):
                pose = world.odometry(f"agent_{index}").pose
                assert 0.0 <= pose.x_m <= SIZE_M
                assert 0.0 <= pose.y_m <= SIZE_M
                for x_min, y_min, x_max, y_max in BOXES:
                    depth_m = min(
                        pose.x_m - x_min, x_max - pose.x_m, pose.y_m - y_min, y_max - pose.y_m
                    )
                    assert depth_m <= slack_m
        world.command(command.agent, command.linear_mps, command.angular_radps)


@pytest.mark.parametrize("arcs", [False, True])
def test_the_random_worlds_are_eventful(arcs: bool) -> None:
    """Over a few seeds there are collisions and link changes: the properties aren't vacuous."""
    collisions, edge_sets = 0, set()
    for seed in range(5):
        world = random_world(seed, COUNT)
        seen = played(world, list(random_commands(seed, COUNT, 30, arcs=arcs)))
        collisions += sum(world.collisions.values())
        edge_sets |= {one.edges for one in seen if isinstance(one, Connectivity)}
    assert collisions >= 5
    assert len(edge_sets) >= 10
