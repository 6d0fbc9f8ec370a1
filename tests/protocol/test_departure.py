"""Who leaves when the meeting is over, and who then still lacks the last word.

Agreement over a lossy network can't be had for certain by a fixed time: of two neighbours one may
hold the strategy as agreed and leave, and the other lack its last word. These tests say what the
negotiation does about that; where agents go then is ``test_reunion``'s.
"""

import math

import pytest

from support.fake_network import FakeNetwork, Faults
from support.meetings import Meeting, sample_meeting
from tlcomm_core.protocol.actions import HoldStrategy
from tlcomm_core.protocol.messages import Confirmation
from tlcomm_core.protocol.negotiation import Phase


def network_of(meeting: Meeting, faults: Faults, seed: int = 0) -> FakeNetwork:
    """Return a meeting."""
    return FakeNetwork(meeting.offers, meeting.round, meeting.team, meeting.rounds, faults, seed)


@pytest.fixture
def left_behind() -> FakeNetwork:
    """Return a line of two after the meeting: the first lost all confirmations of the second,
    which has left.
    """
    meeting = sample_meeting("line", 2, 1)
    network = network_of(meeting, Faults())
    network.is_cut = lambda _time_s, receiver, message: (
        receiver == "agent_00" and isinstance(message, Confirmation)
    )
    network.run(network.begins_s + meeting.team.duration_s)
    assert set(network.agreed_s) == {"agent_01"}
    network.leave("agent_01")
    return network


def test_who_lacks_the_last_confirmation_stays_in_doubt(left_behind: FakeNetwork) -> None:
    """It never holds as agreed what it can't know all to have confirmed; it goes on asking, and
    has what it has promised to go by.
    """
    left_behind.is_cut = lambda _time_s, _receiver, _message: False
    left_behind.run(left_behind.now_s + 60.0)
    last = left_behind.agents["agent_00"]
    assert last.phase is Phase.CONFIRMING
    assert last.agreed is None
    (held,) = [e.action for e in left_behind.transcript if isinstance(e.action, HoldStrategy)]
    assert last.confirmed == held.strategy
    assert last.next_need_s < math.inf


def test_a_neighbour_that_is_still_here_answers() -> None:
    """Had the other stayed until it was settled, the first would have got its word."""
    meeting = sample_meeting("line", 2, 1)
    network = network_of(meeting, Faults())
    network.is_cut = lambda time_s, receiver, message: (
        receiver == "agent_00"
        and isinstance(message, Confirmation)
        and time_s < network.begins_s + meeting.team.duration_s
    )
    network.run()
    assert network.is_agreed
    agreed = {agent.agreed for agent in network.agents.values()}
    assert len(agreed) == 1


def test_who_is_settled_may_leave() -> None:
    """Once an agent is silent, its neighbours need it no more: they agree without it."""
    for seed in range(20):
        meeting = sample_meeting("random", 5, seed)
        network = network_of(meeting, Faults(0.3, 0.05, 0.2), seed)
        while not network.is_agreed:
            network.step()
            for name in sorted(network.agents):
                agent = network.agents[name]
                if agent.phase is Phase.AGREED and agent.next_need_s == math.inf:
                    network.leave(name)
            assert network.now_s < network.begins_s + 60.0


@pytest.mark.parametrize("shape", ["line", "random"])
def test_on_a_network_that_loses_little_all_leave_together(shape: str) -> None:
    """With 5 % lost and a latency of 5 ms, four agents leave at t_c + D_c with the same word."""
    for seed in range(10):
        meeting = sample_meeting(shape, 4, seed)
        network = network_of(meeting, Faults(loss=0.05), seed)
        network.run_until_agreed(meeting.team.duration_s)
        assert network.is_agreed
