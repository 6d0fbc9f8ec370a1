"""Tests of ``tlcomm_tools.mirror.way`` and of the paths made from it."""

import math
from typing import Any

from support.hand_made_run import SHARE, hand_made_scenario
from tlcomm_core.agent.actions import TaskEvent, TaskEventKind
from tlcomm_core.game.offer import MemberOffer, PlannedStop
from tlcomm_core.game.strategy import Strategy, TeamStrategy
from tlcomm_core.geometry import Pose
from tlcomm_core.method import Method
from tlcomm_core.records import StrategyRecord, TaskRecord
from tlcomm_core.units import nanoseconds
from tlcomm_core.world.observation import Odometry
from tlcomm_tools.bag.definitions import load_typestore
from tlcomm_tools.mirror.paths import encode_plan, encode_trail
from tlcomm_tools.mirror.picture import Picture
from tlcomm_tools.mirror.way import Way


def agreed() -> Picture:
    """Return a picture in which east is to pick at 6.25, and then to meet at 3.75."""
    picture = Picture(hand_made_scenario(), Method.TEAM)
    stops = (PlannedStop(4, 6.25, 0.25, 0.0, 3.5), PlannedStop(5, 1.25, 0.25, 0.0, 9.5))
    offer = MemberOffer("east", 0.0, 3.75, 0.25, 0.0, 1.0, 1.5, stops)
    strategy = TeamStrategy(1, 0, (Strategy("east", 3.75, 0.25, 4, 8.0, 0.0),), 10.0, 2.0, 2.0)
    east = picture.agents["east"]
    east.offered, east.done_index = (1, offer), 3
    east.held = StrategyRecord(0, "east", strategy)
    act(picture, 2.0, TaskEventKind.MEETING_ENDED)
    return picture


def decoded(data: bytes) -> Any:  # noqa: ANN401 (made by the library)
    """Return a path as a message."""
    return load_typestore(SHARE).deserialize_cdr(data, "nav_msgs/msg/Path")


def act(picture: Picture, time_s: float, kind: TaskEventKind, index: int = 0) -> None:
    """Let east do something."""
    event = TaskEvent(kind, "", "", 0, index, "")
    picture.take_event(TaskRecord(nanoseconds(time_s), "east", event))


def ahead(picture: Picture, way: Way, time_s: float, x_m: float) -> list[tuple[float, float]]:
    """Return x and time of the corners before east, once it is somewhere."""
    odometry = Odometry(nanoseconds(time_s), "east", Pose(x_m, 0.25, 0.0), 1.0, 0.0)
    picture.take_odometry(odometry)
    return [(own.pose.x_m, own.stamp_ns / 1e9) for own in way.ahead(picture)]


def test_a_way_leads_by_the_agreed_stops_to_the_meeting() -> None:
    """Steps after h aren't in it; times are counted from the departure, and as agreed."""
    assert ahead(agreed(), Way("east"), 2.0, 3.75) == [(6.25, 5.5), (3.75, 8.0)]


def test_what_is_done_is_behind() -> None:
    """After the step only the way back is left, although it goes by the same places."""
    picture, way = agreed(), Way("east")
    assert len(ahead(picture, way, 3.0, 4.75)) == 2
    assert len(ahead(picture, way, 4.5, 6.25)) == 2
    act(picture, 5.5, TaskEventKind.ACTION_FINISHED, 4)
    assert ahead(picture, way, 6.0, 5.75) == [(3.75, 8.0)]
    act(picture, 8.0, TaskEventKind.MEETING_REACHED)
    assert ahead(picture, way, 8.0, 3.75) == []


def test_nobody_knows_the_way_before_there_is_agreement() -> None:
    """Or after another plan has taken the place of the one that was offered: then to meet only."""
    picture = Picture(hand_made_scenario(), Method.TEAM)
    assert ahead(picture, Way("east"), 0.0, 3.75) == []
    picture, way = agreed(), Way("east")
    act(picture, 2.5, TaskEventKind.PLAN_CHANGED)
    assert ahead(picture, way, 3.0, 4.75) == [(3.75, 8.0)]


def test_a_closed_place_ends_the_way() -> None:
    """On a map that closes the cells of the meeting it leads to the last stop before."""
    picture = agreed()
    free = picture.site.grid.free.copy()
    free[:, 7] = False
    picture.charts.take(nanoseconds(3.0), free)
    assert ahead(picture, Way("east"), 4.0, 5.25) == [(6.25, 5.5)]


def test_a_plan_begins_where_the_agent_is() -> None:
    """As a path its first pose is the agent's; without corners it is empty."""
    picture, way = agreed(), Way("east")
    ahead(picture, way, 2.0, 3.75)
    here = picture.agents["east"].odometry
    path = decoded(encode_plan(here, way.ahead(picture), nanoseconds(2.0)))
    assert [own.pose.position.x for own in path.poses] == [3.75, 6.25, 3.75]
    assert [own.header.stamp.sec for own in path.poses] == [2, 5, 8]
    assert decoded(encode_plan(here, (), 0)).poses == []


def test_a_trail_keeps_corners_and_forgets_what_is_long_ago() -> None:
    """Of a straight its begin and end; of what is older than T_c only where the rest begins."""
    picture, way = agreed(), Way("east")
    for step in range(6):
        ahead(picture, way, 2.0 + 0.5 * step, 3.75 + 0.5 * step)
    east = picture.agents["east"]
    path = decoded(encode_trail(east.trail, nanoseconds(5.0)))
    assert [own.pose.position.x for own in path.poses] == [3.75, 6.25]
    assert [own.header.stamp.sec for own in path.poses] == [2, 4]
    turned = Pose(6.25, 0.75, math.pi / 2.0)
    picture.take_odometry(Odometry(nanoseconds(16.0), "east", turned, 1.0, 0.0))
    assert [own.stamp_ns for own in east.trail] == [nanoseconds(4.5), nanoseconds(16.0)]
