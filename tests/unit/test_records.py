"""What a run leaves behind."""

import json
from itertools import permutations

from tlcomm_core.agent.actions import TaskEvent, TaskEventKind
from tlcomm_core.game.strategy import TeamStrategy
from tlcomm_core.records import RunRecords, StrategyRecord, TaskRecord, event_log

STARTED = TaskEvent(TaskEventKind.ACTION_STARTED, "p1", "collect", 1, 3)
FINISHED = TaskEvent(TaskEventKind.ACTION_FINISHED, "p1", "collect", 1, 3)
SATISFIED = TaskEvent(TaskEventKind.TASK_SATISFIED, "p1", "collect", 1, 3)
HELD = TeamStrategy(2, 1, (), 120.5, 3.0, 4.0)


def test_the_log_is_ordered_by_time_and_agent() -> None:
    """The order in which different agents' records came doesn't show."""
    tasks = [
        TaskRecord(20, "a", FINISHED),
        TaskRecord(10, "b", STARTED),
        TaskRecord(10, "a", STARTED),
    ]
    logs = {tuple(event_log(RunRecords(tasks=list(order)))) for order in permutations(tasks)}
    assert len(logs) == 1
    rows = [json.loads(line) for line in logs.pop()]
    assert [(row["stamp_ns"], row["agent"]) for row in rows] == [(10, "a"), (10, "b"), (20, "a")]


def test_an_agents_own_order_within_an_instant_is_kept() -> None:
    """To finish and to satisfy at one instant isn't the same as the other way round."""
    one = RunRecords(tasks=[TaskRecord(1, "a", FINISHED), TaskRecord(1, "a", SATISFIED)])
    other = RunRecords(tasks=[TaskRecord(1, "a", SATISFIED), TaskRecord(1, "a", FINISHED)])
    assert [json.loads(line)["kind"] for line in event_log(one)] == [2, 6]
    assert list(event_log(one)) != list(event_log(other))


def test_a_line_tells_all_of_a_decision() -> None:
    """Task events and strategies with all of their fields."""
    records = RunRecords(
        tasks=[TaskRecord(1, "a", STARTED)], strategies=[StrategyRecord(1, "a", HELD)]
    )
    task, strategy = map(json.loads, event_log(records))
    assert task == {
        "stamp_ns": 1,
        "agent": "a",
        "type": "task",
        "kind": 1,
        "region": "p1",
        "action": "collect",
        "round": 1,
        "plan_index": 3,
        "detail": "",
    }
    assert strategy["type"] == "team_strategy"
    assert (strategy["round"], strategy["communication_s"]) == (2, 120.5)
