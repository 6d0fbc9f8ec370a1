"""Tests of ``tlcomm_tools.mirror.paths``."""

import math

import pytest
from rosbags.typesys.stores import ros2_jazzy as ros

from support.hand_made_run import SHARE
from tlcomm_core.geometry import Pose
from tlcomm_core.units import nanoseconds
from tlcomm_core.world.observation import Odometry
from tlcomm_tools.bag.definitions import load_typestore
from tlcomm_tools.mirror.elements import make_header, make_pose
from tlcomm_tools.mirror.paths import encode_plan, encode_trail
from tlcomm_tools.mirror.way import Corner

NOW_NS = nanoseconds(61.25)


def serialized(poses: list[tuple[int, Pose]]) -> bytes:
    """Return a path as the library for bags serializes it."""
    stamped = [
        ros.geometry_msgs__msg__PoseStamped(make_header(stamp_ns), make_pose(pose))
        for stamp_ns, pose in poses
    ]
    path = ros.nav_msgs__msg__Path(make_header(NOW_NS), stamped)
    return bytes(load_typestore(SHARE).serialize_cdr(path, "nav_msgs/msg/Path"))


@pytest.mark.parametrize("length", range(4))
def test_a_path_is_what_a_serializer_makes_of_it(length: int) -> None:
    """Byte for byte, empty or of any length."""
    poses = [Pose(0.5 * number, -1.0 / 3.0, 0.7 * number) for number in range(length)]
    trail = [
        Odometry(nanoseconds(0.3 * number), "east", pose, 1.0, 0.0)
        for number, pose in enumerate(poses)
    ]
    assert encode_trail(trail, NOW_NS) == serialized([(own.stamp_ns, own.pose) for own in trail])


def test_a_plan_begins_where_its_agent_is() -> None:
    """Now and here; and where there is nowhere to go it is empty."""
    here = Odometry(nanoseconds(61.0), "east", Pose(1.0, 2.0, math.pi), 1.0, 0.0)
    corner = Corner(3, nanoseconds(65.0), Pose(4.0, 2.0, 0.0))
    expected = serialized([(NOW_NS, here.pose), (corner.stamp_ns, corner.pose)])
    assert encode_plan(here, [corner], NOW_NS) == expected
    assert encode_plan(None, [corner], NOW_NS) == encode_plan(here, [], NOW_NS) == serialized([])
