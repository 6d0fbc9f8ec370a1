"""The document of a page, growing."""

import json
from dataclasses import replace
from math import nan
from typing import Any

from support.hand_made_run import AGENTS, END_S, hand_made_records, hand_made_scenario, task
from support.live_page import grown
from tlcomm_core.agent.actions import TaskEventKind
from tlcomm_core.method import Method
from tlcomm_core.records import EstimateRecord, RunRecords
from tlcomm_core.units import nanoseconds
from tlcomm_core.world.observation import Connectivity, Odometry
from tlcomm_tools.bag.reader import RecordedRun
from tlcomm_tools.live.document import LiveDocument
from tlcomm_tools.report.document import report_document

NOTES = {"seed": "7", "solver": "coalition"}


def live_document() -> LiveDocument:
    """Return the document of the hand-made run, which hasn't begun."""
    return LiveDocument(hand_made_scenario(), Method.TEAM, NOTES)


def report_of(records: RunRecords) -> dict[str, Any]:
    """Return the document of a report, as JSON."""
    run = RecordedRun(records, AGENTS, nanoseconds(END_S), NOTES, "")
    document = report_document(hand_made_scenario(), Method.TEAM, run)
    return dict(json.loads(json.dumps(document)))


def take(document: LiveDocument, record: Any) -> None:  # noqa: ANN401 - any record
    """Let a document take a record."""
    match record:
        case Odometry():
            document.take_odometry(record)
        case Connectivity():
            document.take_connectivity(record)
        case EstimateRecord():
            document.take_estimate(record)
        case _ if hasattr(record, "event"):
            document.take_event(record)
        case _:
            document.take_strategy(record)


def in_order(records: RunRecords) -> list[Any]:
    """Return all records in order of time."""
    every = [
        *records.odometry,
        *records.connectivity,
        *records.tasks,
        *records.strategies,
        *records.estimates,
    ]
    return sorted(every, key=lambda own: own.stamp_ns)


def by_start(document: dict[str, Any]) -> dict[str, Any]:
    """Sort what a page needs in no order."""
    for agent in document["agents"]:
        agent["spans"].sort(key=lambda span: span["start_s"])
    document["links"].sort(key=lambda link: link[2])
    return document


def test_the_document_grows_into_the_reports() -> None:
    """Step by step, or all at once: what the page then knows is what the report says."""
    records = hand_made_records()
    live = live_document()
    page = json.loads(json.dumps(live.begun))
    for record in in_order(records):
        take(live, record)
        page = grown(page, json.loads(json.dumps(live.news())))
    at_once = grown(live.begun, json.loads(json.dumps(live.whole())))
    assert by_start(page) == by_start(json.loads(json.dumps(at_once)))
    report = by_start(report_of(records))
    for part in ("ground", "links", "rounds", "windows", "incidents", "field"):
        assert page[part] == report[part], part
    for mine, theirs in zip(page["agents"], report["agents"], strict=True):
        assert mine == theirs
    assert page["run"] == {**report["run"], "verdict": None}
    team = report["metrics"]["team"]
    for figure in ("tasks_satisfied", "distance_m", "additional_s", "detour_s", "makespan_max_s"):
        assert page["metrics"]["team"][figure] == team[figure], figure


def test_what_only_the_end_tells_is_not_available_before() -> None:
    """There is no audit, and no verdict until the run says one."""
    live = live_document()
    assert (live.begun["audit"], live.begun["run"]["verdict"]) == (None, None)
    live.news()
    live.end(["east: a window was missed"])
    (edit,) = live.news()
    assert (edit["path"], edit["value"]) == (["run", "verdict"], ["east: a window was missed"])


def test_nothing_new_is_no_news() -> None:
    """What was told once isn't told again, nor is a pose that lies on the way."""
    live = live_document()
    for record in in_order(hand_made_records()):
        take(live, record)
    assert live.news()
    assert live.news() == []


def test_news_stay_small() -> None:
    """After 1000 s what a second brings is told in less than a thousandth of all."""
    live = live_document()
    records = hand_made_records()
    for number in range(40):
        for record in in_order(records):
            shifted_ns = record.stamp_ns + nanoseconds(number * END_S)
            if not hasattr(record, "strategy"):
                take(live, replace(record, stamp_ns=shifted_ns))
    live.news()
    take(live, replace(records.odometry[-1], stamp_ns=nanoseconds(1001.0)))
    news, whole = (len(json.dumps(edits)) for edits in (live.news(), live.whole()))
    metrics = len(json.dumps(live.begun["metrics"]))
    assert news < metrics + 1000 < whole / 4


def test_strangers_and_numbers_that_are_none_do_no_harm() -> None:
    """An agent that isn't one of the team isn't shown, nor a pose that is nowhere."""
    live = live_document()
    live.take_event(task(1.0, "stranger", TaskEventKind.ACTION_STARTED, action="pick"))
    pose = replace(hand_made_records().odometry[0].pose, x_m=nan)
    live.take_odometry(replace(hand_made_records().odometry[0], pose=pose))
    page = grown(live.begun, live.news())
    assert page["agents"][0]["path"]["x_m"] == []
    assert json.dumps(live.whole(), allow_nan=False)
