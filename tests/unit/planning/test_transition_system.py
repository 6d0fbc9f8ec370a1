"""The transition system of a small plant."""

import math

import numpy as np
import pytest

from support.small_plant import ACTIONS, START, SmallPlant
from tlcomm_core.errors import LocalMisuseError
from tlcomm_core.geometry import Pose
from tlcomm_core.planning.transition_system import IDLE_S, TransitionSystem, build

PLANT = SmallPlant()


def named_steps(system: TransitionSystem, source: int) -> dict[tuple[str, str | None], int]:
    """Return a state's steps by (region, action)."""
    steps = np.flatnonzero(system.source == source).tolist()
    return {
        (
            "".join(system.regions[system.states[system.target[step]].location]),
            system.actions[system.action[step]],
        ): step
        for step in steps
    }


def state_in(system: TransitionSystem, region: str) -> int:
    """Return the first state at a region."""
    location = PLANT.location(region)
    return next(i for i, state in enumerate(system.states) if state.location == location)


def test_every_state_is_the_initial_one_or_entered_by_some_step() -> None:
    """Nothing unreachable is generated, and every target exists."""
    system = PLANT.system()
    assert set(system.target.tolist()) | {0} == set(range(len(system.states)))
    assert (np.diff(system.source) >= 0).all()


def test_a_step_drives_elsewhere_without_acting_or_acts_on_the_spot() -> None:
    """From p: every other region with action None, and every action at p."""
    system = PLANT.system()
    steps = named_steps(system, state_in(system, "p"))
    elsewhere = {("hall", None), ("r", None), ("m", None)}
    assert set(steps) == elsewhere | {("p", None), ("p", "collect"), ("p", "unload")}


def test_times_are_those_of_the_legs_driven_and_of_the_actions() -> None:
    """Every step costs its leg from the exact pose, plus the action's duration or idling."""
    system = PLANT.system()
    for step, (source, target) in enumerate(zip(system.source, system.target, strict=True)):
        state = system.states[source]
        leg = PLANT.times.leg_to(state.pose, system.states[target].location)
        assert system.drive_s[step] == leg.duration_s
        assert system.drive_m[step] == pytest.approx(leg.distance_m)
        assert system.states[target].pose == leg.arrival
        action = system.actions[system.action[step]]
        idle_s = IDLE_S if source == target or leg.duration_s == 0.0 else 0.0
        assert system.stay_s[step] == (ACTIONS[action] if action else idle_s)


def test_a_label_holds_all_regions_around_and_the_action() -> None:
    """Collecting at p is in p and in the hall around it."""
    system = PLANT.system()
    step = named_steps(system, state_in(system, "p"))["p", "collect"]
    assert system.labels[system.label[step]] == {"p", "hall", "collect"}


def test_the_initial_label_holds_the_regions_around_the_start() -> None:
    """The start in the middle is in none; beside p it is in the hall."""
    assert PLANT.system().labels[PLANT.system().initial_label] == set()
    beside = PLANT.system(Pose(0.75, 0.75, 0.0))
    assert beside.labels[beside.initial_label] == {"hall"}


def test_a_region_that_is_walled_in_is_left_out() -> None:
    """No state is in the vault, and no label names it."""
    system = PLANT.system()
    assert PLANT.location("vault") not in {state.location for state in system.states}
    assert not any("vault" in label for label in system.labels)


def test_outside_the_regions_the_start_can_only_idle_or_be_left() -> None:
    """The start has one step on the spot, and no other state leads back to it."""
    system = PLANT.system()
    on_the_spot = np.flatnonzero((system.source == 0) & (system.target == 0))
    assert system.action[on_the_spot].tolist() == [0]
    assert not ((system.source != 0) & (system.target == 0)).any()


def test_a_start_on_a_region_with_a_yaw_of_its_own_is_a_state_of_that_region() -> None:
    """At p's centre all actions are open at once, and the yaw is kept exactly."""
    start = Pose(0.25, 0.25, 0.3)
    system = PLANT.system(start)
    assert system.states[0].pose == start
    steps = named_steps(system, 0)
    assert system.drive_s[steps["p", "collect"]] == 0.0
    assert system.target[steps["p", "collect"]] == 0


def test_a_start_that_is_all_but_a_lattice_state_is_that_state() -> None:
    """A yaw that is off by rounding alone makes no state of its own."""
    system = PLANT.system(Pose(0.25, 0.25, 1e-9))
    assert system.states[0].pose == Pose(0.25, 0.25, 0.0)
    assert len(set(system.states)) == len(PLANT.system(Pose(0.25, 0.25, 0.0)).states)


def test_a_start_beside_the_centre_drives_over_it() -> None:
    """Acting at p from beside its centre costs the way there; having arrived needs no idling."""
    system = PLANT.system(Pose(0.35, 0.25, math.pi))
    steps = named_steps(system, 0)
    assert system.drive_s[steps["p", "collect"]] == pytest.approx(0.1)
    assert system.stay_s[steps["p", None]] == 0.0


def test_regions_at_one_location_share_its_states() -> None:
    """Two names for one place make one place with both names."""
    location = PLANT.location("p")
    system = build(PLANT.times, START, {"p": location, "q": location}, PLANT.regions_at, {})
    assert system.regions[location] == ("p", "q")
    assert len({state.location for state in system.states}) == 2


def test_no_loop_takes_zero_time_even_if_actions_do() -> None:
    """The steps that take no time form no cycle."""
    system = PLANT.system(actions={"beep": 0.0, "blink": 0.0})
    instant = system.time_s == 0.0
    assert instant.any()
    count = len(system.states)
    matrix = np.zeros((count, count))
    matrix[system.source[instant], system.target[instant]] = 1.0
    assert not np.linalg.matrix_power(matrix, count).any()


@pytest.mark.parametrize("duration_s", [-1.0, math.nan])
def test_a_duration_that_is_none_is_refused(duration_s: float) -> None:
    """A negative duration, or none at all, is quoted in the error."""
    with pytest.raises(LocalMisuseError, match=repr(duration_s)):
        PLANT.system(actions={"collect": duration_s})


def test_a_start_in_a_wall_is_refused() -> None:
    """The pose is quoted in the error."""
    with pytest.raises(LocalMisuseError, match=r"2\.0"):
        PLANT.system(Pose(2.0, 2.0, 0.0))


def test_building_twice_gives_the_same_arrays() -> None:
    """Numbering depends on nothing but the input."""
    one, other = PLANT.system(START), SmallPlant().system(START)
    assert one.states == other.states
    assert one.labels == other.labels
    for name in ("source", "target", "action", "label", "drive_s", "drive_m", "stay_s"):
        assert np.array_equal(getattr(one, name), getattr(other, name))


def test_without_regions_the_start_can_idle() -> None:
    """A plant without regions has one state and one step."""
    system = SmallPlant(()).system()
    assert [state.pose for state in system.states] == [START]
    assert system.stay_s.tolist() == [IDLE_S]


@pytest.mark.parametrize("start", [START, Pose(0.25, 0.25, 0.3), Pose(0.25, 0.25, 0.0)])
def test_the_first_state_is_the_start_and_none_is_told_twice(start: Pose) -> None:
    """Whether the start is a lattice state or not, it is number 0, and states differ."""
    system = PLANT.system(start, {"beep": 0.0, "collect": 4.0})
    assert system.states[0].pose == start
    assert len(set(system.states)) == len(system.states)
    assert len(set(system.labels)) == len(system.labels)
