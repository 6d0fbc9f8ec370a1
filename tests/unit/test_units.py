"""Nanoseconds and seconds."""

import pytest

from tlcomm_core.units import nanoseconds, seconds


@pytest.mark.parametrize("time_ns", [0, 1, 5_000_000, 36_155_755_003, 86_400_000_000_001])
def test_nanoseconds_survive_seconds(time_ns: int) -> None:
    """A day in float seconds still tells nanoseconds apart."""
    assert nanoseconds(seconds(time_ns)) == time_ns


def test_seconds_round_to_the_nearest_nanosecond() -> None:
    """Neither up nor down as a rule."""
    assert nanoseconds(1.0000000004) == 1_000_000_000
    assert nanoseconds(1.0000000006) == 1_000_000_001
    assert nanoseconds(0.1 + 0.2) == 300_000_000
