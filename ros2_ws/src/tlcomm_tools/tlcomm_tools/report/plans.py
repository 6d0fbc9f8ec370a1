"""The ways that an agent had before it, as they were published for viewers.

``Plans``         an agent's ways ahead, over time
``read_plans``    those of all agents, from a bag
``read_corners``  a published way
``NO_PLANS``      those of a run that nobody mirrored
``PLAN_TYPE``     of their messages
``COLUMNS``       what a document calls the columns of a table of them
"""

import struct
from collections import defaultdict
from collections.abc import Mapping, Sequence
from pathlib import Path
from types import MappingProxyType
from typing import Any, Final

from tlcomm_core.units import seconds
from tlcomm_tools.bag.cdr import Cursor
from tlcomm_tools.bag.container import Channel, read_container
from tlcomm_tools.bag.reader import find_files
from tlcomm_tools.bag.topics import split_topic

__all__ = ["COLUMNS", "NO_PLANS", "PLAN_TYPE", "Corner", "Plans", "read_corners", "read_plans"]

_TOPIC: Final = "plan"
_DIGITS: Final = 3

PLAN_TYPE: Final = "nav_msgs/msg/Path"
"""Of the topics that they are on."""

COLUMNS: Final = ("times_s", "way", "first")
"""What the rows of ``Plans`` are called in a document."""

# Its coordinates in metres.
Corner = tuple[float, float]

_COUNT: Final = struct.Struct("<I")
# A pose's position; neither its height nor where it looks is shown.
_PLACE: Final = struct.Struct("<dd40x")
_WIDTH: Final = 8


class Plans:
    """An agent's ways ahead, over time.

    Attributes:
        ways: each that differs from the one before by more than what was driven since.
        rows: from a time on (s), which of the ways is ahead, and from which corner on.
    """

    def __init__(self) -> None:
        """Begin without any."""
        self.ways: list[list[Corner]] = []
        self.rows: list[tuple[float, int, int]] = []

    def take(self, stamp_ns: int, corners: Sequence[Corner]) -> None:
        """Take the corners that are ahead from a time on."""
        way = [(round(x_m, _DIGITS), round(y_m, _DIGITS)) for x_m, y_m in corners]
        last = self.ways[-1] if self.ways else []
        first = len(last) - len(way)
        if first < 0 or last[first:] != way:
            self.ways.append(way)
            first = 0
        row = round(seconds(stamp_ns), _DIGITS), len(self.ways) - 1, first
        if self.ways and (not self.rows or self.rows[-1][1:] != row[1:]):
            self.rows.append(row)

    def document(self) -> dict[str, Any]:
        """Return what a page knows of them, as parts of an agent."""
        columns = zip(*self.rows, strict=True) if self.rows else ((), (), ())
        return {"ways": self.ways, "ahead": dict(zip(COLUMNS, map(list, columns), strict=True))}


NO_PLANS: Final[Mapping[str, Plans]] = MappingProxyType({})
"""Of a run that nobody mirrored."""


def read_plans(path: Path) -> Mapping[str, Plans]:
    """Return each agent's ways ahead, from a run's folder, a bag or a file; as far as they go.

    Raises:
        InputError: there is no bag.

    Cost: about 0.5 s for 100 rounds of 8 agents.
    """
    plans = defaultdict[str, Plans](Plans)
    for file in find_files(path):
        container = read_container(file, _is_plan)
        for number, stamp_ns, data in container.messages:
            agent, _ = split_topic(container.channels[number].topic)
            plans[agent].take(stamp_ns, read_corners(data))
    return plans


def _is_plan(channel: Channel) -> bool:
    return channel.topic.endswith(f"/{_TOPIC}") and channel.type == PLAN_TYPE


def read_corners(data: bytes) -> list[Corner]:
    """Return the corners that a ``nav_msgs/Path`` leads by, without where the agent is itself.

    There are thousands of paths, of which nothing but this is shown: decoding them would take ten
    times as long.

    Args:
        data: a path's serialization; one that makes no sense has no corners.
    """
    places = []
    try:
        cursor = Cursor(data)
        cursor.skip_header()
        (count,) = cursor.take(_COUNT)
        for _ in range(count):
            cursor.skip_header()
            places.append(cursor.take(_PLACE, _WIDTH))
    except ValueError:
        return []
    return places[1:]
