"""The configurations for other people's viewers name topics that there are, as they are offered."""

import json
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import yaml

from tlcomm_core.scenario.loader import load_scenario
from tlcomm_tools.bag.topics import Topic, mirror_topics, recorded_topics

ROOT = Path(__file__).parents[3]
CONFIG = ROOT / "ros2_ws" / "src" / "tlcomm_tools" / "config"


def topics() -> dict[str, Topic]:
    """Return all that a run of the plant publishes for viewers or records, by name."""
    agents = tuple(load_scenario(ROOT / "scenarios" / "plant.yaml").agents)
    return {own.name: own for own in (*recorded_topics(agents), *mirror_topics(agents))}


def rviz_displays(node: dict[str, Any]) -> Iterator[dict[str, Any]]:
    """Yield every display that shows a topic."""
    if "Topic" in node:
        yield node
    for inner in node.get("Displays", ()):
        yield from rviz_displays(inner)


def test_rviz_subscribes_to_each_topic_as_it_is_offered() -> None:
    """Each display's topic exists, and what is latched is asked for as latched."""
    document = yaml.safe_load((CONFIG / "tlcomm.rviz").read_text("utf-8"))
    shown = {own["Topic"]["Value"]: own for own in rviz_displays(document["Visualization Manager"])}
    known = topics()
    assert shown.keys() <= known.keys()
    assert {"/map", *(own.name for own in mirror_topics(()))} - {"/diagnostics"} <= shown.keys()
    for name, own in shown.items():
        kind = known[name].type.rpartition("/")[2]
        assert own["Class"].rpartition("/")[2] == kind.replace("OccupancyGrid", "Map")
        assert (own["Topic"]["Durability Policy"] == "Transient Local") is known[name].latched


def test_foxglove_shows_topics_that_there_are() -> None:
    """Its layout's panels exist, and so do their topics."""
    document = json.loads((CONFIG / "tlcomm.foxglove.json").read_text("utf-8"))
    panels = document["configById"]
    placed = re.findall(r'"(\w+!\w+)"', json.dumps(document["layout"]))
    assert sorted(placed) == sorted(panels)
    plotted = [
        path["value"].partition(".")[0] for own in panels.values() for path in own.get("paths", ())
    ]
    shown = {
        *panels["3D!team"]["topics"],
        *plotted,
        panels["DiagnosticSummary!team"]["topicToRender"],
    }
    assert shown <= topics().keys()
