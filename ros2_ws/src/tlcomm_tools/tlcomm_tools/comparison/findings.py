"""What a comparison found: a row per run, and means and differences of methods with intervals.

``Row``         a run's outcome
``document``    all of it, as in ``comparison.json``
``table_rows``  its runs as rows of a table
``csv_text``    the same as in ``comparison.csv``
``FORMAT``      the document's ``format``
"""

import csv
import io
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass
from typing import Any, Final

from tlcomm_core.method import Method
from tlcomm_tools.bootstrap import CONFIDENCE, estimate_mean
from tlcomm_tools.comparison.design import Design
from tlcomm_tools.comparison.job import Job
from tlcomm_tools.comparison.measures import MEASURES, SHOWN, figures_of

__all__ = ["FORMAT", "Row", "csv_text", "document", "table_rows"]

FORMAT: Final = "tlcomm-compare/1"


@dataclass(frozen=True, slots=True)
class Row:
    """A run's outcome.

    Attributes:
        job: what was run.
        result: its result document; ``None`` if there is no run.
        audit: the audit's document; ``None`` if there is no run.
        error: why there is none; ``None`` if there is one.
    """

    job: Job
    result: Mapping[str, Any] | None
    audit: Mapping[str, Any] | None
    error: str | None

    @property
    def figures(self) -> dict[str, float | None]:
        """Every measure of the run, ``None`` where it has none."""
        if self.result is None:
            return dict.fromkeys(MEASURES)
        return figures_of(self.result)

    @property
    def flaws(self) -> list[str]:
        """What failed: the reason why there is no run, or what its verdict and its audit say."""
        if self.result is None:
            return [str(self.error)]
        return [*_failures(self.result), *(f"audit: {line}" for line in _failures(self.audit))]


def _failures(judged: Mapping[str, Any] | None) -> list[str]:
    verdict = "ok" if judged is None else judged["verdict"]
    return [] if verdict == "ok" else list(verdict)


def document(design: Design, rows: Sequence[Row]) -> dict[str, Any]:
    """Return what a comparison found, ready for ``json.dumps``.

    A mean is over the seeds that have the measure. A difference is that of ``team`` and another
    method in the same repetition, so that what all methods have in common is no part of it.

    Args:
        design: what was compared.
        rows: all runs, in the order of jobs.
    """
    sweep = design.sweep
    return {
        "format": FORMAT,
        "scenario": design.scenario.name,
        "harness": "run" if design.with_processes else "simulate",
        "solver": design.solver.name,
        "rounds": design.rounds,
        "until_s": design.until_s,
        "seeds": design.seeds,
        "confidence": CONFIDENCE,
        "sweep": None if sweep is None else {"name": sweep.name, "values": list(sweep.values)},
        "measures": {key: asdict(measure) for key, measure in SHOWN.items()},
        "runs": [_run(row) for row in rows],
        "points": [_point(value, own) for value, own in _by_value(rows)],
    }


def table_rows(found: Mapping[str, Any]) -> list[dict[str, Any]]:
    """Return a document's runs as rows of equal columns, ``None`` where there is nothing.

    A sweep's rows begin with the column of what is varied, called like it.
    """
    swept = found["sweep"] and found["sweep"]["name"]
    return [
        {
            **({swept: run["value"]} if swept else {}),
            "method": run["method"],
            "seed": run["seed"],
            "folder": run["folder"],
            "error": run["error"],
            "verdict": "; ".join(run["verdict"]) or None,
            "audit": "; ".join(run["audit"]) or None,
            **run["measures"],
        }
        for run in found["runs"]
    ]


def csv_text(found: Mapping[str, Any]) -> str:
    """Return a document's rows as CSV; nothing stands for what isn't available."""
    rows = table_rows(found)
    text = io.StringIO()
    writer = csv.DictWriter(text, list(rows[0]), lineterminator="\n")
    writer.writeheader()
    writer.writerows(rows)
    return text.getvalue()


def _run(row: Row) -> dict[str, Any]:
    job = row.job
    return {
        "value": job.value,
        "method": job.method.value,
        "seed": job.seed,
        "folder": job.folder,
        "error": row.error,
        "verdict": [] if row.result is None else _failures(row.result) or ["ok"],
        "audit": [] if row.audit is None else _failures(row.audit) or ["ok"],
        "measures": row.figures,
    }


def _by_value(rows: Sequence[Row]) -> Iterator[tuple[float | None, list[Row]]]:
    for value in dict.fromkeys(row.job.value for row in rows):
        yield value, [row for row in rows if row.job.value == value]


def _point(value: float | None, rows: Sequence[Row]) -> dict[str, Any]:
    """Return means and differences at one value of what is swept."""
    methods = list(dict.fromkeys(row.job.method for row in rows))
    by_method = {
        method: {row.job.seed: row.figures for row in rows if row.job.method is method}
        for method in methods
    }
    team = by_method.get(Method.TEAM, {})
    return {
        "value": value,
        "means": {
            method.value: {key: _mean(_known(own, key)) for key in MEASURES}
            for method, own in by_method.items()
        },
        "differences": {
            method.value: {
                key: _mean(_differences(_known(team, key), _known(own, key))) for key in MEASURES
            }
            for method, own in by_method.items()
            if team and method is not Method.TEAM
        },
    }


def _known(own: Mapping[int, Mapping[str, float | None]], key: str) -> dict[int, float]:
    """Return a measure by seed, where there is one."""
    return {seed: value for seed, figures in own.items() if (value := figures[key]) is not None}


def _differences(team: Mapping[int, float], other: Mapping[int, float]) -> dict[int, float]:
    return {seed: team[seed] - other[seed] for seed in team if seed in other}


def _mean(by_seed: Mapping[int, float]) -> dict[str, Any] | None:
    estimate = estimate_mean(list(by_seed.values()))
    return None if estimate is None else asdict(estimate)
