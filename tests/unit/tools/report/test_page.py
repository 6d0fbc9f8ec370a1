"""The page round a document."""

import json
import re
from typing import Any

from support.hand_made_run import AGENTS, END_S, hand_made_records, hand_made_scenario
from tlcomm_core.method import Method
from tlcomm_core.units import nanoseconds
from tlcomm_tools.bag.reader import RecordedRun
from tlcomm_tools.report.document import report_document
from tlcomm_tools.report.page import render_page

ATTACK = "</script><script>alert(1)</script><!--\u2028&"


def hand_made_document() -> dict[str, Any]:
    """Return the document of the run made by hand."""
    run = RecordedRun(hand_made_records(), AGENTS, nanoseconds(END_S), {}, "")
    return report_document(hand_made_scenario(), Method.TEAM, run)


def data_of(page: str) -> str:
    """Return the data in a page, as it stands there."""
    found = re.search(r'<script id="data" type="application/json">(.*?)</script>', page, re.DOTALL)
    assert found
    return found[1]


def test_the_page_holds_its_document() -> None:
    """What is in it is what was given."""
    document = hand_made_document()
    assert json.loads(data_of(render_page(document))) == json.loads(json.dumps(document))


def test_nothing_in_the_document_becomes_markup() -> None:
    """Names with tags in them are data, wherever they stand."""
    document = hand_made_document()
    document["run"]["scenario"] = ATTACK
    document["agents"][0]["name"] = ATTACK
    page = render_page(document)
    assert "<script>alert" not in page
    assert not re.search("[<>&\u2028]", data_of(page))
    assert json.loads(data_of(page))["agents"][0]["name"] == ATTACK


def test_the_page_needs_nobody() -> None:
    """It loads nothing, may load nothing, and runs only the scripts that it has."""
    page = render_page(hand_made_document())
    policy = re.search(r'Content-Security-Policy" content="([^"]*)"', page)
    assert policy
    assert "default-src 'none'; script-src 'sha256-" in policy[1]
    assert "unsafe-eval" not in policy[1]
    assert "script-src 'unsafe-inline'" not in policy[1]
    assert not re.search(r"<(?:script|img|iframe)[^>]*\ssrc=|<link[^>]*href=\"(?!data:)", page)
    # A comment in a script, as HTML reads it, would swallow the script's end.
    assert page.count("<!--") == 0


def test_the_page_is_small() -> None:
    """A short run's page is little more than the library of charts."""
    assert len(render_page(hand_made_document()).encode()) < 5_200_000
