"""Teams that meet where every message arrives."""

import math
from collections import Counter
from dataclasses import replace

import numpy as np
import pytest

from support.fake_network import FakeNetwork, Faults
from support.meetings import SHAPES, Meeting, plant_meeting, reference, sample_meeting
from tlcomm_core.game.algorithm import solve
from tlcomm_core.game.solver import EXACT
from tlcomm_core.game.strategy import Strategy, TeamStrategy
from tlcomm_core.protocol.actions import CountIgnored, SendMessage
from tlcomm_core.protocol.meeting_graph import meeting_graph
from tlcomm_core.protocol.messages import (
    BestResponse,
    Confirmation,
    Message,
    PlanOffer,
    Proposal,
)
from tlcomm_core.protocol.negotiation import Phase


def run(meeting: Meeting, **changes: float) -> FakeNetwork:
    """Run a meeting over a perfect network until all is silent."""
    network = FakeNetwork(
        meeting.offers,
        meeting.round,
        meeting.team,
        meeting.rounds,
        Faults(**changes),
        range_m=meeting.range_m,
    )
    network.run()
    return network


def assert_all_agreed(network: FakeNetwork, expected: TeamStrategy) -> None:
    """Check that everybody holds exactly the expected values."""
    assert network.is_agreed
    for agent in network.agents.values():
        assert agent.phase is Phase.AGREED
        assert agent.agreed == expected


def said_by(network: FakeNetwork, kind: type[Message]) -> Counter[str]:
    """Return how often each agent said a kind of message."""
    return Counter(
        entry.agent
        for entry in network.transcript
        if isinstance(entry.action, SendMessage) and isinstance(entry.action.message, kind)
    )


@pytest.mark.parametrize("shape", SHAPES)
@pytest.mark.parametrize("count", [1, 2, 3, 5, 8])
def test_all_agree_on_the_reference(shape: str, count: int) -> None:
    """On every shape all agree on what the reference finds, value by value, in as many exchanges
    as its comparisons need; nobody repeats an exchange; then all are silent.
    """
    for seed in range(3):
        meeting = sample_meeting(shape, count, seed)
        network = run(meeting)
        assert_all_agreed(network, reference(meeting))
        _, hops = meeting_graph(meeting.offers, meeting.team)
        exchanges = hops * solve(meeting.problem).search.iteration
        assert set(said_by(network, BestResponse).values()) == {exchanges}
        assert set(said_by(network, Confirmation).values()) <= set(range(1, count + 1))
        took_s = max(network.agreed_s.values()) - network.begins_s
        # A flood of offers, one hop more as the last one's question is answered; the exchanges; a
        # flood of confirmations; and 1 ns for rounding.
        assert took_s <= (hops + 1 + exchanges + hops) * 0.005 + 1e-9
        assert network.next_s == math.inf


@pytest.mark.parametrize("seed", range(2))
@pytest.mark.parametrize("shape", SHAPES)
@pytest.mark.parametrize("count", [1, 2, 5, 7])
def test_all_agree_on_the_best_proposal(shape: str, count: int, seed: int) -> None:
    """With a solver that proposes, all hold the optimum and its certificate, in one comparison of
    proposals and one of best responses.
    """
    meeting = sample_meeting(shape, count, seed)
    meeting = replace(meeting, team=replace(meeting.team, solver=EXACT))
    network, expected = run(meeting), reference(meeting)
    assert_all_agreed(network, expected)
    assert expected.bound_s == pytest.approx(expected.potential_s, abs=1e-6)
    _, hops = meeting_graph(meeting.offers, meeting.team)
    assert set(said_by(network, Proposal).values()) == {hops}
    assert set(said_by(network, BestResponse).values()) == {hops}


@pytest.mark.parametrize("seed", range(4))
def test_real_maps_and_offers_agree_too(seed: int) -> None:
    """Posed from the offers on a map, the round has the same outcome for all as the reference."""
    meeting = plant_meeting(4, seed)
    assert_all_agreed(run(meeting), reference(meeting))


@pytest.mark.parametrize("shape", ["clique", "star", "random"])
def test_twenty_agree(shape: str) -> None:
    """A large team agrees as well."""
    meeting = sample_meeting(shape, 20, 1, tasks=3)
    assert_all_agreed(run(meeting), reference(meeting))


@pytest.mark.parametrize("count", [2, 8])
def test_nothing_begins_before_the_last_one_is_here(count: int) -> None:
    """Until the last arrival everybody gathers, and asks ever more rarely."""
    meeting = sample_meeting("ring", count, 5, spread_s=50.0)
    network = FakeNetwork(meeting.offers, meeting.round, meeting.team, meeting.rounds)
    network.run(math.nextafter(network.begins_s, 0.0))
    assert all(agent.phase is Phase.GATHERING for agent in network.agents.values())
    assert len(network.agents) == count - 1
    # Each news that reach an agent reset its patience: at most 5 questions in each such pause.
    pauses_s = network.begins_s - min(offer.arrival_s for offer in meeting.offers)
    for said in network.sent().values():
        assert said <= pauses_s / meeting.team.patience_s + 7 * count
    network.run()
    assert_all_agreed(network, reference(meeting))


def test_jitter_changes_the_order_and_not_the_outcome() -> None:
    """Messages that overtake each other lead to the same agreement."""
    meeting = sample_meeting("random", 6, 4)
    for seed in range(5):
        network = FakeNetwork(
            meeting.offers,
            meeting.round,
            meeting.team,
            meeting.rounds,
            Faults(jitter_s=0.08, duplication=0.5),
            seed,
        )
        network.run()
        assert_all_agreed(network, reference(meeting))


def test_links_that_were_planned_with_suffice() -> None:
    """Pairs beyond the planned range aren't needed, even though they may be in range."""
    meeting = sample_meeting("clique", 3, 2)
    places = [(0.0, 0.0), (0.96, 0.0), (0.96, 0.25)]
    offers = tuple(
        replace(offer, x_m=x_m, y_m=y_m)
        for offer, (x_m, y_m) in zip(meeting.offers, places, strict=True)
    )
    network = FakeNetwork(offers, meeting.round, meeting.team, meeting.rounds)
    # In truth the first and the last are out of range of each other.
    network.is_cut = lambda _time_s, receiver, message: (
        {receiver, message.sender} == {"agent_00", "agent_02"}
    )
    network.run()
    assert_all_agreed(network, reference(replace(meeting, offers=offers)))


def junk(meeting: Meeting, rng: np.random.Generator) -> Message:
    """Return a message that no honest member says: foreign, of another round, or malformed."""
    members = sorted(meeting.team.members)
    stranger, member = "stranger", members[rng.integers(len(members))]
    other = meeting.round + int(rng.choice([-1, 1]))
    at = meeting.problem.strategy(0, 0, 0)
    broken = replace(at, agent=member, arrival_s=math.nan)
    nowhere = replace(at, agent=member, x_m=at.x_m + 1e-3)
    everyone = tuple(members)
    choices: list[Message] = [
        PlanOffer(stranger, meeting.round, everyone, meeting.offers),
        PlanOffer(member, other, everyone, meeting.offers),
        PlanOffer(member, meeting.round, (stranger,), ()),
        PlanOffer(member, meeting.round, (member,), (replace(meeting.offers[0], stops=()),)),
        BestResponse(stranger, meeting.round, 0, 0, stranger, -1e6, replace(at, agent=stranger)),
        BestResponse(member, other, 0, 0, member, -1e6, replace(at, agent=member)),
        BestResponse(member, meeting.round, 0, 0, member, -1e6, broken),
        BestResponse(member, meeting.round, 0, 0, member, -1e6, nowhere),
        BestResponse(member, meeting.round, 0, 99, member, -1e6, replace(at, agent=member)),
        Confirmation(stranger, meeting.round, 0, 0, everyone),
        Confirmation(member, other, 0, 0, everyone),
        Confirmation(member, meeting.round, 0, 0, everyone),
    ]
    return choices[rng.integers(len(choices))]


@pytest.mark.parametrize("seed", range(6))
def test_junk_changes_nothing(seed: int) -> None:
    """Foreign, outdated and malformed messages all along neither break nor bend the outcome,
    and are counted.
    """
    meeting = sample_meeting("random", 5, seed)
    network = FakeNetwork(meeting.offers, meeting.round, meeting.team, meeting.rounds)
    rng = np.random.default_rng(seed)
    counted = 0
    while network.next_s < math.inf:
        for agent in network.agents.values():
            counted += sum(
                isinstance(action, CountIgnored) for action in agent.hear(junk(meeting, rng))
            )
        network.step()
    assert_all_agreed(network, reference(meeting))
    assert counted > 50


def test_contradictions_after_the_first_word_change_nothing() -> None:
    """A second, different version of anything said is ignored."""
    meeting = sample_meeting("line", 4, 3)
    network = FakeNetwork(meeting.offers, meeting.round, meeting.team, meeting.rounds)
    heard = 0
    while network.next_s < math.inf:
        network.step()
        for entry in network.transcript[heard:]:
            if isinstance(entry.action, SendMessage):
                assert_contradictions_are_ignored(network, entry.action.message)
        heard = len(network.transcript)
    assert_all_agreed(network, reference(meeting))


def assert_contradictions_are_ignored(network: FakeNetwork, message: Message) -> None:
    """Tell its sender's echo to the sender, as another one's and changed."""
    sender = network.agents[message.sender]
    for name in network.agents:
        match message:
            case BestResponse(candidate=candidate) if candidate == message.sender:
                shifted: Strategy = replace(message.strategy, x_m=message.strategy.x_m + 0.5)
                forged: Message = replace(message, sender=name, hop=1, strategy=shifted)
            case PlanOffer():
                moved = replace(sender._gathering._flood.held[message.sender], x_m=-3.0)
                forged = PlanOffer(name, message.round, message.known, (moved,))
            case _:
                continue
        if sender.phase is not Phase.GATHERING or isinstance(forged, PlanOffer):
            (action,) = sender.hear(forged)
            assert isinstance(action, CountIgnored)
