"""Simulated time as an integer count of nanoseconds outside the brain, as seconds inside.

``nanoseconds``, ``seconds``  from one to the other
``is_due``                    whether a time has come
"""

from typing import Final

__all__ = ["NANOSECONDS_PER_SECOND", "is_due", "nanoseconds", "seconds"]

NANOSECONDS_PER_SECOND: Final = 1_000_000_000

# Simulated time has nanoseconds: a time less than this ahead has come.
_RESOLUTION_S: Final = 1e-9


def nanoseconds(time_s: float) -> int:
    """Return the nearest count of nanoseconds."""
    return round(time_s * NANOSECONDS_PER_SECOND)


def seconds(time_ns: int) -> float:
    """Return the nearest time in seconds."""
    return time_ns / NANOSECONDS_PER_SECOND


def is_due(time_s: float, now_s: float) -> bool:
    """Tell whether a time has come."""
    return now_s >= time_s - _RESOLUTION_S
