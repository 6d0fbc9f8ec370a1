"""Tests of ``tlcomm_tools.audit`` on a good run made by hand, and on runs with one thing wrong."""

import math
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import pytest

from support.hand_made_run import (
    hand_made_records,
    hand_made_scenario,
    task,
    write_bag,
)
from tlcomm_core.agent.actions import TaskEvent, TaskEventKind
from tlcomm_core.geometry import Pose
from tlcomm_core.method import Method
from tlcomm_core.records import RunRecords, TaskRecord
from tlcomm_core.scenario.model import Radio
from tlcomm_tools.audit.findings import Audit, audit_run
from tlcomm_tools.bag.reader import read_run

S = 1_000_000_000


def audit(records: RunRecords, end_s: float = 25.0) -> Audit:
    """Audit records of a whole team."""
    return audit_run(hand_made_scenario(), Method.TEAM, records, round(end_s * S))


def test_a_good_run_has_no_violations() -> None:
    """Windows, tasks and strategies of the good run are found as they are."""
    found = audit(hand_made_records())
    assert found.violations == ()
    assert set(found.document()["checks"]) == {
        *("bag", "records", "method", "motion", "clearance", "actions"),
        *("tasks", "strategies", "meetings", "equilibria", "hearing"),
    }
    # Nobody made these agents' plans.
    assert found.unavailable == {"equilibria": ("what agents planned isn't recorded",)}
    assert found.document()["checks"]["equilibria"] is None
    assert [own.satisfied for own in found.windows] == [True, True, True]
    # They are half a metre apart at a meeting and leave at 1 m/s each: a quarter of a second more.
    # East comes last and is in range half a second before its arrival at 8 s and 18 s.
    assert [own.longest_s for own in found.windows] == pytest.approx([4.75, 7.5, 5.0])
    assert [(own.agent, own.claimed, own.satisfied) for own in found.tasks] == [
        ("east", 2, 2),
        ("west", 2, 2),
    ]
    assert (found.strategies.rounds, found.strategies.equal) == (3, 3)


def test_a_bag_is_audited_like_the_records(tmp_path: Path) -> None:
    """The audit of the bag equals that of the records it was written from."""
    records = hand_made_records()
    write_bag(tmp_path / "bag", records)
    run = read_run(tmp_path / "bag")
    found = audit_run(hand_made_scenario(), run.method, run.records, run.end_ns, run.damage)
    assert found.document() == audit(records).document()


def test_where_sight_matters_a_wall_between_two_parts_them() -> None:
    """The same run misses all its windows if a pillar stands between, and sight is asked for."""
    good = hand_made_scenario()
    workspace = good.workspace.model_copy(update={"obstacles_m": ((3.4, 0.2, 3.6, 0.3),)})
    scenarios = [
        good.model_copy(update={"workspace": workspace, "radio": Radio(line_of_sight=asked)})
        for asked in (False, True)
    ]
    ignored, seen = (
        audit_run(scenario, Method.TEAM, hand_made_records(), 25 * S) for scenario in scenarios
    )
    assert [own.satisfied for own in ignored.windows] == [True, True, True]
    assert [own.satisfied for own in seen.windows] == [False, False]


def shift_pose(records: RunRecords) -> None:
    """Put west half a metre further away at the meetings of rounds 1 and 2."""
    records.odometry = [
        replace(own, pose=Pose(2.70, 0.25, own.pose.yaw_rad))
        if own.agent == "west" and own.stamp_ns >= 6 * S and own.pose.x_m > 2.5
        else own
        for own in records.odometry
    ]


def drop_odometry(records: RunRecords) -> None:
    """Lose three seconds of east's odometry at rest, at the end."""
    records.odometry = [
        own for own in records.odometry if own.agent == "west" or own.stamp_ns <= 22 * S
    ]


def drop_all_odometry(records: RunRecords) -> None:
    """Lose all of east's odometry."""
    records.odometry = [own for own in records.odometry if own.agent == "west"]


def drop_strategy(records: RunRecords) -> None:
    """Lose the strategy that west held for round 3."""
    records.strategies = [
        own for own in records.strategies if (own.agent, own.strategy.round) != ("west", 3)
    ]


def double_strategy(records: RunRecords) -> None:
    """Let east hold its first strategy twice."""
    records.strategies.append(next(own for own in records.strategies if own.agent == "east"))


def swap_strategy(records: RunRecords) -> None:
    """Let west hold for round 2 what is for the other one of the pair."""
    for index, own in enumerate(records.strategies):
        if (own.agent, own.strategy.round) == ("west", 2):
            first, second = own.strategy.strategies
            swapped = replace(first, x_m=second.x_m), replace(second, x_m=first.x_m)
            held = replace(own.strategy, strategies=swapped)
            records.strategies[index] = replace(own, strategy=held)


def unsort_strategy(records: RunRecords) -> None:
    """Let both hold round 1 in the wrong order of agents."""
    for index, own in enumerate(records.strategies):
        if own.strategy.round == 1:
            held = replace(own.strategy, strategies=own.strategy.strategies[::-1])
            records.strategies[index] = replace(own, strategy=held)


def miscount_potential(records: RunRecords) -> None:
    """Let both hold a potential for round 1 that isn't its strategies'."""
    for index, own in enumerate(records.strategies):
        if own.strategy.round == 1:
            held = replace(own.strategy, potential_s=own.strategy.potential_s + 0.1)
            records.strategies[index] = replace(own, strategy=held)


def move_meeting(records: RunRecords) -> None:
    """Let both hold a time of meeting for round 1 that isn't its strategies'."""
    for index, own in enumerate(records.strategies):
        if own.strategy.round == 1:
            held = replace(own.strategy, communication_s=10.5)
            records.strategies[index] = replace(own, strategy=held)


def claim_more(records: RunRecords) -> None:
    """Let west claim one satisfaction that wasn't."""
    records.tasks.append(task(24.0, "west", TaskEventKind.TASK_SATISFIED))


def claim_earlier(records: RunRecords) -> None:
    """Let west claim its first satisfaction half a second early."""
    records.tasks = [
        replace(own, stamp_ns=own.stamp_ns - S // 2)
        if (own.agent, own.event.kind) == ("west", TaskEventKind.TASK_SATISFIED)
        and own.stamp_ns < 10 * S
        else own
        for own in records.tasks
    ]


def act_elsewhere(records: RunRecords) -> None:
    """Let west have been 1 m short of its region when it acted in round 0."""
    records.odometry = [
        replace(own, pose=Pose(2.25, 0.25, own.pose.yaw_rad), linear_mps=0.0)
        if own.agent == "west" and 4 * S <= own.stamp_ns <= 5 * S
        else own
        for own in records.odometry
    ]


def act_hastily(records: RunRecords) -> None:
    """Let east begin its first action half a second late."""
    records.tasks = [
        replace(own, stamp_ns=own.stamp_ns + S // 2)
        if (own.agent, own.event.kind) == ("east", TaskEventKind.ACTION_STARTED)
        and own.stamp_ns < 10 * S
        else own
        for own in records.tasks
    ]


def never_start(records: RunRecords) -> None:
    """Lose the start of west's second action."""
    records.tasks = [
        own
        for own in records.tasks
        if (own.agent, own.event.kind) != ("west", TaskEventKind.ACTION_STARTED)
        or own.stamp_ns < 10 * S
    ]


def act_nowhere(records: RunRecords) -> None:
    """Let east claim an action in a region that isn't there."""
    for index, own in enumerate(records.tasks):
        if (own.agent, own.event.kind) == ("east", TaskEventKind.ACTION_STARTED):
            records.tasks[index] = replace(own, event=replace(own.event, region="moon"))
            return


@pytest.mark.parametrize(
    ("spoil", "violations"),
    [
        (
            shift_pose,
            [
                "window 1: connected for 0.000 s from [10 s, 20 s) on, not 2 s",
                (
                    "west: 6.500 s: jumps by 0.050 m from where its velocity leads; "
                    "6 times, at most 0.500 m"
                ),
                (
                    "east: 11.005 s: heard 'confirmation' of west, said at 11.000 s, "
                    "from 1.050 m away, out of range"
                ),
                (
                    "west: 11.005 s: heard 'confirmation' of east, said at 11.000 s, "
                    "from 1.050 m away, out of range; 2 messages in all"
                ),
            ],
        ),
        (drop_odometry, ["east: no odometry from 22.000 s to 25.000 s"]),
        (
            drop_all_odometry,
            [
                "east: no odometry",
                "window 0: connected for 0.000 s from [0 s, 10 s) on, not 2 s",
                "window 1: connected for 0.000 s from [10 s, 20 s) on, not 2 s",
            ],
        ),
        (drop_strategy, ["round 3: west holds no strategy"]),
        (double_strategy, ["round 1: east holds 2 strategies"]),
        (swap_strategy, ["round 2: west holds another strategy than east"]),
        (
            unsort_strategy,
            ["round 1: strategies of ['west', 'east'], not of each agent in order"],
        ),
        (miscount_potential, ["round 1: Φ is 6.100000 s, not 6.000000 s"]),
        (move_meeting, ["round 1: t_c is 10.500000 s, not 10.000000 s"]),
        (
            claim_more,
            ["west: task claimed satisfied 3 times, by its steps it was 2 times"],
        ),
        (
            claim_earlier,
            ["west: task claimed satisfied at 4.500 s, by its steps it was at 5.000 s"],
        ),
        (
            act_elsewhere,
            [
                (
                    "west: 4.000 s: jumps by 1.000 m from where its velocity leads; "
                    "2 times, at most 1.000 m"
                ),
                "west: 4.000 s: 'pick' done 1.000 m from 'left', whose radius is 0.3 m",
                "west: 5.000 s: 'pick' done 1.000 m from 'left', whose radius is 0.3 m",
            ],
        ),
        (act_hastily, ["east: 5.500 s: 'pick' took 0.500 s, not 1 s"]),
        (never_start, ["west: 15.000 s: 'pick' finished, but never started"]),
        (act_nowhere, ["east: 4.500 s: no region 'moon'"]),
    ],
    ids=lambda value: getattr(value, "__name__", ""),
)
def test_one_thing_wrong(spoil: Callable[[RunRecords], None], violations: list[str]) -> None:
    """Each thing that is wrong is found, with agent, time and figure, and nothing else."""
    records = hand_made_records()
    spoil(records)
    found = audit(records)
    assert list(found.violations) == violations
    assert found.document()["verdict"] == violations


def test_an_unsatisfied_task_is_found() -> None:
    """A task that goes without satisfaction for more than its windows is a violation."""
    records = hand_made_records()
    last = [own for own in records.odometry if own.stamp_ns == 25 * S]
    records.odometry += [
        replace(own, stamp_ns=time_s * S) for time_s in range(26, 48) for own in last
    ]
    found = audit(records, end_s=47.0)
    assert found.violations == (
        "east: task not satisfied from 15.500 s to 47.000 s",
        "west: task not satisfied from 15.000 s to 47.000 s",
    )


def test_a_failed_attempt_leaves_the_task_a_window_more() -> None:
    """So much the gap may be longer, and no more."""
    records = hand_made_records()
    last = [own for own in records.odometry if own.stamp_ns == 25 * S]
    records.odometry += [
        replace(own, stamp_ns=time_s * S) for time_s in range(26, 48) for own in last
    ]
    event = TaskEvent(TaskEventKind.FAULT, "left", "pick", 2, 3, "action=pick attempt=1")
    records.tasks.append(TaskRecord(26 * S, "west", event))
    assert audit(records, end_s=47.0).violations == (
        "east: task not satisfied from 15.500 s to 47.000 s",
    )


def test_the_last_round_may_be_cut() -> None:
    """When the run ends before a meeting does, not all need hold what is decided there."""
    records = hand_made_records()
    records.tasks = [own for own in records.tasks if own.stamp_ns < 22 * S]
    drop_strategy(records)
    assert audit(records).violations == ()


def test_damage_is_a_violation() -> None:
    """A bag that couldn't be read to its end is never well, however well its beginning is."""
    found = audit_run(
        hand_made_scenario(), Method.TEAM, hand_made_records(), 25 * S, "the file has no end"
    )
    assert found.violations == ("the bag is damaged: the file has no end",)
    assert found.document()["note"] == "the file has no end"
    assert math.isclose(found.sim_s, 25.0)
