"""Hybrid execution: the plan, interleaved with meetings."""

import math
from itertools import groupby, pairwise

import pytest

from support.hall import DURATION_S, PERIOD_S, LoneAgent, exchange, of_kind, two_agents
from tlcomm_core.agent.actions import CountIgnored, Drive, TaskEventKind
from tlcomm_core.agent.events import MessageHeard, TimePassed
from tlcomm_core.geometry import Pose
from tlcomm_core.protocol.messages import PlanOffer
from tlcomm_core.protocol.negotiation import Phase

STARTED, FINISHED, REACHED, BEGUN, ENDED, SATISFIED, AGREED, FAULT, VISITED, *_ = TaskEventKind


@pytest.fixture(scope="module")
def lone() -> LoneAgent:
    """Return a team of one after a hundred windows."""
    agent = LoneAgent("one", 1)
    agent.act()
    agent.advance_to(100 * PERIOD_S)
    return agent


def test_the_first_odometry_finds_it_at_the_meeting_of_round_0() -> None:
    """It reports that at once, says nothing before it is asked to act, and wants nothing before."""
    agent = LoneAgent("one", 2)
    assert [(t, event.kind, event.round) for t, event in agent.events] == [(0.0, REACHED, 0)]
    assert agent.sent == []
    agent.act()
    assert [type(message) for message in agent.sent] == [PlanOffer]
    assert agent.brain.phase is Phase.GATHERING


def test_before_its_first_odometry_it_needs_nothing() -> None:
    """It can't know where it is."""
    brain = LoneAgent("one", 1).brain
    fresh = type(brain)(brain._settings)
    assert fresh.next_need_s == math.inf
    assert fresh.handle(TimePassed(), 0.0) == ()
    assert fresh.phase is None


def test_a_meeting_lasts_for_its_duration(lone: LoneAgent) -> None:
    """From t_c, which is the window's opening or the last arrival, to D_c later."""
    begun, ended = lone.times_s(BEGUN), lone.times_s(ENDED)
    reached = lone.times_s(REACHED)
    assert ended == pytest.approx([time_s + DURATION_S for time_s in begun[: len(ended)]])
    for round_, (begun_s, reached_s) in enumerate(zip(begun, reached, strict=False)):
        assert begun_s == pytest.approx(max(round_ * PERIOD_S, reached_s))


def test_a_meeting_goes_its_way_in_order(lone: LoneAgent) -> None:
    """Reached, started, agreed upon the next one, ended: of one round after the other."""
    events = [event for _, event in lone.events]
    meetings = of_kind(events, REACHED, BEGUN, AGREED, ENDED)
    for round_, four in enumerate(zip(*[iter(meetings)] * 4, strict=False)):
        assert {event.kind for event in four[1:3]} == {BEGUN, AGREED}
        assert (four[0].kind, four[3].kind) == (REACHED, ENDED)
        assert [event.round for event in four if event.kind is not AGREED] == [round_] * 3
        assert [event.round for event in four if event.kind is AGREED] == [round_ + 1]
    assert lone.brain.meetings_ended == len(of_kind(events, ENDED)) > 90


def test_the_plan_index_runs_on_through_prefix_and_suffix(lone: LoneAgent) -> None:
    """Every step is done, in order, for ever; meetings don't lose or repeat one."""
    plan = lone.brain._settings.plan
    events = of_kind([event for _, event in lone.events], STARTED, FINISHED, VISITED)
    done = [list(group) for _, group in groupby(events, key=lambda event: event.plan_index)]
    assert [group[0].plan_index for group in done] == list(range(len(done)))
    assert len(done) > len(plan.prefix) + 10 * len(plan.suffix)
    for group in done[:-1]:
        step = plan.step(group[0].plan_index)
        kinds = [VISITED] if step.action is None else [STARTED, FINISHED]
        assert [event.kind for event in group] == kinds
        assert {(event.region, event.action) for event in group} == {
            (step.region, step.action or "")
        }


def test_an_action_takes_its_duration_at_its_place(lone: LoneAgent) -> None:
    """It stands still from the start to the end."""
    durations_s = {"pick": 4.0, "place": 2.0}
    acts = [(t, event) for t, event in lone.events if event.kind in {STARTED, FINISHED}]
    spans = [(a, b, event) for (a, event), (b, _) in zip(acts[::2], acts[1::2], strict=False)]
    for from_s, to_s, event in spans:
        assert to_s - from_s == pytest.approx(durations_s[event.action])
        drives = [x for t, x in lone.done if from_s < t < to_s and isinstance(x, Drive)]
        assert drives == []


def test_the_task_is_satisfied_at_the_steps_that_complete_it(lone: LoneAgent) -> None:
    """Once with each finished step of the plan that satisfies, at that instant, and never else."""
    plan = lone.brain._settings.plan
    finished = [(t, e.plan_index) for t, e in lone.events if e.kind is FINISHED]
    satisfied = [(t, e.plan_index) for t, e in lone.events if e.kind is SATISFIED]
    assert satisfied == [(t, index) for t, index in finished if plan.step(index).satisfies]
    assert len(satisfied) > 50


def test_it_goes_to_meet_after_the_task_that_was_agreed(lone: LoneAgent) -> None:
    """The place of meeting is reached after step h and before step h + 1, as predicted."""
    reached = [(t, e) for t, e in lone.events if e.kind is REACHED][1:]
    assert len(reached) > 90
    for (time_s, event), held in zip(reached, lone.held, strict=False):
        (strategy,) = held.strategy.strategies
        assert event.plan_index == strategy.task_index
        assert time_s == pytest.approx(strategy.arrival_s, abs=1e-6)
        assert f"predicted_s={strategy.arrival_s:.9f}" in event.detail
        later = [e.plan_index for t, e in lone.events if t > time_s and e.kind is STARTED]
        assert not later or later[0] > strategy.task_index


def test_each_window_has_its_meeting(lone: LoneAgent) -> None:
    """The meeting of round r starts in [r·T_c, (r + 1)·T_c)."""
    rounds = [int(time_s // PERIOD_S) for time_s in lone.times_s(BEGUN)]
    assert rounds == list(range(len(rounds)))


def test_its_need_is_always_ahead(lone: LoneAgent) -> None:
    """After acting, nothing is due any more: no time is asked for twice."""
    assert lone.brain.next_need_s > lone.now_s
    times = [t for t, action in lone.done if isinstance(action, Drive)]
    assert all(a <= b for a, b in pairwise(times))
    before = len(lone.done)
    lone.act()
    assert len(lone.done) == before


def test_away_from_a_meeting_messages_are_counted() -> None:
    """Whatever comes changes nothing."""
    agent = LoneAgent("one", 1)
    agent.act()
    agent.advance_to(DURATION_S + 1.0)
    need_s = agent.brain.next_need_s
    heard = agent.brain.handle(MessageHeard(PlanOffer("two", 1, ("two",), ())), agent.now_s)
    assert heard == (CountIgnored("not meeting"),)
    assert agent.brain.next_need_s == need_s


def test_two_agree_and_leave_together() -> None:
    """They hold the same strategy, and set out D_c after the meeting's beginning."""
    one, two = two_agents()
    exchange(one, two, 0.0)
    assert one.held == two.held != []
    one.advance_to(DURATION_S + 0.1)
    two.advance_to(DURATION_S + 0.1)
    assert one.times_s(ENDED) == two.times_s(ENDED) == [DURATION_S]
    assert one.brain.meetings_ended == 1


def test_without_agreement_it_reports_a_fault_and_stays() -> None:
    """An overdue meeting is reported once; it doesn't leave, and goes on asking."""
    one, two = two_agents()
    exchange(one, two, 0.0, is_silent=True)
    one.advance_to(DURATION_S - 0.01)
    assert one.times_s(FAULT) == []
    one.advance_to(20.0)
    assert one.times_s(FAULT) == [DURATION_S]
    assert one.times_s(BEGUN) == [0.0]
    assert one.times_s(ENDED) == []
    assert not any(isinstance(action, Drive) for _, action in one.done)
    assert one.brain.phase is Phase.IMPROVING
    asked = len(one.sent)
    one.advance_to(21.0)
    assert len(one.sent) > asked


def test_an_overdue_meeting_ends_when_agreement_comes() -> None:
    """Then both leave at once."""
    one, two = two_agents()
    exchange(one, two, 0.0, is_silent=True)
    exchange(one, two, 10.0)
    assert one.times_s(ENDED) == two.times_s(ENDED) == [10.0]
    assert one.times_s(FAULT) == two.times_s(FAULT) == [DURATION_S]
    assert one.held == two.held != []


def test_alone_at_the_meeting_it_waits() -> None:
    """While a member is missing, no meeting starts, none is overdue, and it asks ever again."""
    one, _ = two_agents()
    one.advance_to(25.0)
    assert [event.kind for _, event in one.events] == [REACHED]
    assert 10 < len(one.sent) < 30


@pytest.mark.parametrize("round_", [1, 40])
def test_an_offer_reaches_to_the_end_of_the_window(lone: LoneAgent, round_: int) -> None:
    """Its stops go beyond what can be finished in the window to plan, and begin with the next."""
    (own,) = next(m for m in lone.sent if isinstance(m, PlanOffer) and m.round == round_).offers
    departs_s = max(own.arrival_s, (round_ - 1) * PERIOD_S) + DURATION_S
    finishes_s = [departs_s + stop.finish_offset_s for stop in own.stops]
    assert finishes_s[-1] > (round_ + 1) * PERIOD_S >= finishes_s[-2]
    done = [
        e.plan_index for t, e in lone.events if t <= own.arrival_s and e.kind in {FINISHED, VISITED}
    ]
    assert own.stops[0].task_index == (done[-1] + 1 if done else 0)


@pytest.mark.parametrize(
    ("off_m", "off_rad", "is_taken"),
    [(0.0, 0.0, True), (0.019, 0.09, True), (0.021, 0.0, False), (0.0, 0.11, False)],
)
def test_what_is_within_tolerance_counts_as_arrived(
    off_m: float, off_rad: float, is_taken: bool
) -> None:
    """Predictions go on from where a leg was to end, unless the agent is elsewhere indeed."""
    expected = Pose(1.0, 1.0, math.pi)
    actual = Pose(1.0, 1.0 + off_m, -math.pi + off_rad)
    taken = LoneAgent("one", 1).brain._journey._taken_for(expected, actual)
    assert taken is (expected if is_taken else actual)
