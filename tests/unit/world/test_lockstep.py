"""Lock step over a world of two or three bodies in a row."""

from collections.abc import Mapping

import numpy as np
import pytest

from tlcomm_core.field.field import Field
from tlcomm_core.field.sensors import Sensors
from tlcomm_core.geometry import Pose
from tlcomm_core.workspace.grid import Grid
from tlcomm_core.world.lockstep import LockStep, Reply, Step, StopRule
from tlcomm_core.world.observation import Odometry, Reading
from tlcomm_core.world.world import Body, Noise, World

MS = 1_000_000
SECOND = 1000 * MS
LATENCY = 5 * MS
# Later than most tests look.
CHANGE = 8 * SECOND + 3 * MS
NEVER = StopRule(meetings=None, until_ns=None)
IDLE = Reply(next_need_ns=None, team_messages=0, command=None, meetings_ended=0)


def lockstep(*xs_m: float, stop: StopRule = NEVER) -> LockStep:
    """Return lock step over agents ``a``, ``b``, … at some x, R = 1 m, begun at t = 0."""
    names = "abcdef"[: len(xs_m)]
    bodies = [
        Body(name, Pose(x_m, 0.5, 0.0), 1.0, 1.5) for name, x_m in zip(names, xs_m, strict=True)
    ]
    grid, rng = Grid((20.0, 1.0), 0.5), np.random.default_rng(0)
    world = World(bodies, grid, 1.0, Noise(), rng, changes=[(CHANGE, grid)])
    return LockStep(world, names, LATENCY, stop)


def reply(
    need_ns: int | None = None,
    messages: int = 0,
    command: tuple[float, float] | None = None,
    meetings: int = 0,
) -> Reply:
    """Return a reply."""
    return Reply(need_ns, messages, command, meetings)


def begun(steps: LockStep, replies: Mapping[str, Reply]) -> Step:
    """Do the first step with the given replies and return it."""
    step = steps.next_step()
    assert step is not None
    steps.complete(dict.fromkeys(step.ticked, IDLE) | dict(replies))
    return step


def next_ticked(steps: LockStep) -> Step:
    """Return the next step at which anyone is ticked; nobody has anything to do before."""
    while True:
        step = steps.next_step()
        assert step is not None
        if step.ticked:
            return step
        steps.complete({})


def test_all_are_ticked_at_the_beginning() -> None:
    """In the scenario's order, with the map, odometry of each and the connectivity to see."""
    step = lockstep(0.5, 1.0).next_step()
    assert step is not None
    assert (step.time_ns, step.ticked, step.arrived) == (0, ("a", "b"), (0, 0))
    assert len(step.observations) == 4


def test_only_those_that_are_due_are_ticked() -> None:
    """Time goes to the least need."""
    steps = lockstep(0.5, 1.0)
    begun(steps, {"a": reply(300 * MS), "b": reply(200 * MS)})
    step = next_ticked(steps)
    assert (step.time_ns, step.ticked) == (200 * MS, ("b",))
    steps.complete({"b": reply(400 * MS)})
    assert next_ticked(steps).time_ns == 300 * MS


def test_who_measures_is_ticked_again_at_once() -> None:
    """With its reading to see; nobody else is, nor who isn't at the station."""
    steps = lockstep(0.5, 3.0)
    steps._world.equip(Sensors(Field(((0.0, 7.0),), {"m": 0.0}), {"m": (0.5, 0.5, 0.1)}))
    step = steps.next_step()
    assert step is not None
    done = Reply(None, 0, None, 0, measured_at="m")
    assert steps.complete({"a": done, "b": done}) == (Reading(0, "a", "m", 7.0),)
    again = steps.next_step()
    assert again is not None
    assert (again.time_ns, again.ticked) == (0, ("a",))
    steps.complete({"a": IDLE})
    assert next_ticked(steps).time_ns == CHANGE


def test_who_comes_into_range_is_ticked_if_there_is_anything_to_measure() -> None:
    """When the link comes, not when it goes; without sensors nobody is."""
    for is_measured, ticked in ((True, ("a", "b")), (False, ("a", "b", "c"))):
        steps = lockstep(0.5, 3.0, 19.0)
        if is_measured:
            steps._world.equip(Sensors(Field(((0.0, 7.0),), {"m": 0.0}), {"m": (0.5, 0.5, 0.1)}))
        begun(steps, {"a": reply(None, command=(1.0, 0.0))})
        step = next_ticked(steps)
        assert step.ticked == ticked
        assert step.time_ns == (1500 * MS if is_measured else CHANGE)


def test_two_due_at_one_instant_are_ticked_in_the_scenarios_order() -> None:
    """Not in that of their answers."""
    steps = lockstep(0.5, 1.0, 1.5)
    begun(steps, {"c": reply(100), "a": reply(100), "b": reply(50)})
    assert next_ticked(steps).ticked == ("b",)
    steps.complete({"b": reply(100)})
    assert next_ticked(steps).ticked == ("a", "b", "c")


def test_without_needs_the_world_goes_on() -> None:
    """Its heartbeats are shown though nobody is ticked."""
    steps = lockstep(0.5, 1.0)
    begun(steps, {})
    for second in (1, 2, 3):
        step = steps.next_step()
        assert step is not None
        assert (step.time_ns, step.ticked) == (second * SECOND, ())
        assert len(step.observations) == 3
        assert steps.complete({}) == ()


def test_a_message_reaches_those_in_range_after_the_latency() -> None:
    """The others aren't ticked; what has arrived is told to all."""
    steps = lockstep(0.5, 1.0, 5.0)
    begun(steps, {"a": reply(messages=2)})
    step = next_ticked(steps)
    assert (step.time_ns, step.ticked, step.arrived) == (LATENCY, ("b",), (2, 0, 0))


def test_a_message_arrives_once() -> None:
    """Counts are cumulative; the same count again is no new message."""
    steps = lockstep(0.5, 1.0)
    begun(steps, {"a": reply(20 * MS, messages=1)})
    assert next_ticked(steps).time_ns == LATENCY
    steps.complete({"b": IDLE})
    step = next_ticked(steps)
    assert (step.time_ns, step.ticked) == (20 * MS, ("a",))
    steps.complete({"a": reply(None, messages=1)})
    step_after = steps.next_step()
    assert step_after is not None
    assert (step_after.time_ns, step_after.ticked) == (SECOND, ())


def test_messages_on_the_air_together_arrive_each_at_its_time() -> None:
    """One sent later, while another is under way, doesn't overtake it."""
    steps = lockstep(0.5, 1.0)
    begun(steps, {"a": reply(2 * MS, messages=1)})
    assert next_ticked(steps).time_ns == 2 * MS
    steps.complete({"a": reply(messages=3)})
    first = next_ticked(steps)
    assert (first.time_ns, first.arrived) == (5 * MS, (1, 0))
    steps.complete({"b": IDLE})
    second = next_ticked(steps)
    assert (second.time_ns, second.arrived) == (7 * MS, (3, 0))


def test_range_counts_at_the_arrival() -> None:
    """Who has driven out of range by then isn't ticked."""
    steps = lockstep(0.5, 1.499)
    begun(steps, {"a": reply(messages=1), "b": reply(command=(1.0, 0.0))})
    seen = []
    while (step := steps.next_step()) is not None and step.time_ns <= 2 * LATENCY:
        seen.append((step.time_ns, step.ticked, step.arrived))
        steps.complete({})
    assert [ticked for _, ticked, _ in seen] == [()] * len(seen)
    assert seen[-1] == (LATENCY, (), (1, 0))


def test_commands_are_carried_out_in_the_agents_order() -> None:
    """And what they show is returned in that order."""
    steps = lockstep(0.5, 1.0)
    steps.next_step()
    shown = steps.complete(
        {"b": reply(SECOND, command=(0.5, 0.0)), "a": reply(SECOND, command=(0.0, 1.0))}
    )
    assert all(isinstance(seen, Odometry) for seen in shown)
    assert [(s.agent, s.linear_mps, s.angular_radps) for s in shown] == [  # type: ignore[union-attr]
        ("a", 0.0, 1.0),
        ("b", 0.5, 0.0),
    ]


def test_a_run_ends_when_all_have_ended_their_meetings() -> None:
    """One agent's count isn't enough."""
    steps = lockstep(0.5, 1.0, stop=StopRule(meetings=2, until_ns=None))
    begun(steps, {"a": reply(100, meetings=2), "b": reply(200, meetings=1)})
    assert steps.meetings_ended == 1
    assert next_ticked(steps).ticked == ("a",)
    steps.complete({"a": reply(None, meetings=3)})
    assert next_ticked(steps).ticked == ("b",)
    steps.complete({"b": reply(None, meetings=2)})
    assert steps.meetings_ended == 2
    assert steps.next_step() is None


@pytest.mark.parametrize("until_ns", [0, 150, 200, 1000])
def test_a_run_ends_at_its_time(until_ns: int) -> None:
    """The last step is at that very time, whoever is due then is ticked; then nothing more."""
    steps = lockstep(0.5, 1.0, stop=StopRule(meetings=None, until_ns=until_ns))
    times = []
    while (step := steps.next_step()) is not None:
        times.append(step.time_ns)
        steps.complete({name: reply(step.time_ns + 100) for name in step.ticked})
    assert times[-1] == until_ns == steps.time_ns
    assert times[:-1] == list(range(0, until_ns, 100))


def test_the_first_of_two_stops_counts() -> None:
    """Time may end a run before its meetings do."""
    steps = lockstep(0.5, 1.0, stop=StopRule(meetings=1, until_ns=SECOND))
    begun(steps, {})
    assert steps.next_step() is not None
    assert steps.next_step() is None


def test_when_the_map_changes_all_are_ticked() -> None:
    """Whether they need that time or not: it may close their ways."""
    steps = lockstep(0.5, 1.0, 19.0)
    begun(steps, {"b": reply(20 * SECOND)})
    step = next_ticked(steps)
    assert (step.time_ns, step.ticked) == (CHANGE, ("a", "b", "c"))
