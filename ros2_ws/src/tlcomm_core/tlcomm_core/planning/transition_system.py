"""The weighted transition system of an agent: regions with actions, exact with orientation.

- ``IDLE_S``            what staying put without an action costs
- ``State``             where the agent is and how it is turned
- ``TransitionSystem``  states and steps as arrays
- ``build``             the part that is reachable from a pose
"""

from collections import defaultdict
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from typing import Final

import numpy as np
from numpy.typing import NDArray

from tlcomm_core.errors import LocalMisuseError
from tlcomm_core.geometry import Pose
from tlcomm_core.workspace.lattice import HEADINGS, HEADINGS_RAD
from tlcomm_core.workspace.travel import TravelTimes

__all__ = ["IDLE_S", "State", "TransitionSystem", "build"]

IDLE_S: Final = 1.0

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
Label = frozenset[str]


@dataclass(frozen=True, slots=True)
class State:
    """What the future depends on after a step.

    Attributes:
        location: index into the grid's free cells.
        pose: the exact pose, as the leg that led there predicts it.
        has_acted_instantly: the step that led there was an action that took no time.
    """

    location: int
    pose: Pose
    has_acted_instantly: bool = False


@dataclass(frozen=True, slots=True, eq=False)
class TransitionSystem:
    """States and *steps*: a step is a transition together with the composed state it enters.

    The composed state ⟨π, a⟩ of the paper is the place and the action of a step. Nothing that
    comes after it depends on the action, so composed states that differ in it alone are one
    ``State`` here; runs, labels and times are the same.

    Attributes:
        states: number 0 is the initial one.
        regions: the names of the regions at each location; the start's own may have none.
        actions: action names; index 0 is None, the paper's a_0.
        labels: the distinct labels; atoms that are absent are false.
        initial_label: index into ``labels``; a run reads the label of the initial state first.
        source: state that a step leaves, int[E], ascending.
        target: state that it enters, int[E].
        action: index into ``actions``, int[E].
        label: index into ``labels`` of the composed state entered, int[E].
        drive_s: time to drive there, float[E].
        drive_m: length of the way, float[E].
        stay_s: time spent there, float[E].

    Source: Section IV-A, T_i and equation (4): T'_i = T_i = ``drive_s`` +
        D_i = ``stay_s``.
    Deviates: staying put without an action takes ``IDLE_S`` instead of 0 s, and so does an action
        of no duration right after another one at the same place: no loop takes zero time. The
        initial state needn't be in a region; there the agent can only idle or leave.
    """

    states: tuple[State, ...]
    regions: Mapping[int, tuple[str, ...]]
    actions: tuple[str | None, ...]
    labels: tuple[Label, ...]
    initial_label: int
    source: NDArray[np.int64]
    target: NDArray[np.int64]
    action: NDArray[np.int64]
    label: NDArray[np.int64]
    drive_s: NDArray[np.float64]
    drive_m: NDArray[np.float64]
    stay_s: NDArray[np.float64]

    @property
    def time_s(self) -> NDArray[np.float64]:
        """Time of each step, float[E], fresh."""
        return self.drive_s + self.stay_s


def build(
    times: TravelTimes,
    start: Pose,
    region_location: Mapping[str, int],
    regions_at: Callable[[int], Label],
    action_durations: Mapping[str, float],
) -> TransitionSystem:
    """Return the part of an agent's transition system that is reachable from its start.

    Every region that can be reached takes part, named by the task or not: being in it may be what
    makes a formula with a negation true. What is driven through on the way isn't read.

    Args:
        times: travel times of this agent.
        start: its pose, in a free cell.
        region_location: the location that being in a region means; the order breaks ties.
        regions_at: the regions whose discs contain a location.
        action_durations: duration of each action in s, ≥ 0; the order breaks ties.

    Raises:
        LocalMisuseError: the start isn't in a free cell, or a duration is negative.

    Cost: one travel tree per region, and O(8·M²) in whole arrays for M regions.
    """
    for action, duration_s in action_durations.items():
        if not duration_s >= 0.0:
            message = f"duration of action {action!r} is {duration_s!r}, expected ≥ 0"
            raise LocalMisuseError(message)
    return _Builder(times, start, region_location, regions_at, action_durations).build()


@dataclass(frozen=True, slots=True)
class _Step:
    """One step of an odd state on the way into the arrays."""

    target: State
    action: int
    drive_s: float
    drive_m: float
    stay_s: float


@dataclass(frozen=True, slots=True)
class _Rows:
    """Steps out of regular states; states as keys."""

    source: Ints
    target: Ints
    action: Ints
    drive_s: Floats
    drive_m: Floats
    stay_s: Floats


class _Roads:
    """The regular states, which stand on a region's centre with a lattice heading, and their steps.

    The key of (place p, heading k, has acted instantly i) is (8·p + k)·2 + i.
    """

    def __init__(
        self, times: TravelTimes, places: Sequence[int], durations_s: Sequence[float]
    ) -> None:
        self._grid: Final = times.grid
        self._places: Final = places
        self._number: Final = {place: number for number, place in enumerate(places)}
        self._durations_s: Final = durations_s
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
        return (place * HEADINGS + heading) * 2 + state.has_acted_instantly

    def state_of(self, key: int) -> State:
        """Return the state with a key."""
        node, has_acted_instantly = divmod(key, 2)
        place, heading = divmod(node, HEADINGS)
        location = self._places[place]
        x_m, y_m = self._grid.locations_m[location].tolist()
        return State(location, Pose(x_m, y_m, HEADINGS_RAD[heading]), has_acted_instantly > 0)

    def places_of(self, keys: Ints) -> Ints:
        """Return the number of each state's place."""
        places: Ints = keys // (2 * HEADINGS)
        return places

    def reached_from(self, keys: Ints) -> Ints:
        """Return the keys of all regular states that some lead to, themselves included, sorted."""
        known = np.zeros(2 * HEADINGS * len(self._places), dtype=np.bool_)
        frontier = keys
        while len(frontier):
            known[frontier] = True
            target = self.steps_from(frontier).target
            frontier = np.unique(target[~known[target]])
        return np.flatnonzero(known)

    def steps_from(self, keys: Ints) -> _Rows:
        """Return the steps, by state; on the spot first, then to the other places in order."""
        nodes = keys // 2
        stay_target, stay_s = self._stays(keys)
        count = stay_s.shape[1]
        shape = (len(keys), count + len(self._places))
        kept = np.ones(shape, dtype=np.bool_)
        kept[np.arange(len(keys)), count + nodes // HEADINGS] = False
        action = np.zeros(shape, dtype=np.int64)
        action[:, :count] = np.arange(count)
        no_drive, no_stay_s = np.zeros_like(stay_s), np.zeros((len(keys), len(self._places)))
        return _Rows(
            source=np.repeat(keys, shape[1] - 1),
            target=np.hstack((stay_target, self._arrival[nodes]))[kept],
            action=action[kept],
            drive_s=np.hstack((no_drive, self._drive_s[nodes]))[kept],
            drive_m=np.hstack((no_drive, self._drive_m[nodes]))[kept],
            stay_s=np.hstack((stay_s, no_stay_s))[kept],
        )

    def _stays(self, keys: Ints) -> tuple[Ints, Floats]:
        """Return targets and times of staying put: idle, then every action."""
        seconds = np.array([IDLE_S, *self._durations_s])
        calm = keys - keys % 2
        may_be_instant = (keys % 2 == 0)[:, None] & (seconds == 0.0)
        stay_s = np.where((seconds == 0.0) & ~may_be_instant, IDLE_S, seconds)
        return calm[:, None] + may_be_instant, stay_s


class _Builder:
    """The search from the start: odd states one by one, then the regular ones in whole layers.

    Odd is the start, and what it comes to without driving elsewhere, if it isn't regular.
    """

    def __init__(
        self,
        times: TravelTimes,
        start: Pose,
        region_location: Mapping[str, int],
        regions_at: Callable[[int], Label],
        action_durations: Mapping[str, float],
    ) -> None:
        self._times = times
        self._regions_at = cache(regions_at)
        self._actions: tuple[str | None, ...] = (None, *action_durations)
        self._durations_s = tuple(action_durations.values())
        self._initial = _initial_state(times, start)
        self._regions = _regions_by_location(times, self._initial.location, region_location)
        self._places = [location for location, names in self._regions.items() if names]
        self._roads = _Roads(times, self._places, self._durations_s)
        self._labels: dict[Label, int] = {}

    def build(self) -> TransitionSystem:
        """Expand every state once."""
        initial_label = self._label(self._initial.location, 0)
        odd, steps = self._odd()
        entries = [self._roads.key_of(step.target) for _, step in steps]
        regular = self._regular([key for key in entries if key is not None])
        number_of = np.full(2 * HEADINGS * len(self._places), -1, dtype=np.int64)
        number_of[regular] = len(odd) + np.arange(len(regular))
        rows = self._roads.steps_from(regular)
        odd_number = {state: number for number, state in enumerate(odd)}
        odd_target = [
            odd_number[step.target] if key is None else int(number_of[key])
            for key, (_, step) in zip(entries, steps, strict=True)
        ]
        odd_label = [self._label(step.target.location, step.action) for _, step in steps]
        places = self._roads.places_of(rows.target)
        label_at = self._labels_by_place()
        return TransitionSystem(
            states=(*odd, *map(self._roads.state_of, regular.tolist())),
            regions=self._regions,
            actions=self._actions,
            labels=tuple(self._labels),
            initial_label=initial_label,
            source=_joined([source for source, _ in steps], number_of[rows.source]),
            target=_joined(odd_target, number_of[rows.target]),
            action=_joined([step.action for _, step in steps], rows.action),
            label=_joined(odd_label, label_at[places, rows.action]),
            drive_s=np.append([step.drive_s for _, step in steps], rows.drive_s),
            drive_m=np.append([step.drive_m for _, step in steps], rows.drive_m),
            stay_s=np.append([step.stay_s for _, step in steps], rows.stay_s),
        )

    def _odd(self) -> tuple[list[State], list[tuple[int, _Step]]]:
        """Return the odd states, the initial one first, and their steps with their sources."""
        odd = [self._initial] if self._roads.key_of(self._initial) is None else []
        steps: list[tuple[int, _Step]] = []
        for source, state in enumerate(odd):
            for step in self._steps(state):
                steps.append((source, step))
                if self._roads.key_of(step.target) is None and step.target not in odd:
                    odd.append(step.target)
        return odd, steps

    def _regular(self, entries: Sequence[int]) -> Ints:
        """Return the keys of the regular states, by key, an initial one first."""
        initial = self._roads.key_of(self._initial)
        if initial is None:
            return self._roads.reached_from(np.unique(np.array(entries, dtype=np.int64)))
        reached = self._roads.reached_from(np.array([initial]))
        return np.append(initial, reached[reached != initial])

    def _steps(self, state: State) -> Iterator[_Step]:
        yield from self._stays(state)
        for location in self._places:
            if location != state.location:
                leg = self._times.leg_to(state.pose, location)
                yield _Step(State(location, leg.arrival), 0, leg.duration_s, leg.distance_m, 0.0)

    def _stays(self, state: State) -> Iterator[_Step]:
        """Yield the steps at the same place, over its centre if the start is beside it."""
        leg = self._times.leg_to(state.pose, state.location)
        has_arrived = leg.duration_s > 0.0
        idle = State(state.location, leg.arrival)
        yield _Step(idle, 0, leg.duration_s, leg.distance_m, 0.0 if has_arrived else IDLE_S)
        if not self._regions[state.location]:
            return
        for action, duration_s in enumerate(self._durations_s, start=1):
            if duration_s > 0.0:
                yield _Step(idle, action, leg.duration_s, leg.distance_m, duration_s)
            elif state.has_acted_instantly:
                yield _Step(idle, action, 0.0, 0.0, IDLE_S)
            else:
                instant = State(state.location, leg.arrival, has_acted_instantly=True)
                yield _Step(instant, action, leg.duration_s, leg.distance_m, 0.0)

    def _labels_by_place(self) -> Ints:
        """Return the number of the label at each place with each action."""
        actions = range(len(self._actions))
        numbers = [[self._label(place, action) for action in actions] for place in self._places]
        return np.array(numbers, dtype=np.int64).reshape(-1, len(self._actions))

    def _label(self, location: int, action: int) -> int:
        name = self._actions[action]
        label = self._regions_at(location) | ({name} if name else frozenset())
        return self._labels.setdefault(label, len(self._labels))


def _joined(odd: Sequence[int], regular: Ints) -> Ints:
    return np.concatenate((np.array(odd, dtype=np.int64), regular))


def _initial_state(times: TravelTimes, start: Pose) -> State:
    location = times.grid.location_at(start.x_m, start.y_m)
    if location is None:
        message = f"start {start!r} isn't in a free cell"
        raise LocalMisuseError(message)
    leg = times.leg_to(start, location)
    # Where nothing is to be driven the arrival is the start, rounded to the lattice.
    return State(location, leg.arrival if leg.duration_s == 0.0 else start)


def _regions_by_location(
    times: TravelTimes, start: int, region_location: Mapping[str, int]
) -> dict[int, tuple[str, ...]]:
    """Return the names of the regions at each location that can be reached from the start."""
    component = times.grid.components
    names: defaultdict[int, tuple[str, ...]] = defaultdict(tuple)
    for name, location in region_location.items():
        if component[location] == component[start]:
            names[location] += (name,)
    return {start: (), **names}
