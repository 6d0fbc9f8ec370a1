"""What an agent has done of its plan, and what it told besides.

``done_steps``  the steps, as done
``incidents``   faults and changes of plan or task
"""

from collections.abc import Iterable
from typing import Any, Final

from tlcomm_core.agent.actions import TaskEventKind
from tlcomm_core.records import TaskRecord
from tlcomm_core.units import seconds

__all__ = ["done_steps", "incidents"]

_DIGITS: Final = 3
_DONE: Final = (TaskEventKind.ACTION_FINISHED, TaskEventKind.REGION_VISITED)
_TOLD: Final = (TaskEventKind.FAULT, TaskEventKind.PLAN_CHANGED, TaskEventKind.TASK_CHANGED)


def done_steps(tasks: Iterable[TaskRecord]) -> list[tuple[float, int, str, str]]:
    """Return when (s) which step was done, by its index in the plan, its region and action.

    Args:
        tasks: one agent's events, in order of time.
    """
    return [
        (_time_s(own), own.event.plan_index, own.event.region, own.event.action)
        for own in tasks
        if own.event.kind in _DONE
    ]


def incidents(tasks: Iterable[TaskRecord]) -> list[dict[str, Any]]:
    """Return what was told of faults and of changed plans and tasks, in order of time."""
    return [
        {
            "time_s": _time_s(own),
            "agent": own.agent,
            "kind": own.event.kind.name.lower().replace("_", " "),
            "region": own.event.region,
            "action": own.event.action,
            "detail": own.event.detail,
        }
        for own in tasks
        if own.event.kind in _TOLD
    ]


def _time_s(record: TaskRecord) -> float:
    return round(seconds(record.stamp_ns), _DIGITS)
