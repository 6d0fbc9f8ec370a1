"""Travel by turn and forward: times, and the very paths that are driven.

``Motion``       how an agent drives
``Leg``          one drive, as predicted and as driven
``Reach``        times and arrival headings from one pose to every location
``Detour``       times by way of every location
``TravelTimes``  shortest legs on a grid, for one motion

Legs to a place that a plan names follow the tree of shortest paths *into* that place, legs to a
meeting place the tree *out of* the pose; each is the tree that its prediction came from, so that
an agent drives exactly what it announced.
"""

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Final

import numpy as np
from numpy.typing import NDArray

from tlcomm_core.errors import LocalMisuseError
from tlcomm_core.geometry import Pose, wrap_angle
from tlcomm_core.workspace.cache import BoundedCache
from tlcomm_core.workspace.grid import Grid
from tlcomm_core.workspace.lattice import HEADINGS, HEADINGS_RAD, Arrivals, Lattice, PathTree

__all__ = ["HEADINGS_RAD", "Detour", "Leg", "Motion", "Reach", "TravelTimes"]

# A pose this close to a lattice state is that state: far above rounding, far below a controller.
_SNAP_M: Final = 1e-6
_SNAP_RAD: Final = 1e-6
# Times this close count as equal, so that rounding never decides between equal paths.
_TIE_S: Final = 1e-9
_CACHE_BYTES: Final = 64 * 2**20
_WAYPOINT_BYTES: Final = 128


@dataclass(frozen=True, slots=True)
class Motion:
    """How an agent drives: its speeds, and the time its controller may lose.

    Attributes:
        linear_mps: speed on a straight.
        angular_radps: rate of a turn on the spot.
        segment_allowance_s: the most that the controller loses per segment (a turn or a straight)
            in real time. Travel times charge it twice per 45° turn, twice per turn that begins
            off the lattice headings, and twice per leg that moves at all. This bounds the true
            loss: n turns make at most 2n + 1 segments.
    """

    linear_mps: float
    angular_radps: float
    segment_allowance_s: float = 0.0


@dataclass(frozen=True, slots=True)
class Leg:
    """One drive, as predicted and as driven.

    Attributes:
        waypoints_m: corner points in order; to each a turn on the spot and a straight lead, and
            the last is the target's centre. Empty if the agent is already there.
        duration_s: time of all turns and straights with the motion's allowances.
        distance_m: length of all straights.
        arrival: the target's centre and the last straight's heading, which is a lattice heading
            unless the leg only approaches the centre of the pose's own cell; the pose itself if
            nothing is driven.
    """

    waypoints_m: tuple[tuple[float, float], ...]
    duration_s: float
    distance_m: float
    arrival: Pose

    @property
    def nbytes(self) -> int:
        """Size in bytes of the waypoints, about."""
        return _WAYPOINT_BYTES * (1 + len(self.waypoints_m))


@dataclass(frozen=True, slots=True)
class Reach:
    """What one pose reaches, and when.

    Attributes:
        time_s: shortest time to each location, float[Z]; inf if unreachable; read-only.
        heading: lattice heading on arrival, int[Z], the lowest among equally fast ones; for the
            pose's own location the one nearest to the yaw kept there. Read-only.
    """

    time_s: NDArray[np.float64]
    heading: NDArray[np.intp]


@dataclass(frozen=True, slots=True)
class Detour:
    """The way from one pose to a target by way of every location.

    Attributes:
        there_s: shortest time to each location, float[Z]; inf if unreachable; read-only.
        extra_s: what going by each location adds to the way to the target, float[Z]; inf if
            either part is unreachable; read-only.
    """

    there_s: NDArray[np.float64]
    extra_s: NDArray[np.float64]

    @property
    def nbytes(self) -> int:
        """Size in bytes."""
        return self.there_s.nbytes + self.extra_s.nbytes


@dataclass(frozen=True, slots=True)
class _Entry:
    """How a pose enters the lattice: over the centre of its cell, then by some heading.

    ``approach_s`` and ``heading_s`` (time to turn to each lattice heading at the centre) leave
    out the allowance per leg.
    """

    location: int
    pose: Pose
    at_centre: Pose
    approach_s: float
    heading_s: tuple[float, ...]

    @property
    def is_at_centre(self) -> bool:
        """Whether the pose is over its cell's centre already."""
        return self.pose == self.at_centre


@dataclass(frozen=True, slots=True)
class _Departure:
    """The search out of one pose."""

    entry: _Entry
    tree: PathTree
    reach: Reach

    @property
    def nbytes(self) -> int:
        """Size in bytes."""
        return self.tree.nbytes + self.reach.time_s.nbytes + self.reach.heading.nbytes


class TravelTimes:
    """Shortest turn-and-forward legs on a grid.

    Searches are cached within 64 MiB for each direction (about 1,500 targets or poses at 400
    locations, 50 at 10,000), the least recently used going first.

    A pose within 1e-6 m of a centre and 1e-6 rad of a lattice heading is that lattice state. At a
    centre with another yaw, the first turn leads to the best lattice heading. Elsewhere in a free
    cell, the leg begins with a turn and a straight to the cell's centre.

    Source: Section IV-A, T_i (travel time by turn-and-forward).
    Cost: one Dijkstra search, O(Z log Z), per new target or pose; lookups otherwise.
    """

    def __init__(self, grid: Grid, motion: Motion) -> None:
        """Prepare the graph. Cost: O(Z)."""
        self.grid: Final = grid
        self.motion: Final = motion
        self._allowance_s: Final = 2.0 * motion.segment_allowance_s
        turn_s = math.tau / HEADINGS / motion.angular_radps + self._allowance_s
        self._lattice: Final = Lattice(grid, turn_s, motion.linear_mps)
        self._arrivals: Final = BoundedCache[int, PathTree](_CACHE_BYTES)
        self._departures: Final = BoundedCache[Pose, _Departure](_CACHE_BYTES)
        self._legs: Final = BoundedCache[tuple[Pose, int], Leg](_CACHE_BYTES)
        self._detours: Final = BoundedCache[tuple[Pose, int], Detour](_CACHE_BYTES)

    def time_to(self, target: int) -> NDArray[np.float64]:
        """Return the time from every state to a location, at any heading there.

        Args:
            target: location.

        Returns:
            float[Z, 8] in s, by location and lattice heading; 0 at the target, inf where no path
            leads to it. A read-only view of the cache.
        """
        return self._paths_into(target).time_s.reshape(-1, HEADINGS)

    def arrivals_at(self, target: int) -> Arrivals:
        """Return how the legs from every state arrive at a location; fresh. Cost: O(Z log Z)."""
        return self._paths_into(target).arrivals(target, self.grid.locations_m)

    def reach(self, pose: Pose) -> Reach:
        """Return times and arrival headings from a pose to every location; shared, read-only.

        Raises:
            LocalMisuseError: the pose isn't in a free cell.
        """
        return self._departure(pose).reach

    def prepare(self, locations: Iterable[int]) -> None:
        """Search beforehand what is likely to be asked for, as far as half of the cache.

        Args:
            locations: where agents will stand, with any lattice heading.
        """
        for location in locations:
            x_m, y_m = self.grid.locations_m[location].tolist()
            for heading_rad in HEADINGS_RAD:
                if self._departures.is_half_full:
                    return
                self.reach(Pose(x_m, y_m, heading_rad))

    def leg_to(self, pose: Pose, target: int) -> Leg:
        """Return the shortest leg to a location along the tree of paths into it.

        Raises:
            LocalMisuseError: the pose isn't in a free cell, or no path leads to the target.
        """
        return self._legs.get((pose, target), lambda: self._leg_into(pose, target))

    def _leg_into(self, pose: Pose, target: int) -> Leg:
        entry = self._entry(self._snapped(pose))
        if entry.location == target:
            return self._leg_to_centre(entry)
        heading, duration_s = self._start_towards(entry, target)
        nodes = _walk(self._paths_into(target), entry.location * HEADINGS + heading, target)
        return self._leg_along(entry, nodes, duration_s)

    def _start_towards(self, entry: _Entry, target: int) -> tuple[int, float]:
        """Return the lattice heading of the shortest leg to another location, and its time."""
        times_s = (self.time_to(target)[entry.location] + entry.heading_s).tolist()
        heading = _first_least(times_s)
        if times_s[heading] == math.inf:
            raise LocalMisuseError(
                f"no path between the locations {entry.location!r} and {target!r}"
            )
        return heading, entry.approach_s + times_s[heading]

    def leg_from(self, pose: Pose, target: int) -> Leg:
        """Return the shortest leg to a location along the tree of paths out of the pose.

        Raises:
            LocalMisuseError: the pose isn't in a free cell, or no path leads to the target.
        """
        departure = self._departure(pose)
        entry, reach = departure.entry, departure.reach
        if entry.location == target:
            return self._leg_to_centre(entry)
        last = target * HEADINGS + int(reach.heading[target])
        nodes = _walk(departure.tree, last, entry.location)[::-1]
        return self._leg_along(entry, nodes, float(reach.time_s[target]))

    def detour(self, pose: Pose, target: int) -> Detour:
        """Return the times from a pose to a target by way of every location; shared, read-only.

        Each leg is the shortest with the heading that the one before it ends with.

        Raises:
            LocalMisuseError: the pose isn't in a free cell, or no path leads to the target.

        Source: Section IV-B1 of the paper, δ = T(π^h, z) + T(z, π^{h+1}) − T(π^h, π^{h+1}).
        """
        return self._detours.get((pose, target), lambda: self._detour(pose, target))

    def _detour(self, pose: Pose, target: int) -> Detour:
        reach = self.reach(pose)
        direct_s = self._direct_s(pose, target)
        onward_s = self.time_to(target)[np.arange(len(reach.heading)), reach.heading]
        # Where the agent needn't move, it keeps a yaw that may not be a lattice heading.
        onward_s[reach.time_s == 0.0] = direct_s
        # Never negative but for rounding: the way by z is one of those that the direct one beats.
        extra_s = np.maximum(reach.time_s + onward_s - direct_s, 0.0)
        extra_s.setflags(write=False)
        return Detour(reach.time_s, extra_s)

    def _direct_s(self, pose: Pose, target: int) -> float:
        """Return the time of ``leg_to`` without following its path."""
        entry = self._entry(self._snapped(pose))
        if entry.location == target:
            return self._leg_to_centre(entry).duration_s
        return self._start_towards(entry, target)[1]

    def _paths_into(self, target: int) -> PathTree:
        return self._arrivals.get(target, lambda: self._search_into(target))

    def _search_into(self, target: int) -> PathTree:
        tree = self._lattice.paths_into(target)
        time_s = tree.time_s + self._allowance_s
        time_s[target * HEADINGS : (target + 1) * HEADINGS] = 0.0
        time_s.setflags(write=False)
        return PathTree(time_s, tree.next_node)

    def _departure(self, pose: Pose) -> _Departure:
        snapped = self._snapped(pose)
        return self._departures.get(snapped, lambda: self._search_out_of(snapped))

    def _search_out_of(self, pose: Pose) -> _Departure:
        entry = self._entry(pose)
        tree = self._lattice.paths_out_of(entry.location, entry.heading_s)
        times_s = tree.time_s.reshape(-1, HEADINGS)
        # The lowest heading whose time is the least but for rounding.
        heading = np.argmax(times_s <= times_s.min(axis=1, keepdims=True) + _TIE_S, axis=1)
        time_s = times_s[np.arange(len(times_s)), heading] + (entry.approach_s + self._allowance_s)
        time_s[entry.location] = self._leg_to_centre(entry).duration_s
        time_s.setflags(write=False)
        heading.setflags(write=False)
        return _Departure(entry, tree, Reach(time_s, heading))

    def _snapped(self, pose: Pose) -> Pose:
        """Return the pose with its point and its yaw on the lattice where they all but are."""
        location = self.grid.location_at(pose.x_m, pose.y_m)
        if location is None:
            raise LocalMisuseError(f"pose {pose!r} isn't in a free cell")
        x_m, y_m = self.grid.locations_m[location].tolist()
        if pose.distance_m(x_m, y_m) > _SNAP_M:
            return pose
        heading_rad = HEADINGS_RAD[_nearest_heading(pose.yaw_rad)]
        is_lattice = abs(wrap_angle(pose.yaw_rad - heading_rad)) <= _SNAP_RAD
        return Pose(x_m, y_m, heading_rad if is_lattice else pose.yaw_rad)

    def _entry(self, pose: Pose) -> _Entry:
        location = self.grid.location_at(pose.x_m, pose.y_m)
        assert location is not None, "snapping has checked the cell"
        x_m, y_m = self.grid.locations_m[location].tolist()
        approach_m = pose.distance_m(x_m, y_m)
        if approach_m == 0.0:
            return _Entry(location, pose, pose, 0.0, self._heading_s(pose.yaw_rad))
        yaw_rad = math.atan2(y_m - pose.y_m, x_m - pose.x_m)
        approach_s = self._turn_s(pose.yaw_rad, yaw_rad) + approach_m / self.motion.linear_mps
        at_centre = self._snapped(Pose(x_m, y_m, yaw_rad))
        return _Entry(location, pose, at_centre, approach_s, self._heading_s(at_centre.yaw_rad))

    def _heading_s(self, yaw_rad: float) -> tuple[float, ...]:
        """Return the time to turn from a yaw to each heading at which the search may begin."""
        if yaw_rad in HEADINGS_RAD:
            return tuple(0.0 if yaw_rad == heading else math.inf for heading in HEADINGS_RAD)
        return tuple(self._turn_s(yaw_rad, heading_rad) for heading_rad in HEADINGS_RAD)

    def _turn_s(self, from_rad: float, to_rad: float) -> float:
        """Return the time of one turn off the lattice, its allowance included."""
        return abs(wrap_angle(to_rad - from_rad)) / self.motion.angular_radps + self._allowance_s

    def _leg_to_centre(self, entry: _Entry) -> Leg:
        """Return the leg to the centre of the cell that the pose is in."""
        if entry.is_at_centre:
            return Leg((), 0.0, 0.0, entry.pose)
        centre_m = (entry.at_centre.x_m, entry.at_centre.y_m)
        duration_s = entry.approach_s + self._allowance_s
        return Leg((centre_m,), duration_s, entry.pose.distance_m(*centre_m), entry.at_centre)

    def _leg_along(self, entry: _Entry, nodes: Sequence[int], duration_s: float) -> Leg:
        """Return the leg over the centre of the pose's cell and along a path of states."""
        corners = [] if entry.is_at_centre else [(entry.at_centre.x_m, entry.at_centre.y_m)]
        distance_m = sum(entry.pose.distance_m(*corner_m) for corner_m in corners)
        yaw_rad: float | None = None
        x_m, y_m = entry.at_centre.x_m, entry.at_centre.y_m
        for node, following in pairwise(nodes):
            if node // HEADINGS == following // HEADINGS:
                continue
            if HEADINGS_RAD[node % HEADINGS] == yaw_rad:
                corners.pop()
            yaw_rad = HEADINGS_RAD[node % HEADINGS]
            ahead_m = self.grid.locations_m[following // HEADINGS].tolist()
            distance_m += math.dist((x_m, y_m), ahead_m)
            x_m, y_m = ahead_m
            corners.append((x_m, y_m))
        assert yaw_rad is not None, "a path between two locations has a straight"
        return Leg(tuple(corners), duration_s, distance_m, Pose(x_m, y_m, yaw_rad))


def _walk(tree: PathTree, node: int, location: int) -> list[int]:
    """Return the states from one to the first at a location, towards the tree's root."""
    nodes = [node]
    while nodes[-1] // HEADINGS != location:
        following = int(tree.next_node[nodes[-1]])
        if following < 0:
            raise LocalMisuseError(
                f"no path between the locations {node // HEADINGS!r} and {location!r}"
            )
        nodes.append(following)
    return nodes


def _first_least(times_s: Sequence[float]) -> int:
    """Return the lowest index whose time is the least but for rounding."""
    bound_s = min(times_s) + _TIE_S
    return next(k for k, time_s in enumerate(times_s) if time_s <= bound_s)


def _nearest_heading(yaw_rad: float) -> int:
    """Return the lattice heading nearest to a yaw, the lowest of two equally near."""
    return _first_least([abs(wrap_angle(yaw_rad - heading_rad)) for heading_rad in HEADINGS_RAD])
