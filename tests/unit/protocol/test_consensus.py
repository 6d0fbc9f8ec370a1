"""The neighbour-min consensus."""

from dataclasses import replace

import numpy as np
import pytest

from support.meetings import SHAPES, places
from support.snapshots import snapshot
from tlcomm_core.errors import LocalMisuseError
from tlcomm_core.game.strategy import Strategy
from tlcomm_core.protocol.consensus import MinimumConsensus
from tlcomm_core.protocol.messages import BestResponse, Proposal
from tlcomm_core.protocol.reception import Reception
from tlcomm_core.world.radio import diameter, links, neighbours


def strategy_of(agent: str, task_index: int = 0) -> Strategy:
    """Return some strategy of an agent."""
    return Strategy(agent, 0.5, 0.5, task_index, 70.0, 2.0)


def said(sender: str, iteration: int, hop: int, change_s: float, by: str = "") -> BestResponse:
    """Return a message of round 1."""
    candidate = by or sender
    return BestResponse(sender, 1, iteration, hop, candidate, change_s, strategy_of(candidate))


@pytest.fixture
def middle() -> MinimumConsensus:
    """Return agent b of the line a–b–c–d (D = 3), in its first exchange."""
    consensus = MinimumConsensus("b", ["a", "c"], 3)
    consensus.begin(said("b", 0, 0, -2.0))
    return consensus


@pytest.mark.parametrize("shape", SHAPES)
@pytest.mark.parametrize("count", [1, 2, 3, 6, 9])
def test_all_conclude_the_same_minimum(shape: str, count: int) -> None:
    """After D exchanges all hold the least change, of equals the first name, in each iteration."""
    rng = np.random.default_rng(count)
    pairs = links(np.array(places(shape, count, rng)), 0.96)
    exchanges = max(1, diameter(count, pairs) or 0)
    adjacent = neighbours(count, pairs)
    team = [
        MinimumConsensus(str(agent), map(str, nodes), exchanges)
        for agent, nodes in enumerate(adjacent)
    ]
    for iteration in range(3):
        changes_s = (-rng.integers(0, 4, count)).tolist()
        said_now = [
            one.begin(said(str(agent), 0, 0, change_s))
            for agent, (one, change_s) in enumerate(zip(team, changes_s, strict=True))
        ]
        least = min((change_s, str(agent)) for agent, change_s in enumerate(changes_s))
        for hop in range(exchanges):
            assert {message.hop for message in said_now} == {hop}
            for agent, nodes in enumerate(adjacent):
                for node in nodes:
                    assert team[agent].hear(said_now[node]) is Reception.ACCEPTED
            if hop < exchanges - 1:
                assert all(one.conclusion is None for one in team)
                said_now = [message for one in team if (message := one.advance())]
        conclusions = [one.conclusion for one in team]
        assert {(c.change_s, c.candidate) for c in conclusions if c} == {least}
        assert {c.strategy for c in conclusions if c} == {strategy_of(least[1])}
        assert {one.iteration for one in team} == {iteration}
        assert all(one.advance() is None for one in team)


def test_no_exchange_ends_before_all_neighbours_are_heard(middle: MinimumConsensus) -> None:
    """One missing neighbour holds the exchange up."""
    assert middle.hear(said("a", 0, 0, -1.0)) is Reception.ACCEPTED
    assert not middle.has_heard_all
    assert middle.advance() is None
    assert middle.hear(said("c", 0, 0, -3.0)) is Reception.ACCEPTED
    assert middle.has_heard_all
    message = middle.advance()
    assert message == said("b", 0, 1, -3.0, by="c")


def test_it_says_whose_word_it_waits_for(middle: MinimumConsensus) -> None:
    """A neighbour that is missing in the exchange under way, the first by name."""
    assert middle.awaited == "a"
    middle.hear(said("a", 0, 0, -1.0))
    assert middle.awaited == "c"
    middle.hear(said("c", 0, 0, -3.0))
    assert middle.awaited is None
    middle.hear(said("a", 0, 1, -3.0, by="c"))
    middle.advance()
    assert middle.awaited == "c"


def test_a_message_one_step_ahead_is_kept(middle: MinimumConsensus) -> None:
    """A neighbour that is one exchange ahead needn't repeat itself later."""
    assert middle.hear(said("a", 0, 1, -1.0)) is Reception.ACCEPTED
    assert middle.hear(said("a", 0, 0, -1.0)) is Reception.ACCEPTED
    assert middle.hear(said("c", 0, 0, 0.0)) is Reception.ACCEPTED
    assert middle.advance() is not None
    assert middle.hear(said("c", 0, 1, -4.0)) is Reception.ACCEPTED
    assert middle.advance() == said("b", 0, 2, -4.0, by="c")


def test_a_neighbours_next_word_stands_for_a_lost_one(middle: MinimumConsensus) -> None:
    """Within an iteration it is the least of more words; the last step's has no substitute."""
    middle.hear(said("a", 0, 1, -3.0, by="x"))
    assert middle.awaited == "c"
    middle.hear(said("c", 0, 0, 0.0))
    assert middle.awaited is None
    assert middle.advance() == said("b", 0, 1, -3.0, by="x")
    middle.hear(said("c", 0, 2, -4.0, by="y"))
    assert middle.advance() == said("b", 0, 2, -4.0, by="y")
    middle.hear(said("c", 0, 2, -4.0, by="y"))
    middle.hear(said("a", 1, 0, -9.0))
    assert middle.awaited == "a"
    assert middle.conclusion is None
    middle.hear(said("a", 0, 2, -3.0, by="x"))
    assert middle.conclusion == said("b", 0, 2, -4.0, by="y")


def test_the_last_two_messages_are_repeated(middle: MinimumConsensus) -> None:
    """A neighbour one step behind may need the last but one, and none before that."""
    assert middle.unsuperseded == (said("b", 0, 0, -2.0),)
    for hop in range(3):
        middle.hear(said("a", 0, hop, -2.5, by="a"))
        middle.hear(said("c", 0, hop, -1.0, by="c"))
        middle.advance()
    assert [message.hop for message in middle.unsuperseded] == [1, 2]
    middle.begin(said("b", 0, 0, 0.0))
    assert [(m.iteration, m.hop) for m in middle.unsuperseded] == [(0, 2), (1, 0)]


_IGNORED = {
    "late": (said("a", 0, 0, -1.0), Reception.LATE),
    "repeated": (said("a", 0, 1, -1.0), Reception.DUPLICATE),
    "different": (said("a", 0, 1, -1.5), Reception.CONFLICTING),
    "another strategy": (
        replace(said("a", 0, 1, -1.0), strategy=strategy_of("a", 5)),
        Reception.CONFLICTING,
    ),
    "two steps ahead": (said("a", 1, 0, -1.0), Reception.EARLY),
    "an iteration ahead": (said("a", 1, 1, -1.0), Reception.EARLY),
    "not a neighbour": (said("d", 0, 1, -1.0), Reception.UNNEEDED),
    "oneself": (said("b", 0, 1, -1.0), Reception.UNNEEDED),
    "no such hop": (said("c", 0, 3, -1.0), Reception.MALFORMED),
    "hop before the first": (said("c", 0, -1, -1.0), Reception.MALFORMED),
    "iteration before the first": (said("c", -1, 1, -1.0), Reception.MALFORMED),
    "first hop of another": (said("c", 1, 0, -1.0, by="d"), Reception.MALFORMED),
    "of oneself, otherwise": (said("c", 0, 1, -2.5, by="b"), Reception.CONFLICTING),
}


@pytest.mark.parametrize("name", _IGNORED)
def test_what_changes_nothing_is_named(middle: MinimumConsensus, name: str) -> None:
    """Late, early, repeated, contradictory, malformed and unneeded messages leave no trace."""
    middle.hear(said("a", 0, 0, -1.0))
    middle.hear(said("c", 0, 0, -1.0))
    middle.advance()
    middle.hear(said("a", 0, 1, -1.0))
    before = snapshot(middle)
    message, reception = _IGNORED[name]
    assert middle.hear(message) is reception
    assert snapshot(middle) == before


def test_an_own_response_that_returns_is_accepted(middle: MinimumConsensus) -> None:
    """The smallest change may be one's own, told back by a neighbour."""
    middle.hear(said("a", 0, 0, -1.0))
    middle.hear(said("c", 0, 0, -1.0))
    middle.advance()
    assert middle.hear(said("c", 0, 1, -2.0, by="b")) is Reception.ACCEPTED


def test_an_iteration_begins_after_the_last_exchange_only(middle: MinimumConsensus) -> None:
    """To begin one in the middle of another is a bug of ours."""
    with pytest.raises(LocalMisuseError, match="step 0"):
        middle.begin(said("b", 0, 0, 0.0))


def test_before_the_first_iteration_there_is_none() -> None:
    """Nothing is under way, concluded or to be repeated."""
    consensus = MinimumConsensus("b", ["a"], 2)
    assert consensus.iteration == -1
    assert consensus.conclusion is None
    assert consensus.unsuperseded == ()
    consensus.begin(said("b", 0, 0, 0.0))
    assert consensus.iteration == 0


def proposed(sender: str, hop: int, potential_s: float, bound_s: float, by: str = "") -> Proposal:
    """Return a proposal of round 1."""
    candidate = by or sender
    strategies = (strategy_of(candidate),)
    return Proposal(sender, 1, 0, hop, candidate, potential_s, bound_s, strategies)


def test_of_proposals_the_least_potential_wins_and_every_bound_counts() -> None:
    """What is told on is the best proposal, with the lowest of all bounds heard of."""
    consensus = MinimumConsensus("b", ["a", "c"], 2)
    consensus.begin(proposed("b", 0, 5.0, 4.0))
    consensus.hear(proposed("a", 0, 4.5, 4.5))
    consensus.hear(proposed("c", 0, 6.0, 3.5))
    assert consensus.advance() == proposed("b", 1, 4.5, 3.5, by="a")
    assert consensus.hear(proposed("a", 1, 4.5, 3.0, by="a")) is Reception.ACCEPTED
    assert consensus.hear(proposed("c", 1, 5.0, 2.0, by="b")) is Reception.ACCEPTED
    assert consensus.conclusion == proposed("b", 1, 4.5, 2.0, by="a")


def test_a_proposal_of_ones_own_that_returns_changed_is_refused() -> None:
    """Its bound may have fallen on the way, its potential may not have."""
    consensus = MinimumConsensus("b", ["a"], 2)
    consensus.begin(proposed("b", 0, 5.0, 4.0))
    assert consensus.hear(proposed("a", 1, 5.0, 1.0, by="b")) is Reception.ACCEPTED
    assert consensus.hear(proposed("a", 1, 4.0, 1.0, by="b")) is Reception.CONFLICTING
