"""Paths as ``nav_msgs/Path``.

``make_plan``   the plan ahead
``make_trail``  the path behind
"""

from collections.abc import Iterable, Sequence

from rosbags.typesys.stores import ros2_jazzy as ros

from tlcomm_core.geometry import Pose
from tlcomm_core.world.observation import Odometry
from tlcomm_tools.mirror.elements import make_header, make_pose
from tlcomm_tools.mirror.way import Corner

__all__ = ["make_plan", "make_trail"]


def make_trail(trail: Iterable[Odometry], now_ns: int) -> ros.nav_msgs__msg__Path:
    """Return where an agent has driven, each pose with its time."""
    return _path(now_ns, ((own.stamp_ns, own.pose) for own in trail))


def make_plan(
    here: Odometry | None, corners: Sequence[Corner], now_ns: int
) -> ros.nav_msgs__msg__Path:
    """Return where an agent will drive: from where it is, by some corners.

    Each pose's stamp is when the agent is expected to be done at the next stop. The path is empty
    if there is no corner.
    """
    ahead = [(corner.stamp_ns, corner.pose) for corner in corners]
    return _path(now_ns, [(now_ns, here.pose), *ahead] if here and ahead else ())


def _path(now_ns: int, poses: Iterable[tuple[int, Pose]]) -> ros.nav_msgs__msg__Path:
    return ros.nav_msgs__msg__Path(
        make_header(now_ns),
        [
            ros.geometry_msgs__msg__PoseStamped(make_header(stamp_ns), make_pose(pose))
            for stamp_ns, pose in poses
        ],
    )
