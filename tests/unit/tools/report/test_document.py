"""All that the page shows."""

import json
from dataclasses import replace
from math import nan

from support.hand_made_run import AGENTS, END_S, hand_made_records, hand_made_scenario
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


def test_numbers_that_are_none_are_not_available() -> None:
    """The document is JSON whatever a bag holds."""
    records = hand_made_records()
    strategies = records.strategies
    strategies[:] = [
        replace(own, strategy=replace(own.strategy, potential_s=nan)) for own in strategies
    ]
    document = report_document(hand_made_scenario(), Method.TEAM, recorded(records))
    assert document["rounds"][0]["potential_s"] is None
    assert json.dumps(document, allow_nan=False)
