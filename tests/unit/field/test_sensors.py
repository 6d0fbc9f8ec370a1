"""Readings are for who truly is at a station."""

from tlcomm_core.field.field import Field
from tlcomm_core.field.sensors import Sensors

FIELD = Field(((0.0, 40.0), (100.0, 50.0)), {"m": 0.0})
DISCS = {"m": (1.0, 2.0, 0.5), "r": (5.0, 5.0, 0.5)}
INSIDE, OUTSIDE = (1.3, 2.4), (1.31, 2.4)


def test_who_is_inside_a_station_reads_it() -> None:
    """Up to the edge of its disc."""
    sensors = Sensors(FIELD, DISCS)
    assert sensors.read("a", "m", INSIDE, 50_000_000_000) == 45.0
    assert sensors.read("a", "m", OUTSIDE, 50_000_000_000) is None


def test_only_stations_can_be_read() -> None:
    """Another region, or none at all, gives nothing."""
    sensors = Sensors(FIELD, DISCS)
    assert sensors.read("a", "r", (5.0, 5.0), 0) is None
    assert sensors.read("a", "nowhere", (5.0, 5.0), 0) is None


def test_noise_is_the_agent_s_own_and_the_seed_s() -> None:
    """What others read in between changes nothing; another seed does."""
    alone = Sensors(FIELD, DISCS, 1.0, 3)
    among = Sensors(FIELD, DISCS, 1.0, 3)
    first = [alone.read("a", "m", INSIDE, 0) for _ in range(3)]
    second = []
    for _ in range(3):
        among.read("b", "m", INSIDE, 0)
        second.append(among.read("a", "m", INSIDE, 0))
    assert first == second
    assert len(set(first)) == 3
    assert Sensors(FIELD, DISCS, 1.0, 4).read("a", "m", INSIDE, 0) != first[0]
