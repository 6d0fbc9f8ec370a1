"""The simulated world: bodies that drive, obstacles, links.

``Body``   an agent's body, as given
``Noise``  how badly velocity commands are carried out
``World``  all of it over time
"""

import math
from collections import deque
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from types import MappingProxyType
from typing import Final

import numpy as np
from numpy.typing import NDArray

from tlcomm_core.errors import LocalMisuseError
from tlcomm_core.field.sensors import Sensors
from tlcomm_core.workspace.grid import Grid
from tlcomm_core.world.collision import Obstacles
from tlcomm_core.world.forecast import Forecast
from tlcomm_core.world.observation import Connectivity, Observation, Occupancy, Odometry, Reading
from tlcomm_core.world.radio import distances_m, edges, is_connected, neighbours, pair_indices
from tlcomm_core.world.reach import Reach
from tlcomm_core.world.vehicle import Body, Vehicle

__all__ = ["Body", "Noise", "World"]

_CONNECTIVITY_HEARTBEAT_NS: Final = 1_000_000_000


@dataclass(frozen=True, slots=True)
class Noise:
    """Standard deviations of the factors that each command's v and ω are multiplied by."""

    linear: float = 0.0
    angular: float = 0.0


class World:
    """Bodies with exact constant-velocity motion, and who hears whom.

    Time goes from event to event: ``next_change_ns`` tells when the world itself has something to
    show, and ``advance_to`` goes there or to any time before. What is seen depends on the commands
    and their times alone, not on the stops made in between, to the bit.

    Observations at one time come in the order: map, odometry by agents, connectivity.
    """

    def __init__(
        self,
        bodies: Sequence[Body],
        grid: Grid,
        range_m: float,
        noise: Noise,
        rng: np.random.Generator,
        *,
        changes: Sequence[tuple[int, Grid]] = (),
        line_of_sight: bool = False,
    ) -> None:
        """Put all bodies at rest at their starts, at t = 0.

        Args:
            bodies: the agents', in the scenario's order; at least one.
            grid: the workspace; its boxes are the obstacles.
            range_m: R.
            noise: of the actuation.
            rng: drawn from at each command, if there is noise.
            changes: times (ns), ascending, and the workspaces that begin then, of equal cells.
            line_of_sight: whether obstacles keep bodies from hearing each other.

        Raises:
            LocalMisuseError: a body starts inside an obstacle or outside the workspace.
        """
        obstacles = Obstacles(grid)
        self.now_ns = 0
        self._vehicles: Final = tuple(Vehicle(body, obstacles) for body in bodies)
        self._bodies: Final = {body.name: index for index, body in enumerate(bodies)}
        self._limits: Final = tuple((body.linear_mps, body.angular_radps) for body in bodies)
        self._line_of_sight: Final = line_of_sight
        self._reach = Reach(range_m, grid if line_of_sight else None)
        self._sensors: Sensors | None = None
        self._noise: Final = noise
        self._rng: Final = rng
        self._maps: Final = deque(((0, grid), *changes))
        self._refused = dict.fromkeys(self._bodies, 0)
        self._connectivity_due_ns = 0
        self._next_ns: int | None = None
        self._forecast: Forecast | None = None
        self._adopt_links(np.zeros(len(pair_indices(len(bodies))[0]), dtype=np.bool_))
        change = self._looked_ahead().until(0)
        if change is not None:
            self._adopt_links(change.linked)

    @property
    def collisions(self) -> Mapping[str, int]:
        """How many times each agent has run into something."""
        return {vehicle.name: vehicle.collisions for vehicle in self._vehicles}

    @property
    def refused(self) -> Mapping[str, int]:
        """How many commands of each agent were ignored for not being finite."""
        return MappingProxyType(self._refused)

    @property
    def has_sensors(self) -> bool:
        """Whether there is anything to measure."""
        return self._sensors is not None

    def next_change_ns(self) -> int:
        """Return the earliest time from now on at which the world has something to show.

        That is a link change, a stop at an obstacle, a change of the map, or a heartbeat, due
        within a second.
        """
        if self._next_ns is None:
            due_ns = min(vehicle.due_ns for vehicle in self._vehicles)
            due_ns = min(due_ns, self._connectivity_due_ns, *(time_ns for time_ns, _ in self._maps))
            change = self._looked_ahead().until(due_ns)
            self._next_ns = due_ns if change is None else change.time_ns
        return self._next_ns

    def advance_to(self, time_ns: int) -> tuple[Observation, ...]:
        """Let time pass.

        Args:
            time_ns: from now to ``next_change_ns()``.

        Returns:
            What is due at ``time_ns``.

        Raises:
            LocalMisuseError: a time in the past, or beyond the next change.
        """
        if not self.now_ns <= time_ns <= self.next_change_ns():
            raise LocalMisuseError(
                f"{time_ns!r} isn't between now, {self.now_ns}, and {self.next_change_ns()}"
            )
        change = self._looked_ahead().until(time_ns)
        self.now_ns = time_ns
        self._next_ns = None
        seen: list[Observation] = [*self._next_map()]
        if seen:
            change = self._looked_ahead().until(time_ns)
        for vehicle in self._vehicles:
            if vehicle.due_ns <= time_ns:
                if vehicle.advance_to(time_ns):
                    self._forget_forecast()
                seen.append(vehicle.report(time_ns))
        if change is not None:
            self._adopt_links(change.linked)
        if change is not None or self._connectivity_due_ns <= time_ns:
            seen.append(self._report_connectivity())
        return tuple(seen)

    def command(
        self, agent: str, linear_mps: float, angular_radps: float
    ) -> tuple[Observation, ...]:
        """Set an agent's velocity from now on: clamped to its limits, then with noise.

        Returns:
            Its odometry if the velocity changes. A command that isn't finite changes nothing.

        Raises:
            LocalMisuseError: no such agent.
        """
        index = self._index(agent)
        if not (math.isfinite(linear_mps) and math.isfinite(angular_radps)):
            self._refused[agent] += 1
            return ()
        most_mps, most_radps = self._limits[index]
        driven_mps = self._disturbed(_clamped(linear_mps, most_mps), self._noise.linear)
        turned_radps = self._disturbed(_clamped(angular_radps, most_radps), self._noise.angular)
        vehicle = self._vehicles[index]
        if not vehicle.drive(self.now_ns, driven_mps, turned_radps):
            return ()
        self._forget_forecast()
        return (vehicle.report(self.now_ns),)

    def equip(self, sensors: Sensors) -> None:
        """Give the agents sensors; without there is nothing to measure."""
        self._sensors = sensors

    def measure(self, agent: str, region: str) -> tuple[Observation, ...]:
        """Let an agent read its sensor, as at the end of an action.

        Returns:
            Its reading; nothing if it truly isn't at that station.

        Raises:
            LocalMisuseError: no such agent.
        """
        pose = self._vehicles[self._index(agent)].course.pose_at(self.now_ns)
        if self._sensors is None:
            return ()
        value = self._sensors.read(agent, region, (pose.x_m, pose.y_m), self.now_ns)
        return () if value is None else (Reading(self.now_ns, agent, region, value),)

    def odometry(self, agent: str) -> Odometry:
        """Return an agent's odometry at this moment, due or not; changes nothing."""
        return self._vehicles[self._index(agent)].odometry(self.now_ns)

    def neighbours(self, agent: str) -> frozenset[str]:
        """Return who hears an agent."""
        return self._neighbours[self._index(agent)]

    def _index(self, agent: str) -> int:
        if agent not in self._bodies:
            raise LocalMisuseError(f"no agent {agent!r} among {sorted(self._bodies)}")
        return self._bodies[agent]

    def _disturbed(self, speed: float, deviation: float) -> float:
        if deviation == 0.0:
            return speed
        return speed * (1.0 + deviation * self._rng.standard_normal())

    def _looked_ahead(self) -> Forecast:
        if self._forecast is None:
            courses = [vehicle.course for vehicle in self._vehicles]
            self._forecast = Forecast(courses, self._linked, self._reach, self._constant_ns)
        return self._forecast

    def _forget_forecast(self) -> None:
        """Note that from now on velocities or links are others than before."""
        self._constant_ns = self.now_ns
        self._forecast = None
        self._next_ns = None

    def _adopt_links(self, linked: NDArray[np.bool_]) -> None:
        count = len(self._vehicles)
        names = tuple(self._bodies)
        self._linked = linked
        self._edges = edges(count, linked)
        self._connected = is_connected(count, self._edges)
        self._neighbours = tuple(
            frozenset(names[index] for index in indices)
            for indices in neighbours(count, self._edges)
        )
        self._forget_forecast()

    def _next_map(self) -> tuple[Occupancy, ...]:
        """Let the map change, if it is time to; return what that shows."""
        if not self._maps or self._maps[0][0] > self.now_ns:
            return ()
        _, grid = self._maps.popleft()
        obstacles = Obstacles(grid)
        for vehicle in self._vehicles:
            vehicle.surround(obstacles, self.now_ns)
        if self._line_of_sight:
            self._reach = Reach(self._reach.range_m, grid)
            self._forget_forecast()
        return (Occupancy(self.now_ns, grid),)

    def _report_connectivity(self) -> Connectivity:
        self._connectivity_due_ns = self.now_ns + _CONNECTIVITY_HEARTBEAT_NS
        poses = [vehicle.course.pose_at(self.now_ns) for vehicle in self._vehicles]
        apart_m = distances_m(np.array([(pose.x_m, pose.y_m) for pose in poses]))
        linked_m = tuple(apart_m[self._linked].tolist())
        return Connectivity(self.now_ns, self._edges, self._connected, linked_m)


def _clamped(speed: float, most: float) -> float:
    return max(-most, min(speed, most))
