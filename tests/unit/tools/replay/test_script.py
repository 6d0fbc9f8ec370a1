"""Tests of ``tlcomm_tools.replay.script``."""

from collections.abc import Mapping
from pathlib import Path

import pytest
from mcap.writer import Writer

from support.hand_made_run import hand_made_records, write_bag
from tlcomm_core.errors import InputError
from tlcomm_tools.bag.metadata import qos_text
from tlcomm_tools.replay.quality import Quality
from tlcomm_tools.replay.script import OfferedTopic, read_script

LATCHED = {"offered_qos_profiles": qos_text(latched=True), "topic_type_hash": "RIHS01_0"}
TENTH_NS = 10**8


def write(
    path: Path,
    messages: list[tuple[str, int, bytes]],
    notes: Mapping[str, str] = {},
    encoding: str = "cdr",
) -> Path:
    """Write messages of any topics; the notes are those of /map."""
    with path.open("wb") as stream:
        writer = Writer(stream)
        writer.start("ros2", "other")
        schema = writer.register_schema("std_msgs/msg/String", "ros2msg", b"string data")
        channels = {
            topic: writer.register_channel(
                topic, encoding, schema, dict(notes) if topic == "/map" else {}
            )
            for topic in dict.fromkeys(topic for topic, _, _ in messages)
        }
        for topic, log_ns, data in messages:
            writer.add_message(channels[topic], log_ns, data, log_ns)
        writer.finish()
    return path


def test_messages_are_in_order(tmp_path: Path) -> None:
    """By log time, the clock first within an instant, others there as they were recorded."""
    path = write(
        tmp_path / "a.mcap",
        [("/b", 2, b"b2"), ("/a", 2, b"a2"), ("/clock", 2, b"c2"), ("/b", 1, b"b1")],
    )
    script = read_script(path)
    assert [data for _, _, data in script.messages] == [b"b1", b"c2", b"b2", b"a2"]
    assert script.span_ns == (1, 2)
    names = [script.topics[number].name for _, number, _ in script.messages]
    assert names == ["/b", "/clock", "/b", "/a"]


def test_topics_are_as_they_were_offered(tmp_path: Path) -> None:
    """Type, quality of service and hash come from the bag."""
    script = read_script(write(tmp_path / "a.mcap", [("/map", 0, b"")], LATCHED))
    quality = Quality(10, latched=True)
    assert script.topics == [OfferedTopic("/map", "std_msgs/msg/String", quality, "RIHS01_0")]


def test_our_own_bag(tmp_path: Path) -> None:
    """All topics of a run and all messages are there, in order."""
    script = read_script(write_bag(tmp_path / "bag", hand_made_records()).folder)
    times_ns = [log_ns for log_ns, _, _ in script.messages]
    assert times_ns == sorted(times_ns)
    latched = {topic.name for topic in script.topics if topic.quality.latched}
    assert latched == {"/map", "/east/team_strategy", "/west/team_strategy"}


def test_the_clock_goes_with_chosen_topics(tmp_path: Path) -> None:
    """Only what is chosen is there, and the clock."""
    path = write(tmp_path / "a.mcap", [("/a", 1, b""), ("/b", 1, b""), ("/clock", 1, b"")])
    assert {topic.name for topic in read_script(path, {"/b"}).topics} == {"/b", "/clock"}


def test_a_late_start_keeps_what_is_latched(tmp_path: Path) -> None:
    """Before the start, the last ten messages of a latched topic are still offered."""
    early = [("/map", number, b"%d" % number) for number in range(12)]
    path = write(tmp_path / "a.mcap", [*early, ("/a", 5, b"a"), ("/a", TENTH_NS, b"b")], LATCHED)
    script = read_script(path, None, 0.1)
    assert [data for _, _, data in script.messages] == [b"b"]
    assert [data for _, _, data in script.held] == [b"%d" % number for number in range(2, 12)]


def test_a_start_after_the_end_is_refused(tmp_path: Path) -> None:
    """The complaint says how long the recording is."""
    path = write(tmp_path / "a.mcap", [("/a", 0, b""), ("/a", TENTH_NS, b"")])
    with pytest.raises(InputError, match=r"--start: 0.2 s is after the end: .* lasts 0\.100 s"):
        read_script(path, None, 0.2)


def test_an_unknown_topic_is_refused(tmp_path: Path) -> None:
    """The complaint names the topics that there are."""
    path = write(tmp_path / "a.mcap", [("/a", 0, b""), ("/b", 0, b"")])
    with pytest.raises(InputError, match=r"no topic '/c' \(its topics are /a, /b\)"):
        read_script(path, {"/c"})


def test_what_cant_be_published_is_skipped(tmp_path: Path) -> None:
    """Other encodings and unreadable qualities are named; nothing at all is refused."""
    with pytest.raises(InputError, match="holds no messages to replay"):
        read_script(write(tmp_path / "a.mcap", [("/a", 0, b"{}")], encoding="json"))
    odd = write(
        tmp_path / "b.mcap", [("/a", 0, b""), ("/map", 0, b"")], {"offered_qos_profiles": "7"}
    )
    script = read_script(odd)
    assert [topic.name for topic in script.topics] == ["/a"]
    assert list(script.skipped) == ["/map"]


def test_a_cut_bag_is_replayed_as_far_as_it_goes(tmp_path: Path) -> None:
    """What is before the cut is there, and the damage is told."""
    path = write_bag(tmp_path / "bag", hand_made_records()).path
    count = len(read_script(path).messages)
    content = path.read_bytes()
    path.write_bytes(content[: content.index(b"\x0f\x04\0\0\0\0\0\0\0")])
    script = read_script(path)
    assert (len(script.messages), script.damage) == (count, "the file has no end")
