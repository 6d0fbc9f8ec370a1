"""Tests of ``tlcomm_core.wire.world_messages``: fields by name, whoever made the message."""

import math
from array import array
from types import SimpleNamespace

import numpy as np
import pytest

from tlcomm_core.wire.fields import WireError
from tlcomm_core.wire.world_messages import decode_command, decode_map, decode_reading
from tlcomm_core.world.observation import Reading

HEADER = SimpleNamespace(stamp=SimpleNamespace(sec=1, nanosec=5))


def grid(*cells: int) -> SimpleNamespace:
    """Return a map of 3 x 2 cells, as a bag's decoder does."""
    info = SimpleNamespace(width=3, height=2)
    return SimpleNamespace(header=HEADER, info=info, data=np.array(cells, dtype=np.int8))


def test_cells_are_free_if_they_are_known_to_be() -> None:
    """Row by row; what is unknown, or occupied as likely as not, isn't free."""
    expected = [[True, False, False], [True, False, True]]
    message = grid(0, 100, -1, 49, 50, 0)
    stamp_ns, free = decode_map(message)
    assert (stamp_ns, free.tolist()) == (1_000_000_005, expected)
    message.data = array("b", message.data.tobytes())
    assert decode_map(message)[1].tolist() == expected


def test_a_map_of_too_few_cells_is_refused() -> None:
    """Its sizes and its cells must agree."""
    with pytest.raises(WireError, match="a map of 3 x 2 cells has 4 of them"):
        decode_map(grid(0, 0, 0, 0))


def test_readings_are_finite() -> None:
    """A sensor that fails doesn't become an estimate."""
    reading = SimpleNamespace(header=HEADER, agent="west", region="shelf", value=2.5)
    assert decode_reading(reading) == Reading(1_000_000_005, "west", "shelf", 2.5)
    reading.value = math.nan
    with pytest.raises(WireError, match="value: nan isn't finite"):
        decode_reading(reading)


def test_commands_are_read_as_they_are() -> None:
    """Along x and round z, finite or not."""
    linear, angular = SimpleNamespace(x=math.inf, y=7.0), SimpleNamespace(x=7.0, z=-1.5)
    twist = SimpleNamespace(linear=linear, angular=angular)
    assert decode_command(SimpleNamespace(twist=twist)) == (math.inf, -1.5)
