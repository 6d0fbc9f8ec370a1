"""The configurations for other people's viewers suit what a run offers, and its definitions."""

import json
import re
from collections.abc import Iterator
from functools import cache
from pathlib import Path
from typing import Any

import pytest
import yaml
from rosbags.interfaces import Nodetype
from rosbags.typesys.store import Typestore

from tlcomm_core.scenario.loader import load_scenario
from tlcomm_tools.bag.definitions import load_typestore
from tlcomm_tools.bag.topics import Topic, mirror_topics, recorded_topics
from tlcomm_tools.mirror.elements import FRAME, agent_colour

ROOT = Path(__file__).parents[3]
SOURCES = ROOT / "ros2_ws" / "src"
CONFIG = SOURCES / "tlcomm_tools" / "config"
AGENTS = tuple(load_scenario(ROOT / "scenarios" / "plant.yaml").agents)
# By RViz 2's source: what it doesn't know it passes over without a word.
_DISPLAY = {"Class", "Name", "Enabled"}
_PROPERTIES = {
    "rviz_common/Group": {"Displays"},
    "rviz_default_plugins/Map": {"Alpha", "Color Scheme", "Draw Behind", "Topic"},
    "rviz_default_plugins/MarkerArray": {"Topic"},
    "rviz_default_plugins/Path": {
        *("Alpha", "Buffer Length", "Color", "Line Style", "Line Width", "Pose Style", "Topic")
    },
}
_TOPIC = {"Value", "Depth", "History Policy", "Reliability Policy", "Durability Policy"}
_CHOICES = {
    "Color Scheme": {"map", "costmap", "raw"},
    "Line Style": {"Lines", "Billboards"},
    "Pose Style": {"None", "Axes", "Arrows"},
    "History Policy": {"System Default", "Keep Last", "Keep All"},
    "Reliability Policy": {"System Default", "Reliable", "Best Effort"},
    "Durability Policy": {"System Default", "Transient Local", "Volatile"},
}
_PATH = re.compile(r"/(agent_\d)/(plan|trail|estimate)\b")


def topics() -> dict[str, Topic]:
    """Return all that a run of the plant publishes for viewers or records, by name."""
    return {own.name: own for own in (*recorded_topics(AGENTS), *mirror_topics(AGENTS))}


@cache
def definitions() -> Typestore:
    """Return the types that a bag's messages have."""
    return load_typestore(SOURCES / "tlcomm_msgs")


def rviz() -> dict[str, Any]:
    """Return what RViz's configuration makes it manage."""
    document = yaml.safe_load((CONFIG / "tlcomm.rviz").read_text("utf-8"))
    manager: dict[str, Any] = document["Visualization Manager"]
    return manager


def rviz_displays() -> Iterator[dict[str, Any]]:
    """Yield every display that shows a topic."""
    return (own for own in rviz_nodes(rviz()["Displays"]) if "Topic" in own)


def rviz_nodes(nodes: list[dict[str, Any]]) -> Iterator[dict[str, Any]]:
    """Yield every display, and those in groups."""
    for node in nodes:
        yield node
        yield from rviz_nodes(node.get("Displays", []))


def layout() -> dict[str, Any]:
    """Return Foxglove's layout."""
    document: dict[str, Any] = json.loads((CONFIG / "tlcomm.foxglove.json").read_text("utf-8"))
    return document


def curves() -> list[dict[str, Any]]:
    """Return the curves of all plots of Foxglove's layout."""
    return [own for panel in layout()["configById"].values() for own in panel.get("paths", ())]


def test_rviz_subscribes_to_each_topic_as_it_is_offered() -> None:
    """Each display's topic exists, and what is latched is asked for as latched."""
    shown = {own["Topic"]["Value"]: own for own in rviz_displays()}
    known = topics()
    assert shown.keys() <= known.keys()
    assert {"/map", *(own.name for own in mirror_topics(AGENTS))} - {"/diagnostics"} == shown.keys()
    for name, own in shown.items():
        kind = known[name].type.rpartition("/")[2]
        assert own["Class"].rpartition("/")[2] == kind.replace("OccupancyGrid", "Map")
        assert own["Topic"]["Reliability Policy"] == "Reliable"
        assert (own["Topic"]["Durability Policy"] == "Transient Local") is known[name].latched


def test_rviz_knows_all_that_it_is_told() -> None:
    """Each property is one of its display's, and each choice one that there is."""
    for node in rviz_nodes(rviz()["Displays"]):
        assert node.keys() <= _DISPLAY | _PROPERTIES[node["Class"]]
        topic = node.get("Topic", {})
        assert topic.keys() <= _TOPIC
        for name, value in (*node.items(), *topic.items()):
            if name in _CHOICES:
                assert value in _CHOICES[name]


def test_viewers_look_on_in_the_mirrors_frame() -> None:
    """There are no transforms, so any other frame would show nothing."""
    manager = rviz()
    assert manager["Global Options"]["Fixed Frame"] == FRAME
    assert manager["Views"]["Current"]["Target Frame"] == FRAME
    assert layout()["configById"]["3D!team"]["followTf"] == FRAME


def test_foxglove_shows_topics_that_there_are() -> None:
    """Its layout's panels exist, and so do their topics."""
    panels = layout()["configById"]
    placed = re.findall(r'"(\w+!\w+)"', json.dumps(layout()["layout"]))
    assert sorted(placed) == sorted(panels)
    shown = {
        *panels["3D!team"]["topics"],
        *(own["value"].partition(".")[0] for own in curves()),
        panels["DiagnosticSummary!team"]["topicToRender"],
    }
    assert shown <= topics().keys()


@pytest.mark.parametrize("own", curves(), ids=lambda own: own["value"])
def test_what_is_plotted_is_a_number(own: dict[str, Any]) -> None:
    """The path of each curve ends at a single number of the topic's type."""
    topic, *names = own["value"].split(".")
    type_name = topics()[topic].type
    for name in names[:-1]:
        kind, type_name = dict(definitions().fielddefs[type_name][1])[name]
        assert kind is Nodetype.NAME
    kind, (base, _) = dict(definitions().fielddefs[type_name][1])[names[-1]]
    assert (kind, base) == (Nodetype.BASE, "float64")


def test_an_agent_has_one_colour_in_all_viewers() -> None:
    """Its ways and curves are in the colour of its markers."""
    shown = layout()["configById"]["3D!team"]["topics"]
    colours = [
        *((name, own["gradient"][0][:7]) for name, own in shown.items() if "gradient" in own),
        *((own["value"], own["color"]) for own in curves()),
        *((own["Topic"]["Value"], own["Color"]) for own in rviz_displays() if "Color" in own),
    ]
    compared = 0
    for name, colour in colours:
        if found := _PATH.match(name):
            parts = agent_colour(AGENTS.index(found[1]))[:3]
            levels = [round(255 * part) for part in parts]
            assert colour in ("#" + bytes(levels).hex(), "; ".join(map(str, levels)))
            compared += 1
    assert compared == 5 * len(AGENTS)
