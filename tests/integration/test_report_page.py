"""A run's page in a real browser, used as people use it."""

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from support.browser import Browser, why_missing
from support.command import run
from support.hand_made_run import hand_made_records, hand_made_scenario, task, write_bag
from support.planned_bag import write_planned_bag
from tlcomm_core.agent.actions import TaskEventKind
from tlcomm_core.method import Method
from tlcomm_core.records import RunRecords
from tlcomm_tools.bag.origin import find_scenario
from tlcomm_tools.bag.reader import read_run
from tlcomm_tools.report.document import report_document
from tlcomm_tools.report.page import render_page
from tlcomm_tools.report.plans import read_plans

pytestmark = pytest.mark.skipif(bool(why_missing()), reason=why_missing() or "there is a browser")

DESKTOP, PHONE = (1280, 900), (390, 844)
HIT = "document.title='hit'"
ATTACK = f'</script><img src=x onerror="{HIT}"><script>{HIT}</script>'
# It ends a line of JavaScript, also inside of a text.
TEXT = f"{ATTACK}\u2028{HIT}"
ACTIONS = (TaskEventKind.ACTION_STARTED, TaskEventKind.ACTION_FINISHED)
# Of a bag that has markup in all its texts: how often at least it is on the page as text.
SHOWN = 5
RIGHT, SPACE = "\ue014", " "


def write_page(folder: Path, records: RunRecords, name: str = "") -> str:
    """Write the page of a run made by hand, with another name for its first agent if given."""
    write_bag(folder / "bag", records)
    recorded = read_run(folder / "bag")
    scenario = find_scenario(folder / "bag", recorded, None)
    document = report_document(scenario, recorded.method, recorded)
    if name:
        document["agents"][0]["name"] = name
        document["metrics"]["agents"][name] = document["metrics"]["agents"]["east"]
        document["rounds"][0]["members"][0]["agent"] = name
        document["audit"]["verdict"] = [f"{name}: {name}"]
    page = folder / "page.html"
    page.write_text(render_page(document), "utf-8")
    return page.as_uri()


def open_page(browser: Browser, address: str) -> None:
    """Load a page until its charts are drawn."""
    browser.open(address)
    browser.wait_for("document.body.dataset.charts === 'drawn'")


@pytest.fixture(scope="module")
def browser() -> Iterator[Browser]:
    """Return a browser as on a desk."""
    with Browser(DESKTOP) as opened:
        yield opened


def test_the_page_says_what_check_says(tmp_path: Path, browser: Browser) -> None:
    """The verdict is on top, of a good run and of a bad one, and nothing is complained of."""
    open_page(browser, write_page(tmp_path / "good", hand_made_records()))
    assert browser.text("#verdict") == "verdict: ok"
    records = hand_made_records()
    records.tasks = [
        own for own in records.tasks if own.event.kind is not TaskEventKind.TASK_SATISFIED
    ]
    open_page(browser, write_page(tmp_path / "bad", records))
    assert browser.text("#verdict") == "verdict: FAILED"
    assert "east: task claimed satisfied 0 times" in browser.text("#violations")
    assert browser.complaints() == []


def test_time_moves_the_agents(tmp_path: Path, browser: Browser) -> None:
    """By slider, by arrow, and by playing, which space stops."""
    open_page(browser, write_page(tmp_path, hand_made_records()))
    assert "(3.75, 0.25)" in browser.text("#agents li")
    browser.press("body", RIGHT * 3)
    assert "to right\n(4.75, 0.25)" in browser.text("#agents li")
    browser.press("#slider", RIGHT * 20)
    assert "pick\n(6.25, 0.25)" in browser.text("#agents li")
    browser.press("body", SPACE)
    assert browser.text("#play") == "Pause"
    browser.wait_for("view.time > 6")
    browser.press("body", SPACE)
    assert browser.text("#play") == "Play"
    assert browser.complaints() == []


def test_a_click_tells_more(tmp_path: Path, browser: Browser) -> None:
    """Of an agent its task and next meeting; of a round its meeting, where time goes as well."""
    open_page(browser, write_page(tmp_path, hand_made_records()))
    browser.click("#agents button")
    assert "G F (right & pick)" in browser.text("#agent")
    assert "Next meeting 1: at (3.75, 0.25) after step 1" in browser.text("#agent")
    browser.click("#rounds button:nth-child(2)")
    assert browser.text("#round h3") == "Meeting 2"
    assert browser.text("#clock") == "20.0 s of 25.0 s"
    assert browser.text("#now") == "Window 2 · meeting 2 is on"
    assert browser.evaluate("document.querySelectorAll('#costs .bars .point').length") == 4
    assert browser.complaints() == []


def test_a_chosen_agent_shows_its_way_ahead(tmp_path: Path, browser: Browser) -> None:
    """From where it is to its next meeting, and less of it the further it has come."""
    path = write_planned_bag(tmp_path / "bag")
    recorded = read_run(path)
    document = report_document(hand_made_scenario(), Method.TEAM, recorded, (), read_plans(path))
    page = tmp_path / "page.html"
    page.write_text(render_page(document), "utf-8")
    open_page(browser, f"{page.as_uri()}#time=4&agent=east")
    assert browser.evaluate("wayAhead(AGENTS[0], view.time)") == [[6.25, 0.25], [3.75, 0.25]]
    assert browser.evaluate("wayAhead(AGENTS[0], 5.5)") == [[3.75, 0.25]]
    assert browser.evaluate("wayAhead(AGENTS[0], 11)") == []
    assert browser.complaints() == []


def test_charts_show_the_map_as_it_was(tmp_path: Path, browser: Browser) -> None:
    """Where they met is drawn on the map at the time, and the schedule tells when that changes."""
    write_bag(tmp_path / "bag", hand_made_records())
    document = report_document(
        hand_made_scenario(), Method.TEAM, read_run(tmp_path / "bag"), (), {}
    )
    document["ground"]["changes"] = [{"at_s": 12.0, "obstacles_m": [[0.0, 0.5, 1.0, 1.0]]}]
    page = tmp_path / "page.html"
    page.write_text(render_page(document), "utf-8")
    boxes = "byId('places').layout.shapes.filter((own) => own.type === 'rect').length"
    open_page(browser, f"{page.as_uri()}#time=11")
    assert browser.evaluate(boxes) == 0
    assert "the map changes" in browser.text("#schedule")
    browser.press("body", RIGHT)
    assert browser.evaluate(boxes) == 1
    assert browser.complaints() == []


def test_a_link_names_a_moment(tmp_path: Path, browser: Browser) -> None:
    """Time and agent are as the address says."""
    address = write_page(tmp_path, hand_made_records())
    open_page(browser, f"{address}#time=4.5&agent=west")
    assert browser.text("#clock") == "4.5 s of 25.0 s"
    assert browser.text("#agent h3") == "west"


def test_a_name_with_markup_is_a_name(tmp_path: Path, browser: Browser) -> None:
    """It is shown as it is, also in charts, and nothing in it is done."""
    open_page(browser, write_page(tmp_path, hand_made_records(), ATTACK))
    browser.click("#agents button")
    assert browser.text("#agent h3") == ATTACK
    assert browser.evaluate("document.title") == "line, method team"
    assert browser.evaluate("document.querySelectorAll('img').length") == 0
    assert browser.complaints() == []


def spoil(topic: str, message: Any) -> None:  # noqa: ANN401 (made by a decoder)
    """Put markup wherever a message of a run has text."""
    suffix = topic.rpartition("/")[2]
    if suffix == "task_event" and message.kind == TaskEventKind.FAULT:
        message.region = message.action = message.detail = TEXT
    elif suffix == "task_event" and message.kind == TaskEventKind.MEETING_REACHED:
        message.agent = TEXT
    elif topic == "/west/task_event" and message.kind in ACTIONS:
        message.region = message.action = TEXT
    elif topic == "/east/team_strategy" and message.round == 1:
        message.strategies[0].agent = TEXT
    elif suffix == "undelivered":
        message.reasons = [TEXT for _ in message.reasons]


def test_a_bag_with_markup_is_a_bag(
    tmp_path: Path, browser: Browser, capsys: pytest.CaptureFixture[str]
) -> None:
    """Regions, actions, faults, strangers, reasons, solver and seed: all of it is shown as text."""
    records = hand_made_records()
    records.tasks.append(task(23.5, "west", TaskEventKind.FAULT))
    write_bag(tmp_path / "bag", records, change=spoil, solver=TEXT, seed=TEXT)
    page = tmp_path / "page.html"
    status, _, _ = run(capsys, "report", str(tmp_path / "bag"), "-o", str(page), "--json")
    assert status == 0
    open_page(browser, page.as_uri())
    browser.click("#agents button")
    browser.click("#rounds button")
    text = browser.evaluate("document.body.textContent")
    assert f"{TEXT!r} is no agent of the scenario" in browser.text("#violations")
    assert text.count(TEXT) >= SHOWN
    assert browser.evaluate("document.title") == "line, method team"
    assert browser.evaluate("document.querySelectorAll('img').length") == 0
    assert browser.complaints() == []


@pytest.mark.parametrize("dark", [False, True])
def test_the_page_fits_a_phone(tmp_path: Path, dark: bool) -> None:
    """Nothing is wider than the screen, in light and dark."""
    with Browser(PHONE, dark=dark) as phone:
        open_page(phone, write_page(tmp_path, hand_made_records()))
        assert phone.evaluate("document.documentElement.scrollWidth") == PHONE[0]
        colour = phone.evaluate("getComputedStyle(document.body).backgroundColor")
        assert colour == ("rgb(20, 23, 27)" if dark else "rgb(245, 246, 248)")
        assert phone.complaints() == []
