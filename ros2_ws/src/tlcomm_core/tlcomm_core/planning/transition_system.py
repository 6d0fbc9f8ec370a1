"""The weighted transition system of an agent: regions with actions, exact with orientation.

- ``IDLE_S``            what staying put without an action costs
- ``State``             where the agent is and how it is turned
- ``TransitionSystem``  states and steps as arrays
- ``build``             the part that is reachable from a pose
"""

from collections import defaultdict
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cache
from types import MappingProxyType
from typing import Final

import numpy as np
from numpy.typing import NDArray

from tlcomm_core.errors import LocalMisuseError
from tlcomm_core.geometry import Pose
from tlcomm_core.planning.repertoire import Condition, Repertoire
from tlcomm_core.planning.roads import IDLE_S, Roads, State
from tlcomm_core.workspace.travel import TravelTimes

__all__ = ["IDLE_S", "State", "TransitionSystem", "build"]

_UNCONDITIONED: Final[Mapping[str, Condition]] = MappingProxyType({})

Ints = NDArray[np.int64]
Label = frozenset[str]


@dataclass(frozen=True, slots=True, eq=False)
class TransitionSystem:
    """States and *steps*: a step is a transition together with the composed state it enters.

    The composed state ⟨π, a⟩ of the paper is the place and the action of a step. Nothing that
    comes after it depends on the action but what a state's ``memory`` holds, so composed states
    that differ in the action alone are one ``State`` here; runs, labels and times are the same.

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
    conditions: Mapping[str, Condition] = _UNCONDITIONED,
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
        conditions: what actions need first, of those that need anything.

    Raises:
        LocalMisuseError: the start isn't in a free cell, a duration is negative, or a condition
            names an unknown action.

    Cost: one travel tree per region, and O(8·M²) in whole arrays for M regions, for each memory
        that comes up.
    """
    repertoire = Repertoire(action_durations, conditions)
    return _Builder(times, start, region_location, regions_at, repertoire).build()


@dataclass(frozen=True, slots=True)
class _Step:
    """One step of an odd state on the way into the arrays."""

    target: State
    action: int
    drive_s: float
    drive_m: float
    stay_s: float


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
        repertoire: Repertoire,
    ) -> None:
        self._times = times
        self._regions_at = cache(regions_at)
        self._repertoire = repertoire
        self._initial = _initial_state(times, start)
        self._regions = _regions_by_location(times, self._initial.location, region_location)
        self._places = [location for location, names in self._regions.items() if names]
        self._roads = Roads(times, self._places, repertoire, self._possible())
        self._labels: dict[Label, int] = {}

    def _possible(self) -> NDArray[np.bool_]:
        """Return which actions are possible at each place."""
        rows = [self._repertoire.possible_in(self._regions_at(place)) for place in self._places]
        return np.array(rows, dtype=np.bool_).reshape(-1, len(self._repertoire.actions))

    def build(self) -> TransitionSystem:
        """Expand every state once."""
        initial_label = self._label(self._initial.location, 0)
        odd, steps = self._odd()
        entries = [self._roads.key_of(step.target) for _, step in steps]
        regular = self._regular([key for key in entries if key is not None])
        number_of = np.full(self._roads.key_count, -1, dtype=np.int64)
        number_of[regular] = len(odd) + np.arange(len(regular))
        rows = self._roads.steps_from(regular)
        odd_number = {state: number for number, state in enumerate(odd)}
        odd_target = [
            odd_number[step.target] if key is None else int(number_of[key])
            for key, (_, step) in zip(entries, steps, strict=True)
        ]
        odd_label = [self._label(step.target.location, step.action) for _, step in steps]
        places = self._roads.places_of(rows.target)
        label_at = self._labels_by_place(places, rows.action)
        return TransitionSystem(
            states=(*odd, *map(self._roads.state_of, regular.tolist())),
            regions=self._regions,
            actions=self._repertoire.actions,
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
                arrived = State(location, leg.arrival, memory=state.memory)
                yield _Step(arrived, 0, leg.duration_s, leg.distance_m, 0.0)

    def _stays(self, state: State) -> Iterator[_Step]:
        """Yield the steps at the same place, over its centre if the start is beside it."""
        leg = self._times.leg_to(state.pose, state.location)
        has_arrived = leg.duration_s > 0.0
        idle = State(state.location, leg.arrival, memory=state.memory)
        yield _Step(idle, 0, leg.duration_s, leg.distance_m, 0.0 if has_arrived else IDLE_S)
        if not self._regions[state.location]:
            return
        memory = np.array([state.memory])
        possible = self._repertoire.possible_in(self._regions_at(state.location))
        possible &= self._repertoire.possible_after(memory)[0]
        memories = self._repertoire.memory_after(memory)[0].tolist()
        for action, duration_s in enumerate(self._repertoire.durations_s, start=1):
            calm = replace(idle, memory=memories[action])
            if not possible[action]:
                continue
            if duration_s > 0.0:
                yield _Step(calm, action, leg.duration_s, leg.distance_m, duration_s)
            elif state.has_acted_instantly:
                yield _Step(calm, action, 0.0, 0.0, IDLE_S)
            else:
                instant = replace(calm, has_acted_instantly=True)
                yield _Step(instant, action, leg.duration_s, leg.distance_m, 0.0)

    def _labels_by_place(self, places: Ints, actions: Ints) -> Ints:
        """Return the number of the label at each place with each action, of those that occur."""
        count = len(self._repertoire.actions)
        numbers = np.full((len(self._places), count), -1, dtype=np.int64)
        for pair in np.unique(places * count + actions).tolist():
            place, action = divmod(pair, count)
            numbers[place, action] = self._label(self._places[place], action)
        return numbers

    def _label(self, location: int, action: int) -> int:
        name = self._repertoire.actions[action]
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
