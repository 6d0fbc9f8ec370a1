"""Tests of ``tlcomm_tools.mirror.markers``."""

from collections import defaultdict
from dataclasses import replace
from typing import Any

from rosbags.typesys.stores.ros2_jazzy import visualization_msgs__msg__Marker as Marker

from support.hand_made_run import hand_made_records
from support.mirroring import mirror_run


def kinds(array: Any) -> dict[str, list[Any]]:  # noqa: ANN401 - a decoder's class
    """Return an array's markers by namespace, the order to delete left out."""
    assert array.markers[0].action == Marker.DELETEALL
    found = defaultdict(list)
    for marker in array.markers[1:]:
        assert marker.header.frame_id == "map"
        found[marker.ns].append(marker)
    return found


def test_regions_are_discs_with_their_names() -> None:
    """As large as they are, where they are."""
    found = kinds(mirror_run(0.0)["/region_markers", 0.0])
    left, right = found["regions"]
    assert (left.type, left.scale.x, left.pose.position.x) == (Marker.CYLINDER, 0.6, 1.25)
    assert right.pose.position.x == 6.25
    assert [own.text for own in found["region_names"]] == ["left", "right"]


def test_regions_are_not_hidden_by_the_map() -> None:
    """They begin above the map, which is at height 0."""
    for disc in kinds(mirror_run(0.0)["/region_markers", 0.0])["regions"]:
        assert disc.pose.position.z - disc.scale.z / 2 > 0.0


def test_names_of_an_agent_and_its_region_can_both_be_read() -> None:
    """One is above its place and the other below, at least half a line each."""
    mirrors = mirror_run(0.0)
    regions, team = (kinds(mirrors[topic, 0.0]) for topic in ("/region_markers", "/team_markers"))
    for found, kind, side in ((regions, "region", -1), (team, "agent", 1)):
        for place, name in zip(found[f"{kind}s"], found[f"{kind}_names"], strict=True):
            rise_m = name.pose.position.y - place.pose.position.y
            assert side * rise_m >= name.scale.z / 2


def test_agents_are_where_their_odometry_says() -> None:
    """One second on its way at 1 m/s, each with its name and a colour of its own."""
    found = kinds(mirror_run(3.0)["/team_markers", 3.0])
    assert [own.pose.position.x for own in found["agents"]] == [4.75, 2.25]
    assert [own.text for own in found["agent_names"]] == ["east", "west"]
    assert found["agents"][0].color != found["agents"][1].color


def test_links_join_those_who_hear_each_other() -> None:
    """A line between them while they do, none otherwise."""
    mirrors = mirror_run(3.0)
    (line,) = kinds(mirrors["/team_markers", 0.0])["links"]
    assert [point.x for point in line.points] == [3.75, 3.25]
    assert "links" not in kinds(mirrors["/team_markers", 3.0])


def test_links_that_do_not_join_the_team_look_different() -> None:
    """The same edge, of a team that is connected as a whole or isn't."""
    records = hand_made_records()
    records.connectivity[0] = replace(records.connectivity[0], connected=False)
    (apart,) = kinds(mirror_run(0.0, records)["/team_markers", 0.0])["links"]
    (joined,) = kinds(mirror_run(0.0)["/team_markers", 0.0])["links"]
    assert apart.points == joined.points
    assert apart.color != joined.color


def test_meeting_places_are_shown_when_they_are_agreed() -> None:
    """From 1 s on, when the hand-made run's agents agree on round 1."""
    mirrors = mirror_run(1.0)
    discs = kinds(mirrors["/team_markers", 1.0])
    places = [own.pose.position for own in discs["meeting"]]
    assert [(place.x, place.y) for place in places] == [(3.75, 0.25), (3.25, 0.25)]
    assert [own.color for own in discs["meeting"]] == [own.color for own in discs["agents"]]
    assert "meeting" not in kinds(mirrors["/team_markers", 0.0])
