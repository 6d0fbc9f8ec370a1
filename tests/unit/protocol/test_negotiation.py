"""One agent's state machine."""

import math
from dataclasses import replace

import pytest

from support.fake_network import FakeNetwork
from support.meetings import Meeting, sample_meeting
from tlcomm_core.errors import InfeasibleRoundError
from tlcomm_core.game.problem import Candidates
from tlcomm_core.protocol.actions import Action, CountIgnored, HoldStrategy, SendMessage
from tlcomm_core.protocol.messages import BestResponse, Confirmation, Message, PlanOffer
from tlcomm_core.protocol.negotiation import Negotiation, Phase

START_S = 100.0


def negotiation_of(meeting: Meeting, index: int = 0) -> Negotiation:
    """Return one agent's part."""
    return Negotiation(meeting.offers[index], meeting.round, meeting.team, meeting.rounds)


def messages_in(negotiation: Negotiation, now_s: float) -> list[Message]:
    """Return what is said at a time."""
    actions = negotiation.proceed(now_s)
    return [action.message for action in actions if isinstance(action, SendMessage)]


@pytest.fixture
def meeting() -> Meeting:
    """Return a line of three."""
    return sample_meeting("line", 3, 1)


def all_offers(meeting: Meeting, sender: int) -> PlanOffer:
    """Return a message that completes a neighbour."""
    names = tuple(offer.agent for offer in meeting.offers)
    return PlanOffer(names[sender], meeting.round, names, meeting.offers)


def test_it_needs_nothing_before_it_has_begun(meeting: Meeting) -> None:
    """A fresh negotiation says its offer at the first opportunity, and nothing twice."""
    negotiation = negotiation_of(meeting)
    assert negotiation.phase is Phase.GATHERING
    assert negotiation.next_need_s == math.inf
    assert negotiation.round == meeting.round
    assert len(messages_in(negotiation, START_S)) == 1
    assert negotiation.proceed(START_S) == ()
    assert negotiation.next_need_s == START_S + meeting.team.retry_s


def test_a_lone_agent_agrees_at_once() -> None:
    """A team of one is present, improves, confirms and agrees in one step, and is silent."""
    meeting = sample_meeting("line", 1, 2)
    negotiation = negotiation_of(meeting)
    actions = negotiation.proceed(START_S)
    assert isinstance(actions[-1], HoldStrategy)
    assert actions[-1].strategy is negotiation.agreed
    assert negotiation.phase is Phase.AGREED
    assert negotiation.next_need_s == math.inf


def test_repetitions_become_rarer_while_members_are_missing(meeting: Meeting) -> None:
    """The interval doubles up to the team's patience; news make it short again."""
    negotiation = negotiation_of(meeting)
    negotiation.proceed(START_S)
    intervals_s, now_s = [], START_S
    for _ in range(9):
        intervals_s.append(round(negotiation.next_need_s - now_s, 9))
        now_s = negotiation.next_need_s
        assert len(messages_in(negotiation, now_s)) == 1
    assert intervals_s == [0.0125, 0.025, 0.05, 0.1, 0.2, 0.4, 0.8, 1.6, 1.6]
    negotiation.hear(PlanOffer("agent_01", meeting.round, ("agent_01",), meeting.offers[1:2]))
    negotiation.proceed(now_s)
    assert negotiation.next_need_s == now_s + meeting.team.retry_s


def test_unanswered_exchanges_become_rarer_too(meeting: Meeting) -> None:
    """Much less so: a neighbour that is only slow isn't asked over and over, a lost word is soon
    mended.
    """
    negotiation = negotiation_of(meeting)
    negotiation.hear(all_offers(meeting, 1))
    negotiation.proceed(START_S)
    intervals_s, now_s = [], START_S
    for _ in range(6):
        intervals_s.append(round(negotiation.next_need_s - now_s, 9))
        now_s = negotiation.next_need_s
        assert messages_in(negotiation, now_s)
    assert intervals_s == [0.0125, 0.025, 0.05, 0.1, 0.1, 0.1]


def test_nothing_is_repeated_before_its_time(meeting: Meeting) -> None:
    """Until a message's answer is due, no time that passes makes an agent speak."""
    negotiation = negotiation_of(meeting)
    negotiation.proceed(START_S)
    assert negotiation.proceed(math.nextafter(negotiation.next_need_s, 0.0)) == ()
    assert len(messages_in(negotiation, negotiation.next_need_s)) == 1


def test_the_meetings_beginning_is_known_with_the_last_offer(meeting: Meeting) -> None:
    """Before all offers are held there is no t_c; with them the next step begins to improve."""
    negotiation = negotiation_of(meeting)
    assert negotiation.meeting_s is None
    assert negotiation.hear(all_offers(meeting, 1)) == ()
    assert negotiation.phase is Phase.GATHERING
    said = messages_in(negotiation, START_S)
    opens_s = meeting.team.opens_s(meeting.round - 1)
    assert negotiation.meeting_s == max(opens_s, *(o.arrival_s for o in meeting.offers))
    assert [type(message) for message in said] == [PlanOffer, BestResponse]
    assert negotiation.phase is Phase.IMPROVING


def test_offers_are_repeated_until_all_neighbours_have_begun(meeting: Meeting) -> None:
    """A neighbour that may lack an offer is told it with each repetition, until it is heard."""
    negotiation, other = negotiation_of(meeting), negotiation_of(meeting, 1)
    for one, sender in ((negotiation, 1), (other, 0)):
        one.hear(replace(all_offers(meeting, sender), known=()))
    first = messages_in(negotiation, START_S)
    assert [type(message) for message in first] == [PlanOffer, BestResponse]
    # It was shown to hold what it told, which here is all.
    again = messages_in(negotiation, negotiation.next_need_s)
    assert [type(message) for message in again] == [BestResponse]
    middle = messages_in(other, START_S)
    assert [type(message) for message in middle] == [PlanOffer, BestResponse]
    again = messages_in(other, other.next_need_s)
    assert [type(message) for message in again] == [PlanOffer, BestResponse]
    assert isinstance(again[0], PlanOffer)
    assert again[0].offers == meeting.offers
    last = negotiation_of(meeting, 2)
    last.hear(all_offers(meeting, 1))
    for message in [*first, *messages_in(last, START_S)]:
        other.hear(message)
    other.proceed(START_S + 1.0)
    again = messages_in(other, other.next_need_s)
    assert {type(message) for message in again} == {BestResponse}


def test_what_was_kept_in_vain_is_counted(meeting: Meeting) -> None:
    """A message that came a phase early is judged when its phase begins."""
    negotiation = negotiation_of(meeting)
    problem = meeting.problem
    far = BestResponse("agent_02", meeting.round, 0, 0, "agent_02", 0.0, problem.strategy(2, 0, 0))
    assert negotiation.hear(far) == ()
    assert negotiation.hear(far) == (CountIgnored("duplicate"),)
    negotiation.hear(all_offers(meeting, 1))
    counted = [a for a in negotiation.proceed(START_S) if isinstance(a, CountIgnored)]
    assert counted == [CountIgnored("unneeded")] or counted == [CountIgnored("malformed")]
    assert not any(isinstance(a, CountIgnored) for a in negotiation.proceed(START_S + 1.0))


def test_what_is_kept_is_bounded_for_each_sender(meeting: Meeting) -> None:
    """One member's messages of a later phase take its own place, counted beyond, and no other's."""
    negotiation = negotiation_of(meeting)

    def counted(sender: int, iteration: int) -> tuple[Action, ...]:
        name = meeting.offers[sender].agent
        strategy = meeting.problem.strategy(sender, 0, 0)
        return negotiation.hear(
            BestResponse(name, meeting.round, iteration, 0, name, 0.0, strategy)
        )

    heard = [counted(1, iteration) for iteration in range(100)]
    assert heard == [()] * 4 + [(CountIgnored("overflowing"),)] * 96
    assert counted(1, 0) == (CountIgnored("duplicate"),)
    assert counted(2, 0) == ()


@pytest.mark.parametrize(
    ("change", "reason"),
    [
        ({"sender": "stranger"}, "foreign"),
        ({"sender": "agent_00"}, "foreign"),
        ({"round": 0}, "late"),
        ({"round": 10**6}, "early"),
    ],
)
def test_the_ticket_is_looked_at_first(
    meeting: Meeting, change: dict[str, str | int], reason: str
) -> None:
    """Strangers, one's own echo and other rounds are named whatever they say."""
    negotiation = negotiation_of(meeting)
    message = replace(all_offers(meeting, 1), **change)  # type: ignore[arg-type]
    assert negotiation.hear(message) == (CountIgnored(reason),)
    assert negotiation.meeting_s is None


def test_a_round_that_nobody_can_attend_raises(meeting: Meeting) -> None:
    """Without an admissible meeting the error says so, to whoever holds all offers."""
    problem = meeting.problem
    first = problem.candidates[0]
    none = Candidates(first.agent, first.task_index[:0], first.arrival_s[:0], first.extra_s[:0])
    rounds = replace(
        meeting.rounds,  # type: ignore[type-var]
        problem_=replace(problem, candidates=(none, *problem.candidates[1:])),
    )
    negotiation = negotiation_of(replace(meeting, rounds=rounds))
    negotiation.hear(all_offers(meeting, 1))
    with pytest.raises(InfeasibleRoundError, match="agent_00"):
        negotiation.proceed(START_S)


@pytest.mark.parametrize("phase", [Phase.GATHERING, Phase.IMPROVING])
def test_too_late_to_confirm_it_gives_up(meeting: Meeting, phase: Phase) -> None:
    """D_c into the window to plan, who hasn't confirmed says and takes in nothing any more."""
    negotiation = negotiation_of(meeting)
    if phase is Phase.IMPROVING:
        negotiation.hear(all_offers(meeting, 1))
    until_s = meeting.team.confirmable_until_s(meeting.round)
    assert until_s == 60.0 * meeting.round + 5.0
    assert messages_in(negotiation, math.nextafter(until_s, 0.0))
    assert negotiation.phase is phase
    assert not negotiation.is_given_up
    assert negotiation.proceed(until_s) == ()
    assert negotiation.is_given_up
    assert negotiation.next_need_s == math.inf
    assert negotiation.awaited is None
    assert negotiation.hear(all_offers(meeting, 1)) == (CountIgnored("late"),)
    assert negotiation.confirmed is None


def test_who_has_confirmed_never_gives_up() -> None:
    """It goes on asking for the others' confirmations, however late it is."""
    meeting = sample_meeting("line", 2, 1)
    network = FakeNetwork(meeting.offers, meeting.round, meeting.team, meeting.rounds)
    network.is_cut = lambda _time_s, _receiver, message: isinstance(message, Confirmation)
    network.run(meeting.team.confirmable_until_s(meeting.round) + 60.0)
    strategies = {agent.confirmed for agent in network.agents.values()}
    assert len(strategies - {None}) == 1
    assert not any(agent.is_given_up for agent in network.agents.values())
    network.is_cut = lambda _time_s, _receiver, _message: False
    network.run()
    assert {agent.agreed for agent in network.agents.values()} == strategies


def test_once_settled_it_answers_who_still_repeats(meeting: Meeting) -> None:
    """A settled agent is silent; only a neighbour's repeated exchange is answered, each once."""
    network = FakeNetwork(meeting.offers, meeting.round, meeting.team, meeting.rounds)
    network.run()
    said = [e.action.message for e in network.transcript if isinstance(e.action, SendMessage)]
    last = {m.sender: m for m in said if isinstance(m, BestResponse)}
    first = network.agents["agent_00"]
    assert first.next_need_s == math.inf
    assert first.hear(last["agent_02"]) == (CountIgnored("unneeded"),)
    assert first.hear(replace(last["agent_01"], change_s=1.0)) == (CountIgnored("malformed"),)
    assert first.proceed(500.0) == ()
    assert first.hear(last["agent_01"]) == ()
    (action,) = first.proceed(500.0)
    assert isinstance(action, SendMessage)
    assert action.message.sender == "agent_00"
    assert first.proceed(501.0) == ()
    assert first.next_need_s == math.inf
