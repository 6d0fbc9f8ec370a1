"""From what is heard to what pages are told."""

import json
from pathlib import Path
from typing import Any

import pytest

from support.hand_made_run import (
    SHARE,
    hand_made_records,
    hand_made_scenario,
    serialize_run,
    write_bag,
)
from support.live_page import grown
from support.planned_bag import write_planned_bag
from tlcomm_core.method import Method
from tlcomm_core.records import RunRecords
from tlcomm_core.units import nanoseconds
from tlcomm_tools.bag.definitions import load_typestore
from tlcomm_tools.live.document import LiveDocument
from tlcomm_tools.live.intake import Heard, read_stamp, shown_topics
from tlcomm_tools.live.session import Session
from tlcomm_tools.report.plans import read_plans

STORE = load_typestore(SHARE)
TOPICS = shown_topics(hand_made_scenario())
NUMBERS = {topic.name: number for number, topic in enumerate(TOPICS)}


class View:
    """A session and the page that it feeds."""

    def __init__(self, bag: Path) -> None:
        """Begin before the run."""
        document = LiveDocument(hand_made_scenario(), Method.TEAM, {})
        self.session = Session(document, TOPICS, STORE, bag)
        self.page = json.loads(json.dumps(document.begun))

    def turn(self, heard: list[Heard], *, is_hearing: bool = True) -> None:
        """Let a quarter of a second pass."""
        self.session.take(heard, is_hearing=is_hearing)
        self.page = grown(self.page, json.loads(self.session.news() or "[]"))

    def end(self) -> dict[str, Any]:
        """End the run; return what the page knows."""
        self.session.end("ok")
        return grown(self.page, json.loads(self.session.news()))


def heard_of(records: RunRecords) -> list[Heard]:
    """Return all messages of some records, in order of time."""
    rows = serialize_run(STORE, records)
    return [(NUMBERS[name], data) for name, _, data in rows if name in NUMBERS]


def whole_page(tmp_path: Path) -> dict[str, Any]:
    """Return what a page knows that heard everything from the beginning."""
    view = View(tmp_path / "none")
    view.turn(heard_of(hand_made_records()), is_hearing=False)
    return view.end()


def earlier(records: RunRecords, until_s: float) -> RunRecords:
    """Return what was recorded before a time."""
    until_ns = nanoseconds(until_s)
    for name in ("tasks", "strategies", "odometry", "connectivity"):
        entries = getattr(records, name)
        entries[:] = [own for own in entries if own.stamp_ns < until_ns]
    return records


def test_what_was_missed_comes_from_the_bag(tmp_path: Path) -> None:
    """Some of it was heard as well, some not yet recorded; the page has each once, in order."""
    heard = heard_of(hand_made_records())
    late = [own for own in heard if read_stamp(own[1]) >= nanoseconds(5.0)]
    write_bag(tmp_path / "bag", earlier(hand_made_records(), 13.0))
    view = View(tmp_path / "bag")
    early = [own for own in late if read_stamp(own[1]) <= nanoseconds(10.0)]
    view.turn(early[:-1], is_hearing=False)
    for _ in range(3):
        view.turn([])
    view.turn(early[-1:])
    assert view.page["run"]["end_s"] == 0.0
    view.turn([])
    assert view.page["run"]["end_s"] == 10.0
    view.turn(late[len(early) :])
    assert view.end() == whole_page(tmp_path)


def test_silence_tells_no_time(tmp_path: Path) -> None:
    """What was said before all was heard is read however long nothing comes but what is latched."""
    heard = heard_of(hand_made_records())
    latched = [own for own in heard if TOPICS[own[0]].latched]
    assert latched
    write_bag(tmp_path / "bag", earlier(hand_made_records(), 13.0))
    view = View(tmp_path / "bag")
    for news in ([], [], [], [], [], latched[:1], []):
        view.turn(news)
    assert view.page["run"]["end_s"] == 0.0
    late = [own for own in heard if read_stamp(own[1]) >= nanoseconds(10.0)]
    view.turn([own for own in late if read_stamp(own[1]) <= nanoseconds(11.0)])
    view.turn([])
    assert view.page["run"]["end_s"] == 11.0
    view.turn([own for own in late if read_stamp(own[1]) > nanoseconds(11.0)])
    assert view.end() == whole_page(tmp_path)


@pytest.mark.parametrize("until_s", [None, 0.5, 20.5])
def test_the_bag_is_waited_for(tmp_path: Path, until_s: float | None) -> None:
    """As long as it doesn't go well beyond what was missed, or isn't there, nothing is shown."""
    if until_s is not None:
        write_bag(tmp_path / "bag", earlier(hand_made_records(), until_s))
    view = View(tmp_path / "bag")
    heard = heard_of(hand_made_records())
    for _ in range(3):
        view.turn([])
    view.turn([next(own for own in heard if read_stamp(own[1]) == nanoseconds(20.0))])
    for _ in range(3):
        view.turn([])
    assert view.page["run"]["end_s"] == 0.0


def test_a_run_that_is_over_at_once_is_read(tmp_path: Path) -> None:
    """Whoever heard nothing of it shows all of it in the end."""
    write_bag(tmp_path / "bag", hand_made_records())
    view = View(tmp_path / "bag")
    view.turn(heard_of(hand_made_records())[5:9])
    page = view.end()
    assert page == whole_page(tmp_path)
    assert page["run"]["verdict"] == "ok"


def test_ways_ahead_are_those_of_a_report(tmp_path: Path) -> None:
    """What viewers are shown of plans, the page shows too."""
    path = write_planned_bag(tmp_path / "bag")
    view = View(tmp_path / "bag")
    east, west = view.end()["agents"]
    own = json.loads(json.dumps(read_plans(path)["east"].document()))
    assert {name: east[name] for name in own} == own
    assert (len(east["ways"]), len(west["ways"])) == (1, 0)


@pytest.mark.parametrize("data", [b"", b"\x00\x01\x00\x00", b"\x00\x01\x00\x00" + b"\xff" * 40])
def test_nonsense_shows_nothing(tmp_path: Path, data: bytes) -> None:
    """A message that can't be decoded is left out."""
    view = View(tmp_path / "none")
    view.turn([(number, data) for number in range(len(TOPICS))])
    view.session.end("ok")
    page = grown(view.page, json.loads(view.session.news()))
    assert page["agents"][0]["steps"] == []
