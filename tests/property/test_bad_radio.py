"""Whole runs over a bad radio."""

from collections import defaultdict
from functools import cache
from pathlib import Path

import pytest

from support.shuffling import Shuffling
from tlcomm_core.mission import Mission
from tlcomm_core.records import event_log
from tlcomm_core.scenario.loader import load_scenario
from tlcomm_core.scenario.model import Radio
from tlcomm_core.scenario.site import Site
from tlcomm_core.simulation import Simulated, simulate

CORRIDOR = load_scenario(Path(__file__).parents[2] / "scenarios" / "corridor.yaml")
BAD = Radio(loss=0.1, loss_at_range=0.3, jitter_s=0.05, duplication=0.1, bandwidth_bps=3e5)
ROUNDS = 3


def over(radio: Radio, seed: int = 1) -> Simulated:
    """Return a run of the corridor; should meetings fail, it ends two windows late."""
    scenario = CORRIDOR.model_copy(update={"radio": radio})
    until_s = CORRIDOR.communication.period_s * (ROUNDS + 2)
    return simulate(Mission(Site.from_scenario(scenario), seed, ROUNDS, until_s))


@cache
def bad_run(seed: int = 1) -> Simulated:
    """Return a run over the bad radio, simulated once per session."""
    return over(BAD, seed)


def log_of(simulated: Simulated) -> list[str]:
    """Return the event log."""
    return list(event_log(simulated.records))


def count(simulated: Simulated, reason: str) -> int:
    """Return how many messages weren't heard for a reason."""
    counts = simulated.records.messages_undelivered.values()
    return sum(own.get(reason, 0) for own in counts)


def test_the_run_is_a_function_of_the_seed() -> None:
    """The same seed gives the same log and counts, another seed others."""
    again = over(BAD)
    assert log_of(again) == log_of(bad_run())
    assert again.records.messages_undelivered == bad_run().records.messages_undelivered
    assert log_of(bad_run(2)) != log_of(bad_run())


@pytest.mark.parametrize("seed", range(1, 5))
def test_nobody_holds_another_strategy_than_the_others(seed: int) -> None:
    """Whatever is lost, those who hold a round's strategy as agreed hold the same."""
    held = defaultdict(set)
    for record in bad_run(seed).records.strategies:
        held[record.strategy.round].add(record.strategy)
    assert len(held) > ROUNDS
    assert {len(strategies) for strategies in held.values()} == {1}


def test_a_good_share_is_lost() -> None:
    """So the other tests mean something: between the loss near by and at the range."""
    lost = count(bad_run(), "lost")
    reached = sum(bad_run().records.messages_sent.values()) * (len(CORRIDOR.agents) - 1)
    reached -= count(bad_run(), "out of range")
    assert 0.1 < lost / reached < 0.3


def test_a_narrow_band_congests() -> None:
    """If a second isn't enough for what waits, messages are dropped for it."""
    assert count(over(Radio(bandwidth_bps=3000.0)), "congested") > 0
    assert count(bad_run(), "congested") == 0


def test_the_order_in_which_members_act_does_not_matter(monkeypatch: pytest.MonkeyPatch) -> None:
    """Ticked in any order within each instant, they hear and decide the same."""
    expected = log_of(bad_run())
    shuffling = Shuffling(monkeypatch)
    assert log_of(over(BAD)) == expected
    assert shuffling.count > 50
