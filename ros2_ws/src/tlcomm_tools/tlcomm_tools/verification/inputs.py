"""What one agent was told, in order, and when it had to act.

``Told``       one thing that an agent was told
``Inputs``     all of it
``inputs_of``  from a recording

In lock step, nothing of this needs to be recorded beside the topics themselves. An agent acts when
its own need is due; when a message reaches it; when the map changes; and if anything is measured,
when somebody comes into range of it, and once more at the instant of its own reading.
"""

from bisect import bisect_right
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass

from tlcomm_core.scenario.model import Scenario
from tlcomm_core.units import nanoseconds
from tlcomm_core.world.observation import Connectivity, Odometry, Reading
from tlcomm_tools.verification.recording import MapShown, Recording, Said

__all__ = ["Inputs", "Neighbours", "Told", "inputs_of"]


@dataclass(frozen=True, slots=True)
class Neighbours:
    """Who is in range of an agent from ``stamp_ns`` on, and how far away (m)."""

    stamp_ns: int
    distances_m: dict[str, float]


@dataclass(frozen=True, slots=True)
class Told:
    """Something that an agent was told.

    Attributes:
        time_ns: when.
        is_after: whether that was after it had acted at that instant, as what it does shows.
        what: map, odometry, neighbours, reading, or what another agent said.
    """

    time_ns: int
    is_after: bool
    what: MapShown | Odometry | Neighbours | Reading | Said


@dataclass(frozen=True, slots=True)
class Inputs:
    """What an agent was told, and when it had to act.

    Attributes:
        told: in the order in which it learned of it.
        occasions_ns: instants at which it acted for another reason than its own need, ascending.
        readings_ns: those at which it acted once more.
    """

    told: tuple[Told, ...]
    occasions_ns: tuple[int, ...]
    readings_ns: frozenset[int]


def inputs_of(agent: str, recording: Recording, scenario: Scenario) -> Inputs:
    """Return what an agent of the scenario was told, of a run in lock step."""
    records = recording.run.records
    names = recording.run.agents
    linked = [_neighbours(agent, names, seen) for seen in records.connectivity]
    readings = [own for own in recording.readings if own.agent == agent]
    others = [said for said in recording.said if said.agent != agent]
    commanded_ns = {own.stamp_ns for own in recording.commanded if own.agent == agent}
    poses = [own for own in records.odometry if own.agent == agent]
    told = [
        *(Told(own.stamp_ns, is_after=False, what=own) for own in recording.maps),
        *_told_of_motion(poses, commanded_ns),
        *(Told(own.stamp_ns, is_after=False, what=own) for own in linked),
        *(Told(own.stamp_ns, is_after=True, what=own) for own in readings),
        *(Told(own.stamp_ns, is_after=True, what=own) for own in others),
    ]
    told.sort(key=lambda own: (own.time_ns, own.is_after))
    latency_ns = nanoseconds(scenario.communication.hop_latency_s)
    occasions_ns = {own.stamp_ns for own in recording.maps}
    occasions_ns.update(_arrivals_ns(others, linked, latency_ns))
    if scenario.field is not None:
        occasions_ns.update(_fresh_links_ns(linked))
    readings_ns = frozenset(own.stamp_ns for own in readings)
    return Inputs(tuple(told), tuple(sorted(occasions_ns)), readings_ns)


def _neighbours(agent: str, names: Sequence[str], seen: Connectivity) -> Neighbours:
    """Return the agent's part of who hears whom."""
    own = names.index(agent)
    return Neighbours(
        seen.stamp_ns,
        {
            names[i + j - own]: distance_m
            for (i, j), distance_m in zip(seen.edges, seen.distances_m, strict=True)
            if own in {i, j}
        },
    )


def _told_of_motion(poses: Iterable[Odometry], commanded_ns: set[int]) -> Iterator[Told]:
    """Yield an agent's odometry.

    Of one instant, what shows another velocity than before is what a command of that instant made.
    """
    before = None
    for pose in poses:
        velocity = pose.linear_mps, pose.angular_radps
        is_result = velocity != before and before is not None and pose.stamp_ns in commanded_ns
        yield Told(pose.stamp_ns, is_after=is_result, what=pose)
        before = velocity


def _arrivals_ns(
    others: Iterable[Said], linked: Sequence[Neighbours], latency_ns: int
) -> Iterator[int]:
    """Yield when messages of those who are in range by then arrive."""
    since_ns = [own.stamp_ns for own in linked]
    for said in others:
        arrival_ns = said.stamp_ns + latency_ns
        known = bisect_right(since_ns, arrival_ns) - 1
        if known >= 0 and said.agent in linked[known].distances_m:
            yield arrival_ns


def _fresh_links_ns(linked: Iterable[Neighbours]) -> Iterator[int]:
    """Yield when somebody has come into range."""
    before: set[str] = set()
    for own in linked:
        now = set(own.distances_m)
        if now - before:
            yield own.stamp_ns
        before = now
