"""Tests of ``tlcomm_core.verdict`` on a run made by hand."""

from dataclasses import replace

from support.hand_made_run import END_S, hand_made_records, hand_made_scenario, task
from tlcomm_core.agent.actions import TaskEventKind
from tlcomm_core.method import Method
from tlcomm_core.records import RunRecords, StrategyRecord
from tlcomm_core.result import RunFacts, result_document
from tlcomm_core.units import NANOSECONDS_PER_SECOND
from tlcomm_core.verdict import failures, patience_s
from tlcomm_core.world.observation import Connectivity

FACTS = RunFacts(Method.TEAM, "best-response", 3, "lockstep", END_S, 5.0)


def document(records: RunRecords, facts: RunFacts = FACTS) -> dict:
    """Return the result document of the hand-made scenario."""
    return result_document(hand_made_scenario(), records, facts)


def test_a_starving_task_fails() -> None:
    """A task that isn't satisfied for longer than its patience is in the verdict."""
    records = hand_made_records()
    records.tasks = [
        own
        for own in records.tasks
        if own.agent == "east" or own.event.kind is not TaskEventKind.TASK_SATISFIED
    ]
    records.connectivity = [Connectivity(0, ((0, 1),), True)]
    facts = replace(FACTS, sim_s=31.0)
    assert patience_s(hand_made_scenario(), "west") == 30.0
    assert document(records, facts)["verdict"] == [
        "west: task not satisfied from 0.000 s to 31.000 s"
    ]


def test_different_strategies_fail() -> None:
    """Two agents with different strategies for a round are a disagreement."""
    records = hand_made_records()
    first = records.strategies[0]
    records.strategies[0] = replace(first, strategy=replace(first.strategy, iteration=9))
    assert document(records)["verdict"] == ["round 1: agents hold different strategies"]


def test_a_missing_strategy_fails() -> None:
    """A round before the last one that an agent holds no strategy for is named with the agent."""
    records = hand_made_records()
    records.strategies = [
        own for own in records.strategies if (own.agent, own.strategy.round) != ("west", 2)
    ]
    assert document(records)["verdict"] == ["round 2: not held by west"]


def test_who_says_that_it_is_in_doubt_needs_no_strategy() -> None:
    """An agent that left without the others' confirmations of that very round holds nothing, which
    fails nothing.
    """
    for round_, verdict in ((1, "ok"), (0, ["round 2: not held by west"])):
        records = hand_made_records()
        records.strategies = [
            own for own in records.strategies if (own.agent, own.strategy.round) != ("west", 2)
        ]
        detail = f"agreement=doubtful round={round_ + 1}"
        doubt = task(13.0, "west", TaskEventKind.FAULT, round_=round_, detail=detail)
        records.tasks = sorted([*records.tasks, doubt], key=lambda own: own.stamp_ns)
        assert document(records)["verdict"] == verdict


def test_faults_and_failures_come_up() -> None:
    """What broke the run and what an agent reports as a fault are in the verdict."""
    records = hand_made_records()
    records.tasks.append(task(25.0, "east", TaskEventKind.FAULT, detail="lost"))
    facts = replace(FACTS, failures=("west: killed by SIGKILL",))
    assert document(records, facts)["verdict"] == [
        "west: killed by SIGKILL",
        "east: fault at 25.000 s: lost",
    ]


def test_what_agents_cope_with_is_no_failure() -> None:
    """It isn't in the verdict, and each failed attempt leaves the task a window more."""
    records = hand_made_records()
    records.connectivity = [Connectivity(0, ((0, 1),), True)]
    done = [own for own in records.tasks if own.event.kind is not TaskEventKind.TASK_SATISFIED]
    failed = task(5.0, "west", TaskEventKind.FAULT, action="pick", detail="action=pick attempt=1")
    pushed = task(6.0, "west", TaskEventKind.FAULT, detail="displaced_m=0.700")
    records.tasks = [own for own in done if own.agent == "west"] + [failed, pushed]
    period_s = hand_made_scenario().communication.period_s

    def complaints(sim_s: float) -> list[str]:
        verdict = document(records, replace(FACTS, sim_s=sim_s))["verdict"]
        return [line for line in verdict if line.startswith("west: ")]

    assert complaints(30.0 + period_s) == []
    assert len(complaints(31.0 + period_s)) == 1


def test_a_window_that_nobody_promised_may_be_missed() -> None:
    """By methods without meetings of the team; the others are to keep it."""
    records = hand_made_records()
    records.connectivity = [Connectivity(0, (), connected=False)]
    wrong = {
        method: document(records, replace(FACTS, method=method))["verdict"]
        for method in (Method.STATIC, Method.NONE)
    }
    assert len([line for line in wrong[Method.STATIC] if "missed" in line]) == 2
    assert wrong[Method.NONE] == "ok"


def test_pairs_agree_on_their_own_meetings() -> None:
    """Two pairs have different strategies for one window; within a pair both hold the same."""
    scenario = hand_made_scenario()
    first = hand_made_records().strategies[0].strategy
    strategies = tuple(replace(first.strategies[0], agent=name) for name in "abcd")
    one, two = (replace(first, strategies=own) for own in (strategies[:2], strategies[2:]))
    later = replace(one, round=2)
    held = [("a", one), ("b", one), ("c", two), ("a", later), ("b", later)]
    records = RunRecords(strategies=[StrategyRecord(1, name, own) for name, own in held])
    assert failures(scenario, records, Method.PAIRWISE, (), 0) == ["round 1 of c, d: not held by d"]
    records.strategies.append(StrategyRecord(2, "d", replace(two, iteration=7)))
    assert failures(scenario, records, Method.PAIRWISE, (), 0) == [
        "round 1 of c, d: agents hold different strategies"
    ]


def test_a_window_missed_by_a_pair_fails_pairs_only() -> None:
    """With the two who missed it; whether the whole team keeps windows doesn't matter then."""
    records = hand_made_records()
    late = Connectivity(11_000_000_000, (), connected=False)
    others = [own for own in records.connectivity if not 11.0 <= own.stamp_ns / 1e9 < 20.0]
    records.connectivity = sorted([*others, late], key=lambda own: own.stamp_ns)
    scenario, end_ns = hand_made_scenario(), 18_000_000_000
    missed = "window 1 missed by east and west: connected for 1.000 s at most, not 2 s"
    assert failures(scenario, records, Method.NONE, (), end_ns) == []
    assert failures(scenario, records, Method.PAIRWISE, (), end_ns) == []
    assert failures(scenario, records, Method.PAIRWISE, (), 20_000_000_000) == [missed]


def test_a_break_fails_where_there_must_be_none() -> None:
    """The first is told, with its times; windows alone don't say that all is well."""
    records = hand_made_records()
    records.connectivity = [
        Connectivity(second * NANOSECONDS_PER_SECOND, ((0, 1),), connected)
        for second, connected in ((0, True), (6, False), (8, True), (10, False), (11, True))
    ]
    facts = replace(FACTS, method=Method.ALL_TIME)
    told = "not connected from 6.000 s to 8.000 s"
    assert document(records, facts)["verdict"] == [told]
    assert document(records)["verdict"] == "ok"
    del records.connectivity[1:]
    assert document(records, facts)["verdict"] == "ok"
    records.connectivity = []
    assert document(records, facts)["verdict"][-1].startswith("not connected from 0.000 s")


def test_who_takes_turns_may_wait_for_all_others() -> None:
    """With two agents twice as long."""
    scenario = hand_made_scenario()
    assert patience_s(scenario, "west", Method.ALL_TIME) == 2.0 * patience_s(scenario, "west")
