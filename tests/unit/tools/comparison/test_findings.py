"""What a comparison found, and how it is told."""

import csv
import io
import json
import re
from dataclasses import fields, replace
from pathlib import Path
from typing import Any

import pytest

from tlcomm_core.game.solver import DEFAULT
from tlcomm_core.method import Method
from tlcomm_core.metrics.summary import Computing, TeamMetrics
from tlcomm_core.scenario.loader import load_scenario
from tlcomm_tools.comparison.design import Design, jobs_of
from tlcomm_tools.comparison.findings import Row, csv_text, document, table_rows
from tlcomm_tools.comparison.measures import MEASURES, SHOWN
from tlcomm_tools.comparison.report import format_findings, markdown
from tlcomm_tools.comparison.sweep import Sweep

DESIGN = Design(
    scenario=load_scenario(Path(__file__).parents[4] / "scenarios" / "corridor.yaml"),
    methods=(Method.TEAM, Method.STATIC),
    seeds=3,
    rounds=5,
    until_s=None,
    solver=DEFAULT,
    sweep=None,
    with_processes=False,
)


SOUND = {"verdict": "ok"}


def result(additional_s: float | None, verdict: object = "ok") -> dict[str, Any]:
    """Return a result document, as far as it is compared."""
    team = {own.name: 1 for own in fields(TeamMetrics)}
    computing = {own.name: None for own in fields(Computing)}
    metrics = {"team": {**team, "additional_s": additional_s}, "computing": computing}
    return {"metrics": metrics, "wall_s": 2.5, "verdict": verdict}


def rows(design: Design, *additional_s: float | None) -> list[Row]:
    """Return a row per job, with its additional time."""
    jobs = jobs_of(design)
    return [Row(job, result(own), SOUND, None) for job, own in zip(jobs, additional_s, strict=True)]


def test_means_and_paired_differences() -> None:
    """What the seeds of all methods have in common is no part of a difference."""
    found = document(DESIGN, rows(DESIGN, 1.0, 5.0, 9.0, 3.0, 7.0, 11.0))
    (point,) = found["points"]
    mean = point["means"]["team"]["additional_s"]
    assert (mean["mean"], mean["count"]) == (5.0, 3)
    assert mean["low"] < 4.0
    assert mean["high"] > 6.0
    assert point["differences"] == {"static": point["differences"]["static"]}
    assert point["differences"]["static"]["additional_s"] == {
        "mean": -2.0,
        "low": -2.0,
        "high": -2.0,
        "count": 3,
    }


def test_what_isnt_available_is_left_out_of_means() -> None:
    """And a difference is of those seeds that both methods have."""
    found = document(DESIGN, rows(DESIGN, 1.0, None, 9.0, None, 7.0, 11.0))
    (point,) = found["points"]
    assert point["means"]["team"]["additional_s"]["count"] == 2
    assert point["differences"]["static"]["additional_s"]["mean"] == -2.0
    assert point["differences"]["static"]["additional_s"]["count"] == 1
    assert point["means"]["team"]["solve_wall_s"] is None


def test_without_the_team_there_are_no_differences() -> None:
    """There is nothing that they would be taken from."""
    design = replace(DESIGN, methods=(Method.STATIC, Method.NONE), seeds=1)
    (point,) = document(design, rows(design, 1.0, 2.0))["points"]
    assert point["differences"] == {}


def test_failures_are_rows_with_their_reason() -> None:
    """In the document, in the CSV and for people; others go on."""
    design = replace(DESIGN, seeds=1)
    team, static = jobs_of(design)
    found = document(
        design,
        [
            Row(team, None, None, "no admissible meeting"),
            Row(static, result(1.0, ["one", "two"]), {"verdict": ["three"]}, None),
        ],
    )
    assert [run["audit"] for run in found["runs"]] == [[], ["three"]]
    assert [run["error"] for run in found["runs"]] == ["no admissible meeting", None]
    assert [run["verdict"] for run in found["runs"]] == [[], ["one", "two"]]
    assert found["runs"][0]["measures"] == dict.fromkeys(MEASURES)
    assert found["points"][0]["means"]["team"] == dict.fromkeys(MEASURES)
    for text in (format_findings(found), markdown(found)):
        assert "- team-0: no admissible meeting\n" in text
        assert "- static-0: one (and 2 more)" in text
        assert "0 of 2 runs keep what their methods promise" in text


def test_what_the_audit_finds_is_a_flaw() -> None:
    """Also where the run itself says that all is well: the command's exit status goes by it."""
    (job,) = jobs_of(replace(DESIGN, methods=(Method.TEAM,), seeds=1))
    assert Row(job, result(1.0), SOUND, None).flaws == []
    assert Row(job, result(1.0), {"verdict": ["three"]}, None).flaws == ["audit: three"]


def test_the_csv_is_the_document() -> None:
    """Row by row, value by value; a sweep begins with its own column."""
    design = replace(DESIGN, sweep=Sweep("range", (1.0, 1.5)), seeds=2)
    found = document(design, rows(design, 0.1, 1 / 3, None, 4.0, 5.0, 6.0, 7.0, 8.0))
    read = list(csv.DictReader(io.StringIO(csv_text(found))))
    assert len(read) == len(found["runs"]) == 8
    assert list(read[0]) == [
        "range",
        "method",
        "seed",
        "folder",
        "error",
        "verdict",
        "audit",
        *MEASURES,
    ]
    for own, run in zip(read, json.loads(json.dumps(found["runs"])), strict=True):
        assert float(own["range"]) == run["value"]
        assert (own["method"], int(own["seed"])) == (run["method"], run["seed"])
        for key in MEASURES:
            assert (float(own[key]) if own[key] else None) == run["measures"][key]
    assert "range" not in table_rows(document(DESIGN, rows(DESIGN, *[1.0] * 6)))[0]


def test_each_value_of_a_sweep_has_its_table() -> None:
    """Under its own heading."""
    design = replace(DESIGN, sweep=Sweep("range", (1.0, 1.5)), seeds=1)
    text = format_findings(document(design, rows(design, 1.0, 2.0, 3.0, 4.5)))
    first, second = text.split("radio range R (m): 1.5")
    assert "radio range R (m): 1\n" in first
    assert re.search(r"additional time \(s\) +-1\.00\n", first)
    assert re.search(r"additional time \(s\) +-1\.50\n", second)


def test_tables_show_intervals_only_of_several_seeds() -> None:
    """A single run has none; and what no method has isn't shown."""
    text = markdown(document(DESIGN, rows(DESIGN, 1.0, 5.0, 9.0, 3.0, 7.0, 11.0)))
    assert "| additional time (s) | 5.00 | 7.00 |\n|  | 1.00…" in text
    assert "solving" not in text
    alone = replace(DESIGN, seeds=1)
    assert "…" not in format_findings(document(alone, rows(alone, 1.0, 2.0)))


@pytest.mark.parametrize("key", SHOWN)
def test_what_is_shown_is_measured(key: str) -> None:
    """Tables know no figure that runs don't have."""
    assert key in MEASURES
