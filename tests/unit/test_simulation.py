"""Whole teams in one process: they meet in time, agree, and never act on what they can't hear."""

import re
from bisect import bisect_right
from collections import defaultdict
from collections.abc import Iterator
from functools import cache
from itertools import pairwise
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
import pytest

from support.shuffling import Shuffling
from tlcomm_core.agent.actions import TaskEventKind
from tlcomm_core.agent.channel import Channel
from tlcomm_core.agent.radio import Radio
from tlcomm_core.geometry import Pose
from tlcomm_core.mission import Mission
from tlcomm_core.protocol.messages import BestResponse, Message, PlanOffer
from tlcomm_core.protocol.size import size_bytes
from tlcomm_core.records import event_log
from tlcomm_core.scenario.generator import random_scenario
from tlcomm_core.scenario.loader import load_scenario
from tlcomm_core.scenario.model import Faults, Noise, Scenario
from tlcomm_core.scenario.site import Site
from tlcomm_core.simulation import Simulated, simulate
from tlcomm_core.units import nanoseconds
from tlcomm_core.world.radio import is_connected, links
from tlcomm_core.world.unicycle import integrate

if TYPE_CHECKING:
    from tlcomm_core.world.observation import Odometry

SCENARIOS = Path(__file__).parents[2] / "scenarios"
# By what a link may be off where it is recomputed from rounded poses.
SLACK_M = 1e-9
RANDOM = [f"random {seed}" for seed in range(5)]
ROUNDS = {"corridor": 3, "plant": 2, **dict.fromkeys(RANDOM, 3)}


@cache
def scenario_of(label: str) -> Scenario:
    """Return a scenario of the project's own, or a random one with three to five agents."""
    kind, _, seed = label.partition(" ")
    if kind == "random":
        return random_scenario(np.random.default_rng(int(seed)), agents=3 + int(seed) % 3)
    return load_scenario(SCENARIOS / f"{kind}.yaml")


def mission_of(label: str, noise: float = 0.0, seed: int = 1, failing: float = 0.0) -> Mission:
    """Return a short mission; should meetings fail it ends two windows late."""
    scenario = scenario_of(label)
    disturbed = {
        "noise": Noise(linear=noise, angular=noise),
        "faults": Faults(action_failure=failing),
    }
    noisy = scenario.model_copy(update=disturbed)
    until_s = scenario.communication.period_s * (ROUNDS[label] + 2)
    return Mission(Site.from_scenario(noisy), seed, ROUNDS[label], until_s)


@cache
def run(label: str, noise: float = 0.0, seed: int = 1, failing: float = 0.0) -> Simulated:
    """Return a run, simulated once per session."""
    return simulate(mission_of(label, noise, seed, failing))


def log_of(simulated: Simulated) -> list[str]:
    """Return the event log."""
    return list(event_log(simulated.records))


def windows_of(label: str, simulated: Simulated) -> Iterator[tuple[int, int]]:
    """Yield from and to (ns) of each window that was to have its meeting."""
    period_ns = nanoseconds(scenario_of(label).communication.period_s)
    assert simulated.sim_ns > ROUNDS[label] * period_ns
    for round_ in range(ROUNDS[label] + 1):
        yield round_ * period_ns, (round_ + 1) * period_ns


def assert_windows_kept(label: str, simulated: Simulated, spans: list[tuple[int, int]]) -> None:
    """Assert that each window has a connection of D_c that begins in it; 1 µs is for rounding."""
    duration_ns = nanoseconds(scenario_of(label).communication.duration_s) - 1_000
    for opens_ns, closes_ns in windows_of(label, simulated):
        longest_ns = max(
            (to_ns - max(from_ns, opens_ns) for from_ns, to_ns in spans if from_ns < closes_ns),
            default=0,
        )
        assert longest_ns >= duration_ns, f"window from {opens_ns} ns"


def connected_by_report(simulated: Simulated) -> list[tuple[int, int]]:
    """Return when the team was connected, as the world says."""
    seen = simulated.records.connectivity
    ends = [*(later.stamp_ns for later in seen[1:]), simulated.sim_ns]
    return merged([(c.stamp_ns, end) for c, end in zip(seen, ends, strict=True) if c.connected])


def connected_by_poses(label: str, simulated: Simulated) -> list[tuple[int, int]]:
    """Return when the team was connected, from odometry alone, looked at with each and every 0.1 s.

    The time between two looks counts if the team is connected at both.
    """
    tracks = Tracks(simulated)
    stamps_ns = {seen.stamp_ns for seen in simulated.records.odometry}
    looks_ns = sorted(stamps_ns | set(range(0, simulated.sim_ns, 100_000_000)))
    names = list(scenario_of(label).agents)
    range_m = scenario_of(label).communication.range_m + SLACK_M
    connected = []
    for time_ns in looks_ns:
        poses = [tracks.pose_at(name, time_ns) for name in names]
        pairs = links(np.array([(pose.x_m, pose.y_m) for pose in poses]), range_m)
        connected.append(is_connected(len(names), pairs))
    spans = zip(pairwise(looks_ns), pairwise(connected), strict=True)
    return merged([span for span, (here, there) in spans if here and there])


class Tracks:
    """Where agents were, from odometry alone."""

    def __init__(self, simulated: Simulated) -> None:
        """Sort the odometry by agents; each agent's is in order of time."""
        self._seen: dict[str, list[Odometry]] = defaultdict(list)
        for seen in simulated.records.odometry:
            self._seen[seen.agent].append(seen)

    def pose_at(self, agent: str, time_ns: int) -> Pose:
        """Return an agent's pose, by the last odometry at or before a time."""
        seen = self._seen[agent]
        last = seen[bisect_right(seen, time_ns, key=lambda odometry: odometry.stamp_ns) - 1]
        elapsed_s = (time_ns - last.stamp_ns) * 1e-9
        return integrate(last.pose, last.linear_mps, last.angular_radps, elapsed_s)


def merged(spans: list[tuple[int, int]]) -> list[tuple[int, int]]:
    """Return adjoining spans as one."""
    whole: list[tuple[int, int]] = []
    for from_ns, to_ns in spans:
        if whole and whole[-1][1] == from_ns:
            whole[-1] = (whole[-1][0], to_ns)
        else:
            whole.append((from_ns, to_ns))
    return whole


@pytest.mark.parametrize("label", ROUNDS)
def test_no_window_is_missed(label: str) -> None:
    """By the world's account and, independently, by the poses."""
    simulated = run(label)
    assert_windows_kept(label, simulated, connected_by_report(simulated))
    assert_windows_kept(label, simulated, connected_by_poses(label, simulated))


@pytest.mark.parametrize("label", ROUNDS)
def test_all_hold_the_same_strategy(label: str) -> None:
    """For each round each agent holds one, once, and it is the same."""
    held = defaultdict(list)
    for record in run(label).records.strategies:
        held[record.strategy.round].append(record)
    assert sorted(held) == list(range(1, ROUNDS[label] + 2))
    for records in held.values():
        assert sorted(record.agent for record in records) == sorted(scenario_of(label).agents)
        assert len({record.strategy for record in records}) == 1


@pytest.mark.parametrize("label", ROUNDS)
def test_arrivals_are_as_predicted(label: str) -> None:
    """To within a microsecond, by the strategies and by what agents say of themselves."""
    records = run(label).records
    predicted_s = {
        (record.strategy.round, strategy.agent): strategy.arrival_s
        for record in records.strategies
        for strategy in record.strategy.strategies
    }
    reached = [
        record
        for record in records.tasks
        if record.event.kind is TaskEventKind.MEETING_REACHED and record.event.round > 0
    ]
    assert len(reached) >= ROUNDS[label] * len(scenario_of(label).agents)
    for record in reached:
        expected_s = predicted_s[record.event.round, record.agent]
        assert record.stamp_ns * 1e-9 == pytest.approx(expected_s, abs=1e-6)
        match = re.search(r"error_s=(\S+)", record.event.detail)
        assert match is not None
        assert abs(float(match[1])) <= 1e-6


@pytest.mark.parametrize("label", ["corridor", "plant"])
def test_tasks_are_worked_on(label: str) -> None:
    """Everyone satisfies its task, and nobody reports a fault."""
    kinds = defaultdict(set)
    for record in run(label).records.tasks:
        kinds[record.agent].add(record.event.kind)
    for agent in scenario_of(label).agents:
        assert TaskEventKind.TASK_SATISFIED in kinds[agent]
        assert TaskEventKind.FAULT not in kinds[agent]


@pytest.mark.parametrize("label", ROUNDS)
def test_without_loss_no_message_is_bad(label: str) -> None:
    """Only what is superseded or not needed is ignored."""
    bad = {"conflicting", "early", "foreign", "malformed"}
    assert not bad & run(label).ignored.keys()


@pytest.mark.parametrize("label", ["corridor", "random 1"])
@pytest.mark.parametrize("noise", [0.0, 0.05])
def test_the_same_seed_gives_the_same_run(label: str, noise: float) -> None:
    """Event logs are equal to the byte, and so are odometry and connectivity."""
    again = simulate(mission_of(label, noise))
    assert log_of(again) == log_of(run(label, noise))
    assert again.records.odometry == run(label, noise).records.odometry
    assert again.records.connectivity == run(label, noise).records.connectivity


def test_another_seed_gives_another_noise() -> None:
    """So the seed is what decides."""
    assert log_of(run("corridor", 0.05)) != log_of(run("corridor", 0.05, 2))


@pytest.mark.parametrize("label", ["corridor", "plant", "random 2"])
def test_the_order_in_which_members_act_does_not_matter(
    label: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Ticked in any order within each instant, they decide the same."""
    expected = log_of(run(label))
    shuffling = Shuffling(monkeypatch)
    assert log_of(simulate(mission_of(label))) == expected
    assert shuffling.count > 50


@pytest.mark.parametrize(("label", "noise"), [("corridor", 0.1), ("plant", 0.05)])
def test_windows_are_kept_in_spite_of_noise(label: str, noise: float) -> None:
    """With speeds off by a tenth, agents are late, but not by a window."""
    simulated = run(label, noise)
    assert_windows_kept(label, simulated, connected_by_report(simulated))


@pytest.mark.parametrize("label", ROUNDS)
@pytest.mark.parametrize("failing", [0.1, 0.5, 1.0])
def test_windows_are_kept_though_actions_fail(label: str, failing: float) -> None:
    """Whether some or all attempts fail, nobody is late, nor anybody's fault the verdict's."""
    simulated = run(label, failing=failing)
    assert_windows_kept(label, simulated, connected_by_report(simulated))
    faults = [own for own in simulated.records.tasks if own.event.kind is TaskEventKind.FAULT]
    assert all(own.event.is_failed_attempt for own in faults)
    planned_s = {own.strategy.round: own.strategy for own in simulated.records.strategies}
    for own in simulated.records.tasks:
        if own.event.kind is TaskEventKind.MEETING_REACHED and own.event.round:
            latest_s = planned_s[own.event.round].communication_s
            assert own.stamp_ns <= nanoseconds(latest_s) + 2_000
    kinds = [own.event.kind for own in simulated.records.tasks]
    assert (TaskEventKind.TASK_SATISFIED in kinds) == (failing < 1.0)


def test_the_seed_decides_which_actions_fail() -> None:
    """The same seed gives the same run, another one another."""
    expected = log_of(run("corridor", failing=0.5))
    assert log_of(simulate(mission_of("corridor", failing=0.5))) == expected
    assert log_of(run("corridor", seed=2, failing=0.5)) != expected


def most_distance_heard_m(label: str, monkeypatch: pytest.MonkeyPatch) -> float:
    """Return the largest distance, at its arrival, of any message that a radio let through."""
    names = iter(scenario_of(label).agents)
    heard: list[tuple[int, str, str]] = []
    owners: dict[int, str] = {}
    make, filter_ = Radio.__init__, Radio._distance_m

    def init(
        radio: Radio, latency_ns: int, channel: Channel, unlinked: str, lag_ns: int | None
    ) -> None:
        make(radio, latency_ns, channel, unlinked, lag_ns)
        # Members are made in the scenario's order.
        owners[id(radio)] = next(names)

    def distance_m(radio: Radio, sender: str, due_ns: int) -> float | None:
        found_m = filter_(radio, sender, due_ns)
        if found_m is not None:
            heard.append((due_ns, owners[id(radio)], sender))
        return found_m

    monkeypatch.setattr(Radio, "__init__", init)
    monkeypatch.setattr(Radio, "_distance_m", distance_m)
    tracks = Tracks(simulate(mission_of(label)))
    assert len(heard) > 100
    return max(
        tracks.pose_at(hearer, due_ns).distance_m(*_point(tracks.pose_at(sender, due_ns)))
        for due_ns, hearer, sender in heard
    )


def _point(pose: Pose) -> tuple[float, float]:
    return pose.x_m, pose.y_m


def test_nothing_is_heard_from_out_of_range(monkeypatch: pytest.MonkeyPatch) -> None:
    """Recomputed from the poses, every message that a radio let through came from within R."""
    range_m = scenario_of("corridor").communication.range_m
    assert most_distance_heard_m("corridor", monkeypatch) <= range_m + SLACK_M


def test_without_the_filter_it_would_be_heard(monkeypatch: pytest.MonkeyPatch) -> None:
    """The same measurement with the filter taken out finds what comes from far away."""
    monkeypatch.setattr(Radio, "_distance_m", lambda *_: 0.0)
    range_m = scenario_of("plant").communication.range_m
    assert most_distance_heard_m("plant", monkeypatch) > 2.0 * range_m


def test_the_filter_decides_what_agents_do(monkeypatch: pytest.MonkeyPatch) -> None:
    """Without it agents know of each other from afar, and the run is another."""
    expected = log_of(run("corridor"))
    monkeypatch.setattr(Radio, "_distance_m", lambda *_: 0.0)
    assert log_of(simulate(mission_of("corridor"))) != expected


def test_messages_are_shown_as_they_are_said() -> None:
    """As many as the records count, and as long, by each sender."""
    said: list[Message] = []
    records = simulate(mission_of("corridor"), on_message=said.append).records
    sizes = {
        name: [size_bytes(m) for m in said if m.sender == name] for name in records.messages_sent
    }
    assert {name: len(own) for name, own in sizes.items()} == records.messages_sent
    assert {name: sum(own) for name, own in sizes.items()} == records.bytes_sent
    assert {type(message) for message in said} > {PlanOffer, BestResponse}


def test_progress_is_told_at_each_instant() -> None:
    """Times ascend to the end; meetings are counted up to the last."""
    told: list[tuple[int, int]] = []
    simulated = simulate(mission_of("corridor"), on_progress=lambda *now: told.append(now))
    times = [time_ns for time_ns, _ in told]
    assert times == sorted(set(times))
    assert told[-1] == (simulated.sim_ns, ROUNDS["corridor"] + 1)
    assert [meetings for _, meetings in told] == sorted(meetings for _, meetings in told)
