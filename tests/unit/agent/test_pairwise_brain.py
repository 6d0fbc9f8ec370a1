"""One agent between two partners, in the hall: it meets them by turns, in every window one."""

import math
from collections.abc import Callable
from dataclasses import replace

import pytest

from support.hall import DURATION_S, PERIOD_S, LoneAgent, hall
from support.troop import Troop
from tlcomm_core.agent.actions import CountIgnored, TaskEventKind
from tlcomm_core.agent.events import MessageHeard, TimePassed
from tlcomm_core.agent.lone_brain import LoneBrain
from tlcomm_core.agent.pairwise_brain import PairwiseBrain
from tlcomm_core.agent.visit import partner_of
from tlcomm_core.method import Method
from tlcomm_core.metrics.connection import pair_windows_of
from tlcomm_core.mission import Mission
from tlcomm_core.protocol.messages import Confirmation, Message
from tlcomm_core.protocol.team import OnInfeasible
from tlcomm_core.scenario.site import Site
from tlcomm_core.simulation import simulate
from tlcomm_core.units import nanoseconds

NAMES = ("one", "two", "three")
Cut = Callable[[float, str, Message], bool]
# By their turns: the first agent, in the middle, meets both of the others.
WINDOWS = {"one": list(range(7)), "two": [0, 1, 3, 5], "three": [0, 2, 4, 6]}
REACHED, STARTED, ENDED, FAULT = (
    TaskEventKind.MEETING_REACHED,
    TaskEventKind.MEETING_STARTED,
    TaskEventKind.MEETING_ENDED,
    TaskEventKind.FAULT,
)


def hears_all(_time_s: float, _receiver: str, _message: Message) -> bool:
    """Lose nothing."""
    return False


def troop_of(is_cut: Cut = hears_all, until_s: float = 7 * PERIOD_S) -> Troop:
    """Return three agents that meet by pairs, after a time on such a network."""
    troop = Troop(NAMES, is_cut, Method.PAIRWISE)
    troop.run(until_s)
    return troop


def rounds(troop: Troop, kind: TaskEventKind) -> dict[str, list[int]]:
    """Return the rounds of events of a kind, by agent."""
    return {name: [event.round for _, event in own] for name, own in troop.events(kind).items()}


def details(troop: Troop) -> dict[str, list[str]]:
    """Return what agents had to cope with."""
    return {name: [event.detail for _, event in own] for name, own in troop.events(FAULT).items()}


def test_every_agent_meets_each_partner_in_turn() -> None:
    """Each meeting is reached, begins and ends once, in the windows of the pair."""
    troop = troop_of()
    for kind in (REACHED, STARTED, ENDED):
        assert rounds(troop, kind) == WINDOWS
    assert details(troop) == {name: [] for name in NAMES}


def test_pairs_plan_from_where_all_else_that_they_agreed_on_leaves_them() -> None:
    """So everybody arrives when it said, though that was one or two meetings before."""
    troop = troop_of()
    for name, agent in troop.agents.items():
        reached = {event.round: time_s for time_s, event in troop.events(REACHED)[name]}
        parts = [held.strategy.part_of(name) for held in agent.held]
        windows = [held.strategy.round for held in agent.held]
        assert windows[: len(reached) - 1] == sorted(reached)[1:]
        for window, own in zip(windows, parts, strict=True):
            if window in reached:
                assert own.arrival_s == pytest.approx(reached[window], abs=1e-6)
                assert own.arrival_s >= reached[max(w for w in reached if w < window)] + DURATION_S


def test_two_hold_the_same_for_their_windows() -> None:
    """And nothing for the third's."""
    troop = troop_of()
    held = {name: [own.strategy for own in agent.held] for name, agent in troop.agents.items()}
    assert [own for own in held["one"] if own.round % 2] == held["two"]
    assert [own for own in held["one"] if own.round % 2 == 0] == held["three"]
    assert {own.members for own in held["two"]} == {("one", "two")}


def test_all_plan_at_the_start_within_its_duration() -> None:
    """One after another, and then all set out at once."""
    troop = troop_of(until_s=PERIOD_S)
    agreed_s = {
        name: [time_s for time_s, _ in own]
        for name, own in troop.events(TaskEventKind.ROUND_AGREED).items()
    }
    assert {name: len(own) for name, own in agreed_s.items()} == {"one": 2, "two": 1, "three": 1}
    assert max(agreed_s["two"]) < min(agreed_s["three"]) < 0.1
    ended_s = [time_s for own in troop.events(ENDED).values() for time_s, _ in own]
    assert ended_s == [DURATION_S] * 3


def test_who_lacks_a_confirmation_is_there_all_the_same() -> None:
    """It stays while there is time, and goes by what it has confirmed; so nobody misses one."""

    def is_cut(_time_s: float, receiver: str, message: Message) -> bool:
        is_third = message.round == 3 and isinstance(message, Confirmation)
        return receiver == "one" and message.sender == "two" and is_third

    troop = troop_of(is_cut)
    assert details(troop) == {
        "one": ["agreement=late round=3", "agreement=doubtful round=3"],
        "two": [],
        "three": [],
    }
    assert rounds(troop, STARTED) == WINDOWS


def test_a_pair_that_cant_agree_meets_again_where_it_was() -> None:
    """In its next window; the other pair doesn't miss any of its own."""

    def is_cut(_time_s: float, receiver: str, message: Message) -> bool:
        return {receiver, message.sender} == {"one", "two"} and message.round == 3

    troop = troop_of(is_cut)
    missed = ["agreement=missed round=3"]
    assert details(troop) == {"one": missed, "two": missed, "three": []}
    left_out = {
        name: [w for w in own if w != 1 or name == "three"] for name, own in WINDOWS.items()
    }
    assert rounds(troop, STARTED) == left_out
    assert rounds(troop, REACHED) == WINDOWS
    first, third = (
        next(t for t, event in troop.events(REACHED)["two"] if event.round == w) for w in (1, 3)
    )
    latest_s = 2 * PERIOD_S + DURATION_S
    assert first < latest_s == third


def test_without_agreement_at_the_start_pairs_meet_there() -> None:
    """Each in its first window."""

    def is_cut(_time_s: float, receiver: str, message: Message) -> bool:
        return {receiver, message.sender} == {"one", "two"} and message.round == 1

    troop = troop_of(is_cut)
    assert details(troop) == {
        "one": ["agreement=missed round=1", "agreement=missed round=2"],
        "two": ["agreement=missed round=1"],
        "three": ["agreement=missed round=2"],
    }
    assert {name: own[-3:] for name, own in rounds(troop, STARTED).items()} == {
        name: own[-3:] for name, own in WINDOWS.items()
    }


def test_who_cant_plan_a_window_parts_and_meets_again_where_it_was() -> None:
    """Nobody waits for longer than D_c for what can't be: others are to be met before that."""
    scenario = hall(3).scenario
    waiting = scenario.communication.model_copy(update={"on_infeasible": "wait"})
    slow = scenario.model_copy(
        update={"actions": {"pick": 100.0, "place": 2.0}, "communication": waiting}
    )
    end_s = 5 * PERIOD_S
    mission = Mission(Site.from_scenario(slow), 0, None, end_s, method=Method.PAIRWISE)
    records = simulate(mission).records
    said = [own for own in records.tasks if own.event.detail.startswith("agreement=gathered")]
    assert {own.stamp_ns for own in said if own.event.round == 0} == {nanoseconds(DURATION_S)}
    outcomes = pair_windows_of(slow, records, nanoseconds(end_s)).values()
    assert [[own.round for own in windows if own.satisfied] for windows in outcomes] == [
        [1, 3],
        [2, 4],
    ]


def test_another_task_begins_at_the_next_meeting() -> None:
    """Whatever was agreed takes place all the same, with steps of the new plan in between."""
    troop = troop_of(until_s=PERIOD_S)
    agent = troop.agents["one"]
    brain = agent.brain
    start = brain.next_start
    assert start is not None
    agent.change_task("G F (b & place)")
    troop.run(7 * PERIOD_S)
    assert [e.round for _, e in troop.events(TaskEventKind.TASK_CHANGED)["one"]] == [1]
    assert rounds(troop, STARTED) == WINDOWS
    begun = [event for _, event in agent.events if event.round > 1 and event.action]
    assert {event.action for event in begun} == {"place"}
    reached = next(t for t, event in troop.events(REACHED)["one"] if event.round == 1)
    assert agent.held[0].strategy.part_of("one").arrival_s == pytest.approx(reached, abs=1e-6)
    assert start.distance_m(*_place(agent, 0)) == 0.0
    first, second = (agent.held[index].strategy.part_of("one").task_index for index in (0, 1))
    ends = (TaskEventKind.ACTION_FINISHED, TaskEventKind.REGION_VISITED)
    between = [event for _, event in agent.events if event.kind in ends and event.round == 2]
    assert len(between) == second - first


def _place(agent: LoneAgent, index: int) -> tuple[float, float]:
    own = agent.held[index].strategy.part_of(agent.name)
    return own.x_m, own.y_m


def test_whom_it_doesnt_meet_it_doesnt_hear() -> None:
    """Neither under way nor beside another."""
    troop = troop_of(until_s=PERIOD_S)
    word = troop.agents["two"].sent[0]
    assert troop.agents["one"].brain.handle(MessageHeard(word), PERIOD_S) == (
        CountIgnored("not meeting"),
    )
    lone = LoneAgent("three", 3, method=Method.PAIRWISE)
    assert lone.brain.handle(MessageHeard(word), 0.0) == (CountIgnored("not meeting"),)


def test_before_its_first_odometry_it_needs_nothing() -> None:
    """It can't know where it is."""
    lone = LoneAgent("one", 3, method=Method.PAIRWISE)
    assert isinstance(lone.brain, PairwiseBrain)
    brain = PairwiseBrain(lone.brain._settings, [own.pair for own in lone.brain._partners.values()])
    assert (brain.phase, brain.awaited, brain.next_start) == (None, None, None)
    assert brain.next_need_s == math.inf
    assert brain.handle(TimePassed(), 0.0) == ()


def test_a_single_agent_has_nobody_to_meet() -> None:
    """It does its task, and nothing else."""
    assert isinstance(LoneAgent("one", 1, method=Method.PAIRWISE).brain, LoneBrain)


def test_where_the_map_cuts_it_off_it_waits_until_the_way_is_open() -> None:
    """As near as it comes; alone there, it goes to the place of meeting when it can."""
    troop = troop_of(until_s=PERIOD_S)
    agent = troop.agents["one"]
    agent.show_map((1.5, 0.0, 2.0, 2.0), (4.0, 0.0, 4.5, 2.0))
    agent.advance_to(2 * PERIOD_S - 1.0)
    cut_off = [event for _, event in agent.events if event.detail.startswith("cut_off_m")]
    place_m = _place(agent, 0)
    assert cut_off
    assert agent.pose.distance_m(*place_m) > 0.0
    agent.show_map()
    agent.advance_to(2 * PERIOD_S + DURATION_S - 0.5)
    assert agent.pose.distance_m(*place_m) == pytest.approx(0.0, abs=1e-6)
    assert [event.round for _, event in agent.events if event.kind is REACHED] == [0, 1, 1]


def test_who_is_in_doubt_leaves_in_time_for_what_comes_next() -> None:
    """That is another partner's meeting, if one is agreed, not the next one of the same two."""
    troop = troop_of(until_s=PERIOD_S)
    agent = troop.agents["one"]
    brain = agent.brain
    heading, confirmed = agent.held[0].strategy, agent.held[1].strategy
    ahead = brain._diary.first
    assert ahead is not None
    assert ahead.window == confirmed.round == 2
    way_s = brain._itinerary.leg(brain._journey.pose, ahead.own).duration_s
    assert brain._leave_by_s(heading) == ahead.meeting_s - way_s
    brain._diary.take()
    way_s = brain._itinerary.leg(brain._journey.pose, heading.part_of("one")).duration_s
    assert brain._leave_by_s(heading) == heading.communication_s - way_s


def test_pairs_skip_no_window() -> None:
    """Others will be agreed for those in between; they wait, or stop as the team would."""
    brain = LoneAgent("one", 3, method=Method.PAIRWISE).brain
    team, pair = brain._settings.team, brain._partners["two"].pair
    expected = {
        OnInfeasible.SKIP: OnInfeasible.WAIT,
        OnInfeasible.WAIT: OnInfeasible.WAIT,
        OnInfeasible.STOP: OnInfeasible.STOP,
    }
    for on_infeasible, own in expected.items():
        partner = partner_of("one", pair, replace(team, on_infeasible=on_infeasible))
        assert (partner.name, partner.team.members) == ("two", frozenset({"one", "two"}))
        assert partner.team.on_infeasible is own
        assert partner.team.most_windows == 1
