"""Algorithm 1, each agent with its own candidates."""

import math
from dataclasses import replace

import pytest

from support.meetings import Meeting, sample_meeting
from support.snapshots import snapshot
from tlcomm_core.game.algorithm import solve
from tlcomm_core.game.potential import evaluate
from tlcomm_core.game.solver import BEST_RESPONSE, EXACT, solve_with
from tlcomm_core.protocol.improving import Improving
from tlcomm_core.protocol.messages import Proposal
from tlcomm_core.protocol.reception import Reception


@pytest.fixture
def meeting() -> Meeting:
    """Return two agents' round in which moves are made."""
    meeting = sample_meeting("line", 2, 1)
    assert solve(meeting.problem).iterations > 0
    return meeting


def pair_of(meeting: Meeting, max_iterations: int = 1000) -> tuple[Improving, Improving]:
    """Return both agents' parts."""
    first, second = meeting.problem.agents
    return (
        Improving(
            first, meeting.round, meeting.problem, [second], 1, BEST_RESPONSE, max_iterations
        ),
        Improving(
            second, meeting.round, meeting.problem, [first], 1, BEST_RESPONSE, max_iterations
        ),
    )


@pytest.mark.parametrize("max_iterations", [1, 2, 1000])
def test_it_ends_as_the_reference_does(meeting: Meeting, max_iterations: int) -> None:
    """Exchange by exchange both end at the reference's strategies, also when K cuts it short."""
    first, second = pair_of(meeting, max_iterations)
    comparisons = 0
    while first.result is None or second.result is None:
        for message in first.owed():
            second.hear(message)
        for message in second.owed():
            first.hear(message)
        comparisons += 1
        assert comparisons <= 100
    problem, solution = meeting.problem, solve(meeting.problem, max_iterations)
    expected = evaluate(
        problem.round,
        problem.strategies(solution.nash),
        problem.window_s[0],
        solution.iterations,
        solution.potentials_s[0],
    )
    assert first.result == second.result == expected
    assert first.iteration == second.iteration == solution.search.iteration - 1


def test_a_lone_agent_needs_nobody() -> None:
    """A team of one comes to its end by itself, telling each iteration once."""
    meeting = sample_meeting("line", 1, 5)
    lone = Improving("agent_00", meeting.round, meeting.problem, [], 1, BEST_RESPONSE, 1000)
    said = lone.owed()
    assert lone.result is not None
    assert [message.iteration for message in said] == list(range(lone.iteration + 1))
    assert lone.owed() == []


def test_there_is_no_result_before_the_others_were_heard(meeting: Meeting) -> None:
    """An agent with a silent neighbour says one thing, and waits."""
    first, _ = pair_of(meeting)
    assert [(m.iteration, m.hop) for m in first.owed()] == [(0, 0)]
    assert first.owed() == []
    assert first.result is None
    assert not first.is_begun_by_all
    assert len(first.unsuperseded) == 1


def test_the_beginning_of_all_is_seen(meeting: Meeting) -> None:
    """Once its neighbours were heard, an agent knows that they hold all offers."""
    first, second = pair_of(meeting)
    first.hear(second.owed()[0])
    assert first.is_begun_by_all


_BROKEN = {
    "candidate unknown": ({"candidate": "stranger"}, {"agent": "stranger"}, Reception.FOREIGN),
    "strategy of nobody": ({}, {"agent": "stranger"}, Reception.FOREIGN),
    "strategy of another": ({}, {"agent": "agent_00"}, Reception.MALFORMED),
    "a loss": ({"change_s": 1e-3}, {}, Reception.MALFORMED),
    "no number": ({"change_s": math.nan}, {}, Reception.MALFORMED),
    "an endless gain": ({"change_s": -math.inf}, {}, Reception.MALFORMED),
    "nowhere": ({}, {"x_m": math.nan}, Reception.MALFORMED),
    "between the locations": ({}, {"x_m": 0.123}, Reception.MALFORMED),
    "infinitely far": ({}, {"y_m": math.inf}, Reception.MALFORMED),
    "never there": ({}, {"arrival_s": math.inf}, Reception.MALFORMED),
    "there at no time": ({}, {"arrival_s": math.nan}, Reception.MALFORMED),
    "there too late": ({}, {"arrival_s": 1e6}, Reception.MALFORMED),
    "at no cost known": ({}, {"extra_travel_s": math.nan}, Reception.MALFORMED),
}


@pytest.mark.parametrize("name", _BROKEN)
def test_impossible_values_change_nothing(meeting: Meeting, name: str) -> None:
    """A best response that no agent can have is named and ignored."""
    first, second = pair_of(meeting)
    sound = second.owed()[0]
    in_message, in_strategy, reception = _BROKEN[name]
    broken = replace(sound, strategy=replace(sound.strategy, **in_strategy), **in_message)
    before = snapshot(first)
    assert first.hear(broken) is reception
    assert snapshot(first) == before
    assert first.hear(sound) is Reception.ACCEPTED


def proposing_pair(meeting: Meeting) -> tuple[Improving, Improving]:
    """Return both agents' parts with a solver that proposes."""
    first, second = meeting.problem.agents
    return (
        Improving(first, meeting.round, meeting.problem, [second], 1, EXACT, 1000),
        Improving(second, meeting.round, meeting.problem, [first], 1, EXACT, 1000),
    )


def proposal_of(part: Improving) -> Proposal:
    """Return what an agent proposes."""
    (proposal,) = part.owed()
    assert isinstance(proposal, Proposal)
    return proposal


def test_the_best_proposal_is_taken_by_both(meeting: Meeting) -> None:
    """After one comparison of proposals and one of responses both hold the optimum, proven."""
    first, second = proposing_pair(meeting)
    for _ in range(2):
        said = first.owed(), second.owed()
        for message in said[0]:
            assert second.hear(message) is Reception.ACCEPTED
        for message in said[1]:
            assert first.hear(message) is Reception.ACCEPTED
    assert first.owed() == second.owed() == []
    solved = solve_with(EXACT, meeting.problem)
    assert first.result is not None
    assert first.result == second.result
    assert first.result.potential_s == solved.solution.potentials_s[-1]
    assert first.result.bound_s == solved.bound_s


_DISHONEST = {
    "of nobody": ({"candidate": "stranger"}, Reception.FOREIGN),
    "less than it costs": ({"potential_s": -1.0}, Reception.MALFORMED),
    "no potential": ({"potential_s": math.nan}, Reception.MALFORMED),
    "better than possible": ({"bound_s": 1e6}, Reception.MALFORMED),
    "no bound": ({"bound_s": math.nan}, Reception.MALFORMED),
    "nobody's strategies": ({"strategies": ()}, Reception.MALFORMED),
    "in a later comparison": ({"iteration": 1}, Reception.MALFORMED),
}


@pytest.mark.parametrize("name", _DISHONEST)
def test_dishonest_proposals_change_nothing(meeting: Meeting, name: str) -> None:
    """A proposal that isn't what it claims is named and ignored."""
    first, second = proposing_pair(meeting)
    sound = proposal_of(second)
    in_message, reception = _DISHONEST[name]
    before = snapshot(first)
    assert first.hear(replace(sound, **in_message)) is reception
    assert snapshot(first) == before
    assert first.hear(sound) is Reception.ACCEPTED


def test_members_with_other_solvers_do_not_mix(meeting: Meeting) -> None:
    """Where one proposes and the other doesn't, neither takes the other's first word."""
    proposing, _ = proposing_pair(meeting)
    _, responding = pair_of(meeting)
    assert responding.hear(proposal_of(proposing)) is Reception.MALFORMED
    assert proposing.hear(responding.owed()[0]) is Reception.MALFORMED
