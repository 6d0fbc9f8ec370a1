"""When the team was connected, by the world's own account.

``connected_intervals``  from when to when
"""

from collections.abc import Sequence

from tlcomm_core.world.observation import Connectivity

__all__ = ["connected_intervals"]


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
