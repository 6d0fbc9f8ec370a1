"""All that the page shows."""

import json
from dataclasses import replace
from math import inf, nan

from support.hand_made_run import AGENTS, END_S, hand_made_records, hand_made_scenario, task
from tlcomm_core.agent.actions import TaskEventKind
from tlcomm_core.geometry import Pose
from tlcomm_core.method import Method
from tlcomm_core.records import RunRecords
from tlcomm_core.units import nanoseconds
from tlcomm_tools.audit.findings import audit_run
from tlcomm_tools.bag.reader import RecordedRun
from tlcomm_tools.report.document import report_document


def recorded(records: RunRecords) -> RecordedRun:
    """Return the run of some records."""
    return RecordedRun(records, AGENTS, nanoseconds(END_S), {"seed": "7", "pace": "lockstep"}, "")


def test_the_document_says_what_the_audit_says() -> None:
    """The audit and the figures are whole in it; what the bag doesn't say isn't available."""
    scenario, records = hand_made_scenario(), hand_made_records()
    document = report_document(scenario, Method.TEAM, recorded(records))
    audit = audit_run(scenario, Method.TEAM, records, nanoseconds(END_S)).document()
    assert document["audit"] == audit
    assert document["metrics"]["team"]["tasks_satisfied"] == 4
    assert (document["run"]["seed"], document["run"]["solver"]) == ("7", None)


def test_the_document_follows_each_agent() -> None:
    """Way, doings and satisfactions are there, and who was linked with whom."""
    document = report_document(hand_made_scenario(), Method.TEAM, recorded(hand_made_records()))
    east = document["agents"][0]
    assert (east["name"], east["satisfied_s"]) == ("east", [5.5, 15.5])
    assert east["path"]["x_m"][0] == 3.75
    assert max(east["path"]["x_m"]) == 6.25
    assert document["links"][0] == [0, 1, 0.0, 2.0]


def test_what_isnt_usable_is_left_to_the_audit() -> None:
    """The document is JSON whatever a bag holds; what is no number or of nobody isn't in it."""
    records = hand_made_records()
    strategies = records.strategies
    strategies[:] = [
        replace(own, strategy=replace(own.strategy, potential_s=nan)) for own in strategies
    ]
    records.odometry[3] = replace(records.odometry[3], pose=Pose(1e308, -inf, 0.0))
    records.tasks.append(task(24.0, "ghost", TaskEventKind.FAULT))
    document = report_document(hand_made_scenario(), Method.TEAM, recorded(records))
    assert (document["rounds"], document["incidents"]) == ([], [])
    assert {line.split(":")[0] for line in document["audit"]["checks"]["records"]} == {
        "'ghost' is no agent of the scenario, and has 1 task event",
        "east",
        "west",
    }
    assert json.dumps(document, allow_nan=False)
