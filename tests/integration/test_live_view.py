"""A run with its live view: in a real browser, and with the view killed."""

import json
import os
import queue
import signal
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import pytest

from support.browser import Browser, why_missing
from tlcomm_core.game.solver import DEFAULT
from tlcomm_core.method import Method
from tlcomm_core.mission import Mission
from tlcomm_core.pace import parse_pace
from tlcomm_core.records import event_log
from tlcomm_core.scenario.loader import load_scenario
from tlcomm_core.scenario.site import Site
from tlcomm_core.simulation import simulate
from tlcomm_tools.bag.reader import read_run
from tlcomm_tools.report.document import report_document
from tlcomm_tools.run import RunOptions, run_mission
from tlcomm_tools.status import Status

SCENARIO = load_scenario(Path(__file__).parents[2] / "scenarios" / "corridor.yaml")
ROUNDS, FEW = 12, 4
LIMIT_S = 120.0
ADDRESS = "live view at "


def options_of(out: Path, rounds: int = ROUNDS) -> RunOptions:
    """Return a run in lock step, looked on."""
    return RunOptions(
        scenario=SCENARIO,
        method=Method.TEAM,
        solver=DEFAULT,
        seed=0,
        pace=parse_pace("lockstep"),
        rounds=rounds,
        until_s=None,
        out=out,
        has_view=True,
    )


def expected_events(rounds: int = ROUNDS) -> str:
    """Return the event log of the same run without processes, and so without a view."""
    left = simulate(Mission(Site.from_scenario(SCENARIO), 0, rounds, None))
    return "".join(f"{line}\n" for line in event_log(left.records))


def views(out: Path) -> Iterator[int]:
    """Yield the process ids of living views of the run in a folder."""
    for path in Path("/proc").glob("[0-9]*"):
        try:
            words = (path / "cmdline").read_text(encoding="utf-8", errors="replace").split("\0")
            state = (path / "stat").read_text(encoding="ascii").rpartition(")")[2].split()[0]
        except OSError:
            continue
        if "tlcomm_tools.runtime.view" in words and str(out) in " ".join(words) and state != "Z":
            yield int(path.name)


@pytest.mark.skipif(bool(why_missing()), reason=why_missing() or "there is a browser")
def test_a_run_is_looked_on(tmp_path: Path) -> None:
    """Agents move, a round tells of its meeting, the verdict is the run's; nothing is complained
    of, nobody is left, and the run decides as it does without anybody looking on.
    """
    out, told = tmp_path / "run", queue.SimpleQueue[str]()
    with Browser((1280, 900)) as browser, ThreadPoolExecutor() as pool:
        running = pool.submit(run_mission, options_of(out), lambda *_: None, told.put)
        assert told.get(timeout=LIMIT_S).startswith("ROS domain ")
        address = told.get(timeout=LIMIT_S).removeprefix(ADDRESS)
        browser.open(address)
        browser.wait_for("state === 'running' && ROUNDS.length > 1")
        assert browser.text("#verdict") == "running"
        assert browser.evaluate("view.isFollowing")
        time_s, place = browser.evaluate("[RUN.end_s, String(placeAt(AGENTS[0], RUN.end_s))]")
        browser.wait_for(
            f"RUN.end_s > {time_s} && String(placeAt(AGENTS[0], view.time)) != '{place}'"
        )
        browser.click("#rounds button:first-child")
        assert browser.text("#round h3") == "Meeting 1"
        assert "it began at" in browser.text("#round")
        start_s = browser.evaluate("startOf(ROUNDS[0])")
        browser.wait_for("state === ''")
        assert browser.evaluate("view.time") == start_s
        report = running.result(LIMIT_S)
        assert browser.text("#verdict") == "verdict: ok"
        known = browser.evaluate("DATA")
        assert browser.complaints() == []
    assert report.status is Status.FINE, report
    assert report.folder.events.read_text("utf-8") == expected_events()
    require_same(known, report_document(SCENARIO, Method.TEAM, read_run(out)))
    assert list(views(out)) == []
    assert told.empty()


def ended_spans(agent: dict[str, Any]) -> list[tuple[Any, ...]]:
    """Return what an agent did, but for what it did at the end."""
    names = ("start_s", "end_s", "activity", "action")
    return sorted(tuple(span[name] for name in names) for span in agent["spans"])[:-2]


def require_same(known: dict[str, Any], expected: dict[str, Any]) -> None:
    """Require that a page knows what a report knows of all that is said once."""
    expected = json.loads(json.dumps(expected))
    assert len(known["rounds"]) > ROUNDS
    for mine, theirs in zip(known["rounds"], expected["rounds"], strict=True):
        assert {**mine, "moves": None} == {**theirs, "moves": None}
    for mine, theirs in zip(known["agents"], expected["agents"], strict=True):
        assert mine["steps"] == theirs["steps"]
        assert mine["satisfied_s"] == theirs["satisfied_s"]
        assert ended_spans(mine) == ended_spans(theirs)
    assert known["windows"] == expected["windows"]


@pytest.mark.parametrize(
    ("number", "last"),
    [
        (signal.SIGKILL, "the live view has ended, the run goes on"),
        (signal.SIGSTOP, "live view at "),
    ],
)
def test_a_view_may_die_or_hang(tmp_path: Path, number: signal.Signals, last: str) -> None:
    """The run goes on, and ends as it does without a view; of its death the user is told."""
    out, told = tmp_path / "run", []
    struck = False

    def strike(_: float, meetings_ended: int) -> None:
        nonlocal struck
        if meetings_ended > 1 and not struck:
            struck = True
            (view,) = views(out)
            os.kill(view, number)

    report = run_mission(options_of(out, FEW), strike, told.append)
    assert report.status is Status.FINE, report
    assert report.folder.events.read_text("utf-8") == expected_events(FEW)
    assert list(views(out)) == []
    assert told[-1].startswith(last)
