"""Tests of ``tlcomm_tools.audit.guarantees.methods``: each method has promises of its own."""

import json

import pytest

from support.hand_made_run import hand_made_records, hand_made_scenario
from tlcomm_core.method import Method
from tlcomm_core.units import nanoseconds
from tlcomm_tools.audit.findings import audit_run

PROMISES = {
    Method.TEAM: ["the team is connected for D_c in every window"],
    Method.STATIC: [
        "the team is connected for D_c in every window",
        "every agent meets where it started",
    ],
    Method.ORACLE: ["the team is connected for D_c in every window"],
    Method.ALL_TIME: [
        "the team is connected at every instant",
        "one agent acts at a time, by turns",
    ],
    Method.PAIRWISE: [
        "a pair is connected for D_c in the window that it agrees on",
        "every pair meets once in each cycle, and pairs link the whole team",
    ],
    Method.NONE: ["nobody meets"],
}


@pytest.mark.parametrize("method", list(Method))
def test_the_document_says_what_is_promised(method: Method) -> None:
    """Each promise with whether it was kept; a team of two is a pair too, and nothing else."""
    found = audit_run(hand_made_scenario(), method, hand_made_records(), nanoseconds(25.0))
    document = json.loads(json.dumps(found.document()))
    assert document["method"] == method.value
    assert [own["promise"] for own in document["guarantees"]] == PROMISES[method]
    is_kept = all(own["kept"] for own in document["guarantees"])
    assert is_kept is (method not in (Method.ALL_TIME, Method.NONE))
