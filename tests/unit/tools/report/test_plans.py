"""The ways that an agent had before it."""

from pathlib import Path

import pytest

from support.hand_made_run import SHARE
from support.planned_bag import PLANS, encode_path, write_planned_bag
from tlcomm_core.units import nanoseconds
from tlcomm_tools.bag.definitions import load_typestore
from tlcomm_tools.report.plans import PLAN_TYPE, Plans, read_corners, read_plans

STORE = load_typestore(SHARE)
WAY = [(1.0, 2.0), (3.0, 4.0), (5.0, 6.0)]


@pytest.mark.parametrize("frame", ["map", "", "a longer frame"])
@pytest.mark.parametrize("count", range(4))
def test_corners_are_read_as_they_were_written(count: int, frame: str) -> None:
    """Without the place where the agent is, whatever the frame is called."""
    path = STORE.deserialize_cdr(encode_path(WAY[:count]), PLAN_TYPE)
    for header in (path.header, *(pose.header for pose in path.poses)):
        header.frame_id = frame
    assert read_corners(bytes(STORE.serialize_cdr(path, PLAN_TYPE))) == WAY[:count]


def test_what_makes_no_sense_has_no_corners() -> None:
    """A message that was cut anywhere, a number too large, another byte order."""
    data = encode_path(WAY)
    for length in range(len(data)):
        assert read_corners(data[:length]) in ([], WAY)
    assert read_corners(b"\x00\x00\x00\x00" + data[4:]) == []
    assert read_corners(data[:16] + b"\xff" * 8 + data[24:]) == []


def test_what_is_driven_makes_no_new_way() -> None:
    """Some of the corners, none, or all again: they belong to one way. Others make another."""
    plans = Plans()
    other = [(9.0, 9.0), *WAY[1:]]
    for second, corners in enumerate([WAY, WAY, WAY[1:], [], WAY, other, other[:2]]):
        plans.take(nanoseconds(2.0 * second), corners)
    assert plans.ways == [WAY, other, other[:2]]
    assert plans.rows == [
        *((0.0, 0, 0), (4.0, 0, 1), (6.0, 0, 3), (8.0, 0, 0)),
        *((10.0, 1, 0), (12.0, 2, 0)),
    ]
    assert plans.document()["ahead"]["first"] == [0, 1, 3, 0, 0, 0]
    assert Plans().document() == {"ways": [], "ahead": {"times_s": [], "way": [], "first": []}}


def test_a_bag_has_what_was_published(tmp_path: Path) -> None:
    """At each time what is left of the way is what was published then."""
    plans = read_plans(write_planned_bag(tmp_path / "bag"))["east"]
    for time_s, corners in PLANS.items():
        known = [row for row in plans.rows if row[0] <= time_s]
        left = plans.ways[known[-1][1]][known[-1][2] :] if known else []
        assert left == corners, time_s
    assert len(plans.ways) == 1
