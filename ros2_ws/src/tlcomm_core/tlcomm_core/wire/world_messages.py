"""What the world shows agents, and what they command in it, as values.

``decode_map``      which cells are free
``decode_reading``  what an agent measures
``decode_command``  a velocity command
"""

from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from tlcomm_core.wire.fields import WireError, decode_stamp, finite
from tlcomm_core.world.observation import Reading

__all__ = ["decode_command", "decode_map", "decode_reading"]

# Occupied as likely as not counts as occupied, and so does what isn't known (−1).
_OCCUPIED: Final = 50

# Whoever made the message made its classes: what matters is checked here, field by field.
_Message = Any


def decode_map(message: _Message) -> tuple[int, NDArray[np.bool_]]:
    """Return from when on (ns) which cells are free, bool[rows, columns].

    Args:
        message: a ``nav_msgs/OccupancyGrid``.

    Raises:
        WireError: it hasn't as many cells as it says, or a malformed stamp.
    """
    rows, columns = message.info.height, message.info.width
    cells = np.asarray(message.data, dtype=np.int8)
    if cells.size != rows * columns:
        raise WireError(f"a map of {columns} x {rows} cells has {cells.size} of them")
    cells = cells.reshape(rows, columns)
    return decode_stamp(message.header.stamp), (cells >= 0) & (cells < _OCCUPIED)


def decode_reading(message: _Message) -> Reading:
    """Return what an agent measures.

    Args:
        message: a ``tlcomm_msgs/Reading``.

    Raises:
        WireError: a value that isn't finite, or a malformed stamp.
    """
    return Reading(
        stamp_ns=decode_stamp(message.header.stamp),
        agent=message.agent,
        region=message.region,
        value=finite(message.value, "value"),
    )


def decode_command(message: _Message) -> tuple[float, float]:
    """Return a command's velocities (m/s, rad/s), finite or not: the world refuses the latter.

    Args:
        message: a ``geometry_msgs/TwistStamped``.
    """
    return message.twist.linear.x, message.twist.angular.z
