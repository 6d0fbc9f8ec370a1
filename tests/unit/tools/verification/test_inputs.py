"""Tests of ``tlcomm_tools.verification.inputs``: what one agent was told, and when it acted."""

from dataclasses import replace

import pytest

from support.measuring_corridor import measuring_corridor
from tlcomm_core.agent.actions import Drive
from tlcomm_core.geometry import Pose
from tlcomm_core.protocol.messages import Confirmation
from tlcomm_core.records import RunRecords
from tlcomm_core.world.observation import Connectivity, Odometry, Reading
from tlcomm_tools.bag.reader import RecordedRun
from tlcomm_tools.verification.inputs import Inputs, Neighbours, inputs_of
from tlcomm_tools.verification.recording import Commanded, Recording, Said

SCENARIO = measuring_corridor()
AGENTS = tuple(SCENARIO.agents)
WEST, CARRIER, EAST = AGENTS
HOP_NS = 5_000_000


def told(recording: Recording) -> Inputs:
    """Return what the agent in the west was told."""
    return inputs_of(WEST, recording, SCENARIO)


@pytest.fixture
def empty() -> Recording:
    """Return a recording without anything."""
    return Recording(RecordedRun(RunRecords(), AGENTS, 0, {}, ""))


def moving(stamp_ns: int, linear_mps: float) -> Odometry:
    """Return an odometry of the agent in the west."""
    return Odometry(stamp_ns, WEST, Pose(1.0, 1.0, 0.0), linear_mps, 0.0)


def linked(stamp_ns: int, *edges: tuple[int, int]) -> Connectivity:
    """Return who hears whom, half a metre apart."""
    return Connectivity(stamp_ns, edges, connected=False, distances_m=(0.5,) * len(edges))


def said(stamp_ns: int, sender: str) -> Said:
    """Return something said."""
    return Said(stamp_ns, sender, Confirmation(sender, 1, 1, 7, (sender,)))


def test_a_commands_own_odometry_comes_after_acting(empty: Recording) -> None:
    """Of one instant, what shows the velocity of before was seen first; so was a stop that no
    command made.
    """
    empty.run.records.odometry += [
        moving(0, 0.0),
        moving(10, 0.0),
        moving(10, 1.0),
        moving(20, 0.0),
        replace(moving(30, 1.0), agent=EAST),
    ]
    empty.commanded.append(Commanded(10, WEST, Drive(1.0, 0.0)))
    expected = [(0, False), (10, False), (10, True), (20, False)]
    assert [(own.time_ns, own.is_after) for own in told(empty).told] == expected


def test_messages_of_who_is_in_range_by_then_are_occasions(empty: Recording) -> None:
    """One hop's latency after they were said, by the links of that instant."""
    empty.run.records.connectivity += [linked(0, (0, 1)), linked(HOP_NS + 20, (0, 2))]
    empty.said += [said(10, CARRIER), said(20, CARRIER), said(20, EAST), said(30, WEST)]
    inputs = told(empty)
    # The first links and the new one are occasions too, since something is measured.
    assert inputs.occasions_ns == (0, HOP_NS + 10, HOP_NS + 20)
    heard = [own.what for own in inputs.told if isinstance(own.what, Said)]
    assert heard == empty.said[:3]


def test_only_fresh_links_are_occasions(empty: Recording) -> None:
    """When somebody comes into range; not when a link goes or stays, or is between others."""
    empty.run.records.connectivity += [
        linked(0, (0, 1)),
        linked(10, (0, 1), (1, 2)),
        linked(20, (1, 2)),
        linked(30, (0, 2), (1, 2)),
    ]
    inputs = told(empty)
    assert inputs.occasions_ns == (0, 30)
    seen = [own.what for own in inputs.told]
    near = [own.distances_m for own in seen if isinstance(own, Neighbours)]
    assert near == [{CARRIER: 0.5}, {CARRIER: 0.5}, {}, {EAST: 0.5}]


def test_own_readings_come_after_acting(empty: Recording) -> None:
    """The agent acts once more at that instant; what others read isn't told."""
    empty.readings += [Reading(10, WEST, "shelf", 1.5), Reading(20, EAST, "shelf", 2.5)]
    inputs = told(empty)
    assert inputs.readings_ns == {10}
    assert [(own.time_ns, own.is_after) for own in inputs.told] == [(10, True)]
