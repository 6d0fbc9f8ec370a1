"""A real run's bag in other people's hands."""

from collections import Counter
from pathlib import Path
from typing import Any

import pytest
import yaml

from support.foreign_readers import LIBRARIES, Row, read_alone
from tlcomm_core.geometry import yaw_from_quaternion
from tlcomm_tools.bag.reader import RecordedRun, read_run

pytest.importorskip("rclpy", reason="needs ROS 2: run by scripts/test")


def rows_of(rows: list[Row], suffix: str) -> list[Any]:
    """Return the messages of all topics that end so, in the order of time."""
    return [message for topic, _, message in rows if topic.endswith(suffix)]


@pytest.fixture(scope="module")
def path(finished: tuple[Path, str]) -> Path:
    """Return the run's MCAP file."""
    (found,) = (finished[0] / "bag").glob("*.mcap")
    return found


@pytest.fixture(scope="module")
def told(path: Path) -> Any:  # noqa: ANN401 - YAML
    """Return what metadata.yaml says."""
    document = yaml.safe_load(path.with_name("metadata.yaml").read_text("utf-8"))
    return document["rosbag2_bagfile_information"]


@pytest.fixture(scope="module")
def run(path: Path) -> RecordedRun:
    """Return the run as this project reads it."""
    return read_run(path)


@pytest.fixture(scope="module")
def decoded(path: Path, tmp_path_factory: pytest.TempPathFactory) -> dict[str, list[Row]]:
    """Return what each library decodes, without ROS and without this project."""
    return {
        library: read_alone(library, path, tmp_path_factory.mktemp("packages"))
        for library in LIBRARIES
    }


def test_every_message_is_decoded_alike(decoded: dict[str, list[Row]], told: Any) -> None:  # noqa: ANN401
    """By the definitions inside: all topics, all messages, every field of them."""
    rosbags, *others = (sorted(map(repr, rows)) for rows in decoded.values())
    assert all(rows == rosbags for rows in others)
    counts = Counter(topic for topic, _, _ in decoded["rosbags"])
    for own in told["topics_with_message_count"]:
        assert counts.pop(own["topic_metadata"]["name"], 0) == own["message_count"]
    assert not counts


def test_the_values_are_the_runs(decoded: dict[str, list[Row]], run: RecordedRun) -> None:
    """Poses, links, events and strategies, to the bit."""
    rows, records = decoded["mcap"], run.records
    for name in run.agents:
        poses = [own.pose for own in records.odometry if own.agent == name]
        read = [message["pose"]["pose"] for message in rows_of(rows, f"/{name}/odom")]
        assert [own["position"]["x"] for own in read] == [pose.x_m for pose in poses]
        assert [own["position"]["y"] for own in read] == [pose.y_m for pose in poses]
        turns = [
            yaw_from_quaternion(own["orientation"]["z"], own["orientation"]["w"]) for own in read
        ]
        assert turns == [pose.yaw_rad for pose in poses]
    graphs = [(own["edges"], own["connected"]) for own in rows_of(rows, "/connectivity")]
    assert graphs == [
        ([end for edge in own.edges for end in edge], own.connected) for own in records.connectivity
    ]
    assert rows_of(rows, "/connectivity")[0]["agents"] == list(run.agents)
    events = Counter((own["agent"], own["kind"], own["detail"]) for own in rows_of(rows, "_event"))
    assert events == Counter(
        (own.agent, int(own.event.kind), own.event.detail) for own in records.tasks
    )
    held = {
        (own["round"], own["potential"], part["agent"], part["arrival_time"])
        for own in rows_of(rows, "/team_strategy")
        for part in own["strategies"]
    }
    assert held == {
        (own.strategy.round, own.strategy.potential_s, part.agent, part.arrival_s)
        for own in records.strategies
        for part in own.strategy.strategies
    }


_TIME = {"sec", "nsec"}
_PROFILE = {
    "history": {"keep_last"},
    "depth": {10, 1000},
    "reliability": {"reliable"},
    "durability": {"volatile", "transient_local"},
    "liveliness": {"automatic"},
    "avoid_ros_namespace_conventions": {False},
}
_TIMES = {"deadline", "lifespan", "liveliness_lease_duration"}


def test_metadata_is_as_rosbag2_writes_it(path: Path, told: Any, run: RecordedRun) -> None:  # noqa: ANN401
    """Each field that version 9 has (ROS 2 Jazzy), of the type that its reader wants, and true."""
    topics = told.pop("topics_with_message_count")
    (file,) = told.pop("files")
    duration_ns, start_ns = run.end_ns, 0
    assert {"nanoseconds": duration_ns} == told.pop("duration") == file.pop("duration")
    assert {"nanoseconds_since_epoch": start_ns} == told.pop("starting_time")
    assert {"nanoseconds_since_epoch": start_ns} == file.pop("starting_time")
    count = sum(own["message_count"] for own in topics)
    assert file == {"path": path.name, "message_count": count}
    assert told == {
        "version": 9,
        "storage_identifier": "mcap",
        "message_count": count,
        "compression_format": "",
        "compression_mode": "",
        "relative_file_paths": [path.name],
        "custom_data": None,
        "ros_distro": "jazzy",
    }
    for own in topics:
        assert own.keys() == {"topic_metadata", "message_count"}
        topic = own["topic_metadata"]
        assert topic["serialization_format"] == "cdr"
        assert topic["type_description_hash"].startswith("RIHS01_")
        (profile,) = topic["offered_qos_profiles"]
        assert profile.keys() == _PROFILE.keys() | _TIMES
        assert all(profile[name].keys() == _TIME for name in _TIMES)
        assert all(profile[name] in values for name, values in _PROFILE.items())
