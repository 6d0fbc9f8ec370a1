"""Teams that meet over a bad network: safety, liveness, progress, determinism."""

import math

import pytest

from support.fake_network import FakeNetwork, Faults
from support.meetings import SHAPES, Meeting, plant_meeting, sample_meeting
from tlcomm_core.protocol.actions import HoldStrategy, SendMessage
from tlcomm_core.protocol.messages import BestResponse, Confirmation

# 30 % lost, delays up to ten times the latency and thus out of order, every fifth twice.
BAD = Faults(loss=0.3, jitter_s=0.05, duplication=0.2)
# Within this time after the last arrival all agree, by team size; measured medians are half of it
# or less. D_c is 5 s: by best responses alone, eight agents on such a network may need longer.
WITHIN_S = {1: 0.1, 2: 0.5, 3: 1.5, 4: 2.5, 5: 4.0, 6: 5.0, 7: 7.0, 8: 10.0, 20: 60.0}


def network_of(meeting: Meeting, seed: int, faults: Faults = BAD) -> FakeNetwork:
    """Return a meeting on a bad network."""
    return FakeNetwork(
        meeting.offers,
        meeting.round,
        meeting.team,
        meeting.rounds,
        faults,
        seed,
        range_m=meeting.range_m,
    )


def assert_safe(network: FakeNetwork) -> None:
    """Check that nobody held a strategy before all had confirmed, and all held the same."""
    members = network.team.members
    confirmed: set[str] = set()
    held = set()
    for entry in network.transcript:
        match entry.action:
            case SendMessage(Confirmation(sender=sender)):
                confirmed.add(sender)
            case HoldStrategy(strategy):
                held.add(strategy)
                assert confirmed | {entry.agent} == members
            case _:
                pass
    assert len(held) <= 1


def assert_no_storm(network: FakeNetwork) -> None:
    """Check that what each agent said is bounded: by what it had to say, and by time."""
    took_s = network.now_s - network.begins_s
    waited_s = network.begins_s - min(offer.arrival_s for offer in network.offers)
    count = len(network.offers)
    steps = len(
        {
            (entry.action.message.iteration, entry.action.message.hop)
            for entry in network.transcript
            if isinstance(entry.action, SendMessage)
            and isinstance(entry.action.message, BestResponse)
        }
    )
    # Each exchange once, up to three messages at each repetition, some answers for each member.
    repetitions = (took_s + waited_s) / network.team.retry_s
    for said in network.sent().values():
        assert said <= steps + 3.0 * repetitions + 20 * count


def run_campaign(meeting: Meeting, seed: int, faults: Faults = BAD) -> None:
    """Run one meeting to its silent end, and check all that must hold."""
    network = network_of(meeting, seed, faults)
    network.run_until_agreed(WITHIN_S[len(meeting.offers)])
    assert_safe(network)
    assert network.is_agreed, "not in time"
    assert_no_storm(network)
    network.run(network.now_s + 20.0)
    assert_safe(network)
    assert network.next_s == math.inf, "not silent"
    assert {agent.agreed for agent in network.agents.values()} == {
        network.agents["agent_00"].agreed
    }


@pytest.mark.parametrize("shape", SHAPES)
@pytest.mark.parametrize("count", range(1, 9))
def test_all_agree_in_time_and_fall_silent(shape: str, count: int) -> None:
    """Whatever is lost, late, doubled and reordered: one strategy, held by all in time, held by
    nobody before all confirmed it; no storm of messages, and silence in the end.
    """
    for seed in range(4):
        run_campaign(sample_meeting(shape, count, seed), seed)


def test_twenty_agree_in_time() -> None:
    """A large team does too, here with few iterations."""
    run_campaign(sample_meeting("random", 20, 1, tasks=2, max_iterations=8), 1)


@pytest.mark.parametrize("seed", range(3))
def test_real_maps_and_offers_agree_too(seed: int) -> None:
    """Nothing depends on how the round is posed."""
    run_campaign(plant_meeting(4, seed), seed)


@pytest.mark.parametrize("seed", range(5))
def test_a_terrible_network_delays_and_never_divides(seed: int) -> None:
    """With 70 % lost there may be no agreement in time, but never two."""
    network = network_of(sample_meeting("line", 4, seed), seed, Faults(0.7, 0.3, 0.5))
    network.run_until_agreed(10.0)
    assert_safe(network)
    network.run_until_agreed(600.0)
    assert network.is_agreed
    assert_safe(network)


@pytest.mark.parametrize("seed", range(4))
def test_an_outage_delays_and_does_not_stop(seed: int) -> None:
    """Nothing gets through for a while in the middle; afterwards all goes on."""
    meeting = sample_meeting("ring", 5, seed)
    network = network_of(meeting, seed, Faults())
    from_s = network.begins_s + 0.01 * (seed + 1)
    network.is_cut = lambda time_s, _receiver, _message: from_s <= time_s < from_s + 2.0
    network.run_until_agreed(10.0)
    assert network.is_agreed
    assert_safe(network)
    network.run(network.now_s + 20.0)
    assert network.next_s == math.inf


@pytest.mark.parametrize("kind", [BestResponse, Confirmation])
def test_no_agreement_without_all_of_each_kind(kind: type[BestResponse | Confirmation]) -> None:
    """While one agent's exchanges or confirmations get to nobody, nobody agrees, nor gives up."""
    meeting = sample_meeting("clique", 4, 2)
    network = network_of(meeting, 2, Faults())
    network.is_cut = lambda _time_s, _receiver, message: (
        message.sender == "agent_02" and isinstance(message, kind)
    )
    network.run(network.begins_s + 30.0)
    assert set(network.agreed_s) <= {"agent_02"}
    assert network.next_s < math.inf
    network.is_cut = lambda _time_s, _receiver, _message: False
    network.run(network.now_s + 20.0)
    assert network.is_agreed
    assert_safe(network)


def test_the_same_seed_has_the_same_transcript() -> None:
    """Ten runs on one seed do the same things at the same times, bit by bit; another doesn't."""
    meeting = sample_meeting("random", 5, 6)

    def transcript_of(seed: int) -> tuple[object, ...]:
        network = network_of(meeting, seed)
        network.run(network.begins_s + 60.0)
        return tuple(network.transcript)

    runs = {transcript_of(9) for _ in range(10)}
    assert len(runs) == 1
    assert transcript_of(10) not in runs
