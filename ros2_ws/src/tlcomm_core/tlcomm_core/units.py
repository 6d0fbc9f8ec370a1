"""Simulated time as an integer count of nanoseconds outside the brain, as seconds inside."""

from typing import Final

__all__ = ["NANOSECONDS_PER_SECOND", "nanoseconds", "seconds"]

NANOSECONDS_PER_SECOND: Final = 1_000_000_000


def nanoseconds(time_s: float) -> int:
    """Return the nearest count of nanoseconds."""
    return round(time_s * NANOSECONDS_PER_SECOND)


def seconds(time_ns: int) -> float:
    """Return the nearest time in seconds."""
    return time_ns / NANOSECONDS_PER_SECOND
