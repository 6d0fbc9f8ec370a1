"""Whole runs of teams that meet by pairs: every pair meets in every window of its schedule."""

from collections import defaultdict
from pathlib import Path

import networkx as nx
import numpy as np
import pytest

from support.changing_hall import changing_hall
from tlcomm_core.agent.actions import Fault, TaskEventKind
from tlcomm_core.agent.pairs import pairs_of
from tlcomm_core.method import Method
from tlcomm_core.metrics.connection import pair_windows_of
from tlcomm_core.mission import Mission
from tlcomm_core.records import RunRecords
from tlcomm_core.scenario.generator import random_scenario
from tlcomm_core.scenario.loader import load_scenario, verify
from tlcomm_core.scenario.model import Faults, Noise, Radio, Scenario
from tlcomm_core.scenario.site import Site
from tlcomm_core.simulation import simulate
from tlcomm_core.units import nanoseconds
from tlcomm_core.verdict import failures

PLANT = Path(__file__).parents[2] / "scenarios" / "plant.yaml"
WINDOWS = 6
AT_RANGE = Radio(loss=0.2, loss_at_range=0.5, jitter_s=0.05, duplication=0.1)
TROUBLE = {
    "noise": {"noise": Noise(linear=0.05, angular=0.05)},
    "loss": {"radio": AT_RANGE},
    "failures": {"faults": Faults(action_failure=0.2)},
    "all": {
        "noise": Noise(linear=0.03, angular=0.03),
        "radio": AT_RANGE,
        "faults": Faults(action_failure=0.1),
    },
}


def random_team(seed: int) -> Scenario:
    """Return a random scenario of three to seven agents."""
    return random_scenario(np.random.default_rng(seed), agents=3 + seed % 5)


def run(scenario: Scenario, windows: int = WINDOWS) -> tuple[RunRecords, int]:
    """Return the records of a run up to the end of so many windows, and that end."""
    # The last meeting may begin at the very end of the last window.
    timing = scenario.communication
    end_s = (windows + 1) * timing.period_s + timing.duration_s
    mission = Mission(Site.from_scenario(scenario), 1, None, end_s, method=Method.PAIRWISE)
    return simulate(mission).records, nanoseconds(end_s)


def assert_kept(scenario: Scenario, records: RunRecords, end_ns: int) -> None:
    """Assert that all pairs meet in all their windows, hold the same, and that all is well."""
    outcomes = pair_windows_of(scenario, records, end_ns)
    for pair, windows in outcomes.items():
        due = [window for window in range(WINDOWS + 1) if pair.meets_in(window)]
        kept = [window.round for window in windows if window.satisfied]
        assert kept[: len(due)] == due, pair
    assert nx.is_tree(nx.Graph(pair.members for pair in outcomes))
    held: dict[tuple[int, tuple[str, ...]], dict[str, object]] = defaultdict(dict)
    for record in records.strategies:
        held[record.strategy.round, record.strategy.members][record.agent] = record.strategy
    assert {members for _, members in held} == {tuple(sorted(p.members)) for p in outcomes}
    for (_, members), by_agent in held.items():
        assert tuple(sorted(by_agent)) == members
        assert len(set(by_agent.values())) == 1
    assert failures(scenario, records, Method.PAIRWISE, (), end_ns) == []


@pytest.mark.parametrize("seed", range(4))
def test_random_teams_keep_their_schedules(seed: int) -> None:
    """Everybody arrives when it has said, one or more meetings before; nobody misses one."""
    scenario = random_team(seed)
    records, end_ns = run(scenario)
    assert_kept(scenario, records, end_ns)
    arrivals = [r.event for r in records.tasks if r.event.kind is TaskEventKind.MEETING_REACHED]
    errors_s = [float(e.detail.partition("error_s=")[2]) for e in arrivals if e.round]
    assert max(map(abs, errors_s)) < 1e-5


@pytest.mark.parametrize("name", TROUBLE)
def test_trouble_makes_nobody_miss_a_window(name: str) -> None:
    """Who is late or has lost time is waited for, or leaves steps out."""
    scenario = random_team(3).model_copy(update=TROUBLE[name])
    assert_kept(scenario, *run(scenario))


@pytest.mark.parametrize("seed", [1, 8])
def test_changing_maps_make_nobody_miss_a_window(seed: int) -> None:
    """Wherever places close that somebody is to go to: all agree on where to meet after them."""
    scenario = changing_hall(seed)
    one = scenario.agents["one"]
    x_m, y_m, yaw_rad = one.start
    beside = one.model_copy(update={"start": (x_m, y_m + 0.5, yaw_rad)})
    longer = scenario.communication.model_copy(update={"period_s": 45.0})
    agents = scenario.agents | {"three": beside}
    three = verify(scenario.model_copy(update={"agents": agents, "communication": longer}))
    records, end_ns = run(three, 8)
    assert failures(three, records, Method.PAIRWISE, (), end_ns) == []
    faults = [own.event for own in records.tasks if own.event.kind is TaskEventKind.FAULT]
    assert {event.detail.partition("=")[0] for event in faults} == {Fault.CUT_OFF}
    kept = [
        window.satisfied
        for own in pair_windows_of(three, records, end_ns).values()
        for window in own
    ]
    assert len(kept) >= 8
    assert all(kept)


def test_a_star_keeps_its_schedule() -> None:
    """Where one is in three pairs, each pair meets in every third window."""
    scenario = load_scenario(PLANT)
    middle, *tips = list(scenario.agents)[:4]
    starts = [(4.75, 4.75, 0.0), (4.25, 4.75, 0.0), (5.25, 4.75, 0.0), (4.75, 5.25, 0.0)]
    agents = {
        name: scenario.agents[name].model_copy(update={"start": start})
        for name, start in zip((middle, *tips), starts, strict=True)
    }
    short = scenario.communication.model_copy(update={"range_m": 0.6})
    star = verify(scenario.model_copy(update={"agents": agents, "communication": short}))
    pairs = pairs_of(Site.from_scenario(star))
    assert [(pair.members, pair.first, pair.stride) for pair in pairs] == [
        ((middle, tip), first, 3) for first, tip in enumerate(tips, start=1)
    ]
    assert_kept(star, *run(star))


def test_the_plant_keeps_its_schedule() -> None:
    """Eight agents on the paper's plant, twenty windows."""
    scenario = load_scenario(PLANT)
    records, end_ns = run(scenario, 20)
    assert_kept(scenario, records, end_ns)
    (stride,) = {pair.stride for pair in pairs_of(Site.from_scenario(scenario))}
    meetings = {(own.strategy.round, own.strategy.members) for own in records.strategies}
    assert len({meeting for meeting in meetings if meeting[0] <= 20}) == 7 * 20 // stride
