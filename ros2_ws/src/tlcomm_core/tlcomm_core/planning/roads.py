"""The regular states of a transition system, and the steps between them in whole arrays.

- ``IDLE_S``  what staying put without an action costs
- ``State``   where the agent is and how it is turned
- ``Roads``   the states that stand on a region's centre with a lattice heading
- ``Rows``    their steps
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from tlcomm_core.geometry import Pose
from tlcomm_core.planning.repertoire import Repertoire
from tlcomm_core.workspace.lattice import HEADINGS, HEADINGS_RAD
from tlcomm_core.workspace.travel import TravelTimes

__all__ = ["IDLE_S", "Roads", "Rows", "State"]

IDLE_S: Final = 1.0

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]


@dataclass(frozen=True, slots=True)
class State:
    """What the future depends on after a step.

    Attributes:
        location: index into the grid's free cells.
        pose: the exact pose, as the leg that led there predicts it.
        has_acted_instantly: the step that led there was an action that took no time.
        memory: what has been done that an action waits for, as the ``Repertoire`` counts it.
    """

    location: int
    pose: Pose
    has_acted_instantly: bool = False
    memory: int = 0


@dataclass(frozen=True, slots=True)
class Rows:
    """Steps out of regular states; states as keys."""

    source: Ints
    target: Ints
    action: Ints
    drive_s: Floats
    drive_m: Floats
    stay_s: Floats


class Roads:
    """The regular states, which stand on a region's centre with a lattice heading, and their steps.

    The key of (memory m, place p, heading k, has acted instantly i) is ((m·P + p)·8 + k)·2 + i
    for P places.
    """

    def __init__(
        self,
        times: TravelTimes,
        places: Sequence[int],
        repertoire: Repertoire,
        possible: NDArray[np.bool_],
    ) -> None:
        """Take the places, and which actions their regions allow, bool[P, A + 1]."""
        self._grid: Final = times.grid
        self._places: Final = places
        self._number: Final = {place: number for number, place in enumerate(places)}
        self._repertoire: Final = repertoire
        self._possible: Final = possible
        # Keys with the same memory.
        self._page: Final = 2 * HEADINGS * len(places)
        self.key_count: Final = self._page * repertoire.memories
        shape = (len(places) * HEADINGS, len(places))
        self._drive_s: Final = np.empty(shape)
        self._drive_m: Final = np.empty(shape)
        self._arrival: Final = np.empty(shape, dtype=np.int64)
        for number, place in enumerate(places):
            arrivals = times.arrivals_at(place)
            headings = arrivals.heading[places].ravel()
            self._drive_m[:, number] = arrivals.distance_m[places].ravel()
            self._drive_s[:, number] = times.time_to(place)[places].ravel()
            self._arrival[:, number] = (number * HEADINGS + headings) * 2

    def key_of(self, state: State) -> int | None:
        """Return a state's key; ``None`` if it isn't regular."""
        place, pose = self._number.get(state.location), state.pose
        if place is None or pose.yaw_rad not in HEADINGS_RAD:
            return None
        if [pose.x_m, pose.y_m] != self._grid.locations_m[state.location].tolist():
            return None
        heading = HEADINGS_RAD.index(pose.yaw_rad)
        key = (place * HEADINGS + heading) * 2 + state.has_acted_instantly
        return state.memory * self._page + key

    def state_of(self, key: int) -> State:
        """Return the state with a key."""
        memory, key = divmod(key, self._page)
        node, has_acted_instantly = divmod(key, 2)
        place, heading = divmod(node, HEADINGS)
        location = self._places[place]
        x_m, y_m = self._grid.locations_m[location].tolist()
        pose = Pose(x_m, y_m, HEADINGS_RAD[heading])
        return State(location, pose, has_acted_instantly > 0, memory)

    def places_of(self, keys: Ints) -> Ints:
        """Return the number of each state's place."""
        places: Ints = keys % self._page // (2 * HEADINGS)
        return places

    def reached_from(self, keys: Ints) -> Ints:
        """Return the keys of all regular states that some lead to, themselves included, sorted."""
        known = np.zeros(self.key_count, dtype=np.bool_)
        frontier = keys
        while len(frontier):
            known[frontier] = True
            target = self.steps_from(frontier).target
            frontier = np.unique(target[~known[target]])
        return np.flatnonzero(known)

    def steps_from(self, keys: Ints) -> Rows:
        """Return the steps, by state; on the spot first, then to the other places in order."""
        memory, nodes = keys // self._page, keys % self._page // 2
        places = nodes // HEADINGS
        stay_target, stay_s = self._stays(keys)
        count = stay_s.shape[1]
        shape = (len(keys), count + len(self._places))
        kept = np.ones(shape, dtype=np.bool_)
        kept[:, :count] = self._possible[places] & self._repertoire.possible_after(memory)
        kept[np.arange(len(keys)), count + places] = False
        arrival = self._arrival[nodes] + (memory * self._page)[:, None]
        action = np.zeros(shape, dtype=np.int64)
        action[:, :count] = np.arange(count)
        no_drive, no_stay_s = np.zeros_like(stay_s), np.zeros((len(keys), len(self._places)))
        return Rows(
            source=np.repeat(keys, kept.sum(axis=1)),
            target=np.hstack((stay_target, arrival))[kept],
            action=action[kept],
            drive_s=np.hstack((no_drive, self._drive_s[nodes]))[kept],
            drive_m=np.hstack((no_drive, self._drive_m[nodes]))[kept],
            stay_s=np.hstack((stay_s, no_stay_s))[kept],
        )

    def _stays(self, keys: Ints) -> tuple[Ints, Floats]:
        """Return targets and times of staying put: idle, then every action."""
        seconds = np.array([IDLE_S, *self._repertoire.durations_s])
        memory, here = keys // self._page, keys % self._page
        calm = self._repertoire.memory_after(memory) * self._page + (here - here % 2)[:, None]
        may_be_instant = (keys % 2 == 0)[:, None] & (seconds == 0.0)
        stay_s = np.where((seconds == 0.0) & ~may_be_instant, IDLE_S, seconds)
        return calm + may_be_instant, stay_s
