"""Maps as the sim shows them and agents read them, with the real message classes."""

from array import array

import numpy as np
import pytest
from builtin_interfaces.msg import Time
from nav_msgs.msg import OccupancyGrid
from rclpy.serialization import deserialize_message, serialize_message

from tlcomm_agent.wire_map import decode_map
from tlcomm_core.wire.fields import WireError
from tlcomm_core.workspace.grid import Grid
from tlcomm_core.world.observation import Occupancy
from tlcomm_sim.wire import encode_occupancy

# Of a resolution that no float has, 32 bits or 64.
GRID = Grid((0.5, 0.3), 0.1, [(-1.6, 2.3, -1.4, 2.4), (-1.3, 2.5, -1.2, 2.6)], (-1.7, 2.3))


def shown(stamp_ns: int = 1_500_000_007) -> OccupancyGrid:
    """Return the map after it has been bytes."""
    data = serialize_message(encode_occupancy(Occupancy(stamp_ns, GRID)))
    return deserialize_message(data, OccupancyGrid)


def test_agents_read_the_cells_of_the_world() -> None:
    """And from when on they are so."""
    stamp_ns, free = decode_map(shown(), GRID)
    np.testing.assert_array_equal(free, GRID.free)
    assert stamp_ns == 1_500_000_007


def test_a_map_is_as_others_expect_it() -> None:
    """In frame map, by rows from the lower left, 0 for free and 100 for occupied."""
    message = shown()
    assert message.header.frame_id == "map"
    assert list(message.data) == [0, 100, 100, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 100]
    assert (message.info.width, message.info.height) == (5, 3)
    assert message.info.resolution == pytest.approx(0.1)
    assert (message.info.origin.position.x, message.info.origin.position.y) == (-1.7, 2.3)
    assert message.info.origin.orientation.w == 1.0


def test_what_isnt_known_to_be_free_is_closed() -> None:
    """Unknown cells, and those that are occupied as likely as not."""
    message = shown()
    message.data = array("b", [-1, 0, 49, 50, 100, *[0] * 10])
    _, free = decode_map(message, GRID)
    assert free[0].tolist() == [False, True, True, False, False]


@pytest.mark.parametrize(
    ("field", "value", "reason"),
    [
        ("width", 6, "size: 6 x 3 cells, not 5 x 3"),
        ("height", 1, "size: 5 x 1 cells, not 5 x 3"),
        ("resolution", 0.11, "resolution: 0.1[0-9]+ m, not 0.1"),
        ("resolution", float("nan"), "resolution: nan"),
    ],
)
def test_other_cells_are_refused(field: str, value: float, reason: str) -> None:
    """Plans and places of meeting are reckoned in the scenario's cells."""
    message = shown()
    setattr(message.info, field, value)
    with pytest.raises(WireError, match=reason):
        decode_map(message, GRID)


def test_other_places_are_refused() -> None:
    """A map from elsewhere, turned, of too few cells or from no time of a run."""
    moved, turned, short, untimely = shown(), shown(), shown(), shown()
    moved.info.origin.position.x = float("nan")
    turned.info.origin.orientation.z = 1.0
    short.data = array("b", [0] * 14)
    untimely.header.stamp = Time(sec=-1)
    for message, reason in (
        (moved, "origin: "),
        (turned, "origin: the map is turned"),
        (short, "size: "),
        (untimely, "stamp: "),
    ):
        with pytest.raises(WireError, match=reason):
            decode_map(message, GRID)
