"""Tests of ``tlcomm_core.metrics.connection``."""

from tlcomm_core.metrics.connection import connected_intervals
from tlcomm_core.world.observation import Connectivity


def test_the_last_connection_lasts_to_the_end() -> None:
    """Repeated states don't split an interval, and the last one holds until the end."""
    seen = [
        Connectivity(0, (), False),
        Connectivity(10, ((0, 1),), True),
        Connectivity(20, ((0, 1),), True),
        Connectivity(30, (), False),
        Connectivity(40, ((0, 1),), True),
    ]
    assert connected_intervals(seen, 70) == [(10, 30), (40, 70)]
