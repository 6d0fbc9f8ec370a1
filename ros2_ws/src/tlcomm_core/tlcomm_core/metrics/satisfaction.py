"""How often an agent satisfies its task.

``satisfied_ns``    when it did
``makespan_s``      the longest time between two satisfactions, ξ_i
``mean_cycle_s``    the mean time between two
``tasks_per_hour``  how many there are in an hour
"""

from collections.abc import Sequence
from itertools import pairwise
from typing import Final

from tlcomm_core.agent.actions import TaskEventKind
from tlcomm_core.records import RunRecords
from tlcomm_core.units import seconds

__all__ = ["makespan_s", "mean_cycle_s", "satisfied_ns", "tasks_per_hour"]

_HOUR_S: Final = 3600.0


def satisfied_ns(agent: str, records: RunRecords) -> list[int]:
    """Return when an agent satisfied its task, t_{i,1}, t_{i,2}, …; fresh."""
    return [
        record.stamp_ns
        for record in records.tasks
        if record.agent == agent and record.event.kind is TaskEventKind.TASK_SATISFIED
    ]


def makespan_s(moments_ns: Sequence[int]) -> float | None:
    """Return ξ_i = max_k t_{i,k+1} − t_{i,k}; ``None`` with fewer than two satisfactions.

    Args:
        moments_ns: when the task was satisfied, ascending.

    Source: Section III-C of the paper.
    """
    gaps_ns = [later - earlier for earlier, later in pairwise(moments_ns)]
    return seconds(max(gaps_ns)) if gaps_ns else None


def mean_cycle_s(moments_ns: Sequence[int]) -> float | None:
    """Return (t_{i,K} − t_{i,1}) / (K − 1); ``None`` with fewer than two satisfactions.

    Args:
        moments_ns: when the task was satisfied, ascending.
    """
    passes = len(moments_ns) - 1
    return seconds(moments_ns[-1] - moments_ns[0]) / passes if passes > 0 else None


def tasks_per_hour(count: int, end_s: float) -> float | None:
    """Return how many satisfactions there were per hour until the end; ``None`` if that is 0."""
    return count * _HOUR_S / end_s if end_s > 0.0 else None
