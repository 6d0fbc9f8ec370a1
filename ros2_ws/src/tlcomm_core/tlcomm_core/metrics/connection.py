"""When the team was connected, by the world's own account.

``connected_intervals``  from when to when
``windows_of``           whether that was long enough in each window of communication
"""

from collections.abc import Sequence

from tlcomm_core.records import RunRecords
from tlcomm_core.scenario.model import Scenario
from tlcomm_core.windows import Window, judge_windows
from tlcomm_core.world.observation import Connectivity

__all__ = ["connected_intervals", "windows_of"]


def connected_intervals(connectivity: Sequence[Connectivity], end_ns: int) -> list[tuple[int, int]]:
    """Return [from, to) of each connection of the whole team; the last state holds to the end."""
    intervals: list[tuple[int, int]] = []
    since_ns: int | None = None
    for seen in connectivity:
        if seen.connected and since_ns is None:
            since_ns = seen.stamp_ns
        elif not seen.connected and since_ns is not None:
            intervals.append((since_ns, seen.stamp_ns))
            since_ns = None
    if since_ns is not None:
        intervals.append((since_ns, end_ns))
    return intervals


def windows_of(scenario: Scenario, records: RunRecords, end_ns: int) -> tuple[Window, ...]:
    """Return the outcome of every window that is decided by the end, whatever the method.

    Source: constraint (2) of the paper.
    """
    timing = scenario.communication
    connected_ns = connected_intervals(records.connectivity, end_ns)
    return judge_windows(connected_ns, timing.period_s, timing.duration_s, end_ns)
