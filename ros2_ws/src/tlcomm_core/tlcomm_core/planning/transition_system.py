"""The weighted transition system of an agent: regions with actions, exact with orientation.

- ``IDLE_S``            what staying put without an action costs
- ``State``             where the agent is and how it is turned
- ``TransitionSystem``  states and steps as arrays
- ``build``             the part that is reachable from a pose
"""

from collections import defaultdict
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from tlcomm_core.errors import LocalMisuseError
from tlcomm_core.geometry import Pose
from tlcomm_core.workspace.travel import TravelTimes

__all__ = ["IDLE_S", "State", "TransitionSystem", "build"]

IDLE_S: Final = 1.0

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

    Cost: one travel tree per region, and at most 8·M² legs for M regions.
    """
    for action, duration_s in action_durations.items():
        if not duration_s >= 0.0:
            message = f"duration of action {action!r} is {duration_s!r}, expected ≥ 0"
            raise LocalMisuseError(message)
    return _Builder(times, start, region_location, regions_at, action_durations).build()


@dataclass(frozen=True, slots=True)
class _Step:
    """One step on the way into the arrays."""

    target: State
    action: int
    drive_s: float
    stay_s: float


class _Builder:
    """The search from the start, breadth first."""

    def __init__(
        self,
        times: TravelTimes,
        start: Pose,
        region_location: Mapping[str, int],
        regions_at: Callable[[int], Label],
        action_durations: Mapping[str, float],
    ) -> None:
        self._times = times
        self._regions_at = regions_at
        self._actions: tuple[str | None, ...] = (None, *action_durations)
        self._durations_s = tuple(action_durations.values())
        self._initial = _initial_state(times, start)
        self._regions = _regions_by_location(times, self._initial.location, region_location)
        self._labels: dict[Label, int] = {}

    def build(self) -> TransitionSystem:
        """Expand every state once."""
        number = {self._initial: 0}
        queue = [self._initial]
        rows: list[tuple[int, int, int, int]] = []
        seconds: list[tuple[float, float]] = []
        initial_label = self._label(self._initial.location, 0)
        for source, state in enumerate(queue):
            for step in self._steps(state):
                if step.target not in number:
                    number[step.target] = len(queue)
                    queue.append(step.target)
                label = self._label(step.target.location, step.action)
                rows.append((source, number[step.target], step.action, label))
                seconds.append((step.drive_s, step.stay_s))
        indices = np.array(rows, dtype=np.int64)
        times_s = np.array(seconds, dtype=np.float64)
        return TransitionSystem(
            states=tuple(queue),
            regions=self._regions,
            actions=self._actions,
            labels=tuple(self._labels),
            initial_label=initial_label,
            source=indices[:, 0],
            target=indices[:, 1],
            action=indices[:, 2],
            label=indices[:, 3],
            drive_s=times_s[:, 0],
            stay_s=times_s[:, 1],
        )

    def _steps(self, state: State) -> Iterator[_Step]:
        yield from self._stays(state)
        for location, names in self._regions.items():
            if location != state.location and names:
                leg = self._times.leg_to(state.pose, location)
                yield _Step(State(location, leg.arrival), 0, leg.duration_s, 0.0)

    def _stays(self, state: State) -> Iterator[_Step]:
        """Yield the steps at the same place, over its centre if the start is beside it."""
        leg = self._times.leg_to(state.pose, state.location)
        has_arrived = leg.duration_s > 0.0
        idle = State(state.location, leg.arrival)
        yield _Step(idle, 0, leg.duration_s, 0.0 if has_arrived else IDLE_S)
        if not self._regions[state.location]:
            return
        for action, duration_s in enumerate(self._durations_s, start=1):
            if duration_s > 0.0:
                yield _Step(idle, action, leg.duration_s, duration_s)
            elif state.has_acted_instantly:
                yield _Step(idle, action, 0.0, IDLE_S)
            else:
                instant = State(state.location, leg.arrival, has_acted_instantly=True)
                yield _Step(instant, action, leg.duration_s, 0.0)

    def _label(self, location: int, action: int) -> int:
        name = self._actions[action]
        label = self._regions_at(location) | ({name} if name else frozenset())
        return self._labels.setdefault(label, len(self._labels))


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
