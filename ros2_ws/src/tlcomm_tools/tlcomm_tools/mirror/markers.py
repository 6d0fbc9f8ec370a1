"""Markers as ``visualization_msgs/MarkerArray``.

``make_region_markers``  the regions, which stay
``make_team_markers``    agents, radio links, and where the team meets next

Each kind is a namespace of its own, so that viewers can hide it. An array replaces the one before
it: what has gone from it is deleted.
"""

from collections.abc import Iterator
from itertools import chain
from typing import Any, Final

import numpy as np
from rosbags.typesys.stores import ros2_jazzy as ros

from tlcomm_core.geometry import Pose
from tlcomm_tools.mirror.elements import (
    FRAME,
    Colour,
    agent_colour,
    make_header,
    make_point,
    make_pose,
    make_time,
)
from tlcomm_tools.mirror.picture import Picture

__all__ = ["make_region_markers", "make_team_markers"]

_Marker: Final = ros.visualization_msgs__msg__Marker
_ORIGIN: Final = make_pose(Pose(0.0, 0.0, 0.0))
_NO_IMAGE: Final = ros.sensor_msgs__msg__CompressedImage(
    ros.std_msgs__msg__Header(make_time(0), ""), "", np.zeros(0, np.uint8)
)
_NO_MESH: Final = ros.visualization_msgs__msg__MeshFile("", np.zeros(0, np.uint8))
_FOR_EVER: Final = ros.builtin_interfaces__msg__Duration(0, 0)

_REGION: Final[Colour] = (0.55, 0.60, 0.75, 0.35)
_LETTERS: Final[Colour] = (0.35, 0.35, 0.35, 1.0)
_LINK: Final[Colour] = (0.20, 0.70, 0.30, 0.9)
_BROKEN_LINK: Final[Colour] = (0.95, 0.55, 0.10, 0.9)
# Sizes in cells, which agents are about as large as.
_AGENT: Final = 0.7
_TEXT: Final = 0.55
_PLACE: Final = 0.35
_LINE: Final = 0.08


def make_region_markers(picture: Picture, now_ns: int) -> ros.visualization_msgs__msg__MarkerArray:
    """Return the regions with their names.

    Regions lie on the map, since viewers hide what is under it. Their names are below the middle,
    agents' above, so that both can be read where an agent stands in the middle.
    """
    return _array(now_ns, _regions(picture))


def make_team_markers(picture: Picture, now_ns: int) -> ros.visualization_msgs__msg__MarkerArray:
    """Return agents and radio links, and each agent's place at the meeting that it holds as next.

    Links are of another colour while they don't connect the whole team.
    """
    return _array(now_ns, chain(_links(picture), _agents(picture), _places(picture)))


def _array(now_ns: int, markers: Iterator[Any]) -> ros.visualization_msgs__msg__MarkerArray:
    header = make_header(now_ns)
    kept = [_marker("", 0, _Marker.ARROW, action=_Marker.DELETEALL), *markers]
    for marker in kept:
        marker.header = header
    return ros.visualization_msgs__msg__MarkerArray(kept)


def _regions(picture: Picture) -> Iterator[ros.visualization_msgs__msg__Marker]:
    size_m = _TEXT * picture.site.grid.cell_m
    for number, (name, disc) in enumerate(picture.site.region_discs.items()):
        x_m, y_m, radius_m = disc
        place = Pose(x_m, y_m, 0.0)
        width_m = 2.0 * radius_m
        yield _marker(
            "regions",
            number,
            _Marker.CYLINDER,
            make_pose(place, 0.01),
            (width_m, width_m, 0.01),
            _REGION,
        )
        below = Pose(x_m, y_m - size_m, 0.0)
        yield _text("region_names", number, below, name, size_m)


def _agents(picture: Picture) -> Iterator[ros.visualization_msgs__msg__Marker]:
    cell_m = picture.site.grid.cell_m
    scale_m = (_AGENT * cell_m, 0.4 * _AGENT * cell_m, 0.3 * _AGENT * cell_m)
    size_m = _TEXT * cell_m
    for number, (name, agent) in enumerate(picture.agents.items()):
        if agent.odometry is None:
            continue
        pose = agent.odometry.pose
        colour = agent_colour(number)
        yield _marker("agents", number, _Marker.ARROW, make_pose(pose), scale_m, colour)
        above = Pose(pose.x_m, pose.y_m + size_m, 0.0)
        yield _text("agent_names", number, above, name, size_m)


def _links(picture: Picture) -> Iterator[ros.visualization_msgs__msg__Marker]:
    """Yield one list of lines; none is no marker, since viewers complain of empty lists."""
    connectivity = picture.connectivity
    if connectivity is None:
        return
    stands = [agent.odometry for agent in picture.agents.values()]
    points = []
    for ends in connectivity.edges:
        poses = [own.pose for own in (stands[end] for end in ends if end < len(stands)) if own]
        if len(poses) == len(ends):
            points += [make_point(pose.x_m, pose.y_m) for pose in poses]
    if points:
        width_m = _LINE * picture.site.grid.cell_m
        colour = _LINK if connectivity.connected else _BROKEN_LINK
        line = _marker("links", 0, _Marker.LINE_LIST, _ORIGIN, (width_m, 0.0, 0.0), colour)
        line.points = points
        yield line


def _places(picture: Picture) -> Iterator[ros.visualization_msgs__msg__Marker]:
    """Yield a disc in each agent's colour; not one list, whose colours some viewers brighten."""
    size_m = _PLACE * picture.site.grid.cell_m
    scale_m = (size_m, size_m, 0.02)
    for number, (name, agent) in enumerate(picture.agents.items()):
        own = agent.strategy_of(name)
        if own is not None:
            pose = make_pose(Pose(own.x_m, own.y_m, 0.0), 0.03)
            yield _marker("meeting", number, _Marker.CYLINDER, pose, scale_m, agent_colour(number))


def _text(
    namespace: str, number: int, place: Pose, text: str, size_m: float
) -> ros.visualization_msgs__msg__Marker:
    pose = make_pose(place, 0.1)
    scale_m = (0.0, 0.0, size_m)
    marker = _marker(namespace, number, _Marker.TEXT_VIEW_FACING, pose, scale_m, _LETTERS)
    marker.text = text
    return marker


def _marker(
    namespace: str,
    number: int,
    shape: int,
    pose: ros.geometry_msgs__msg__Pose = _ORIGIN,
    scale_m: tuple[float, float, float] = (0.0, 0.0, 0.0),
    colour: Colour = _LETTERS,
    action: int = _Marker.ADD,
) -> ros.visualization_msgs__msg__Marker:
    return _Marker(
        header=ros.std_msgs__msg__Header(make_time(0), FRAME),
        ns=namespace,
        id=number,
        type=shape,
        action=action,
        pose=pose,
        scale=ros.geometry_msgs__msg__Vector3(*scale_m),
        color=ros.std_msgs__msg__ColorRGBA(*colour),
        lifetime=_FOR_EVER,
        frame_locked=False,
        points=[],
        colors=[],
        texture_resource="",
        texture=_NO_IMAGE,
        uv_coordinates=[],
        text="",
        mesh_resource="",
        mesh_file=_NO_MESH,
        mesh_use_embedded_materials=False,
    )
