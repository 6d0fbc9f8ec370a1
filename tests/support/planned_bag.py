"""The run made by hand, with ways ahead as viewers are shown them.

``PLANS``              what is ahead of the agent "east", by time (s)
``encode_path``        a ``nav_msgs/Path`` from the origin by some corners, in CDR
``write_planned_bag``  a bag of it
"""

from collections.abc import Sequence
from pathlib import Path
from typing import Final

from support.hand_made_run import (
    AGENTS,
    SHARE,
    hand_made_records,
    hand_made_scenario,
    serialize_run,
)
from tlcomm_core.geometry import Pose
from tlcomm_core.scenario.loader import dumps
from tlcomm_core.units import nanoseconds
from tlcomm_core.world.observation import Odometry
from tlcomm_tools.bag.definitions import load_typestore, read_definition
from tlcomm_tools.bag.topics import mirror_topics, recorded_topics
from tlcomm_tools.bag.writer import BagWriter
from tlcomm_tools.mirror.paths import encode_plan
from tlcomm_tools.mirror.way import Corner

__all__ = ["PLANS", "encode_path", "write_planned_bag"]

PLANS: Final[dict[float, list[tuple[float, float]]]] = {
    0.0: [],
    2.0: [(6.25, 0.25), (3.75, 0.25)],
    4.0: [(6.25, 0.25), (3.75, 0.25)],
    6.0: [(3.75, 0.25)],
    8.0: [(3.75, 0.25)],
    10.0: [],
    12.0: [(6.25, 0.25), (3.75, 0.25)],
}
_STORE: Final = load_typestore(SHARE)


def encode_path(corners: Sequence[tuple[float, float]], stamp_ns: int = 0) -> bytes:
    """Return a way that begins at the origin."""
    here = Odometry(stamp_ns, "east", Pose(0.0, 0.0, 0.0), 0.0, 0.0)
    return encode_plan(here, [Corner(0, 0, Pose(x_m, y_m, 0.0)) for x_m, y_m in corners], stamp_ns)


def write_planned_bag(folder: Path) -> Path:
    """Write the hand-made run and ``PLANS``; return the file."""
    topics = (*recorded_topics(AGENTS), *mirror_topics(AGENTS))
    definitions = {topic.type: read_definition(_STORE, topic.type) for topic in topics}
    rows = [*serialize_run(_STORE, hand_made_records())]
    for time_s, corners in PLANS.items():
        stamp_ns = nanoseconds(time_s)
        rows.append(("/east/plan", stamp_ns, encode_path(corners, stamp_ns)))
    numbers = {topic.name: number for number, topic in enumerate(topics)}
    notes = {"scenario": dumps(hand_made_scenario())}
    with BagWriter(folder, topics, definitions, notes) as writer:
        for name, stamp_ns, data in sorted(rows, key=lambda row: row[1]):
            writer.write(numbers[name], stamp_ns, data)
    return writer.path
