"""What a comparison found, for people.

``format_findings``  for a terminal
``markdown``         the same as Markdown, for ``comparison.md``
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any, Final

from tlcomm_tools.comparison.measures import SHOWN, Measure
from tlcomm_tools.comparison.sweep import QUANTITIES, shown
from tlcomm_tools.table import format_table

__all__ = ["format_findings", "markdown"]

_SHOWN_FLAWS: Final = 12
_MISSING: Final = "–"

Table = Callable[[Sequence[str], Sequence[Sequence[str]]], str]


def format_findings(found: Mapping[str, Any]) -> str:
    """Return a comparison's document as text.

    Args:
        found: the document.
    """
    return "\n\n".join([_title(found), *_sections(found, _as_text, "  {}"), *_flaws(found, "  - ")])


def markdown(found: Mapping[str, Any]) -> str:
    """Return a comparison's document as Markdown.

    Args:
        found: the document.
    """
    sections = _sections(found, _as_markdown, "{}")
    return "\n\n".join([f"# {_title(found)}", *sections, *_flaws(found, "- ")]) + "\n"


def _title(found: Mapping[str, Any]) -> str:
    length = f"{found['rounds']} rounds" if found["until_s"] is None else f"{found['until_s']:g} s"
    return "{scenario}: {length}, {seeds} {unit}, solver {solver}, by {harness}".format(
        length=length, unit="seed" if found["seeds"] == 1 else "seeds", **found
    )


def _sections(found: Mapping[str, Any], table: Table, line: str) -> Iterator[str]:
    """Yield a heading and two tables at each point; where there is nothing to show, none."""
    for point in found["points"]:
        if point["value"] is not None:
            yield f"{QUANTITIES[found['sweep']['name']].label}: {shown(point['value'])}"
        yield table(*_cells("mean", point["means"]))
        if point["differences"]:
            yield table(*_cells("team less", point["differences"]))
    if found["seeds"] > 1:
        confidence = f"{found['confidence']:.0%}"
        yield line.format(f"Beneath each mean: its {confidence} interval, by bootstrap over seeds.")


def _cells(
    corner: str, columns: Mapping[str, Mapping[str, Any]]
) -> tuple[list[str], list[list[str]]]:
    """Return header and rows: two rows a measure, means and beneath them their intervals."""
    rows = []
    for key, measure in SHOWN.items():
        estimates = [own[key] for own in columns.values()]
        if not any(estimates):
            continue
        rows.append([measure.label, *(_mean(own, measure) for own in estimates)])
        intervals = [_interval(own, measure) for own in estimates]
        if any(intervals):
            rows.append(["", *intervals])
    return [corner, *columns], rows


def _mean(estimate: Mapping[str, Any] | None, measure: Measure) -> str:
    return _MISSING if estimate is None else _number(estimate["mean"], measure)


def _interval(estimate: Mapping[str, Any] | None, measure: Measure) -> str:
    if estimate is None or estimate["low"] is None:
        return ""
    return "…".join(_number(estimate[end], measure) for end in ("low", "high"))


def _number(value: float, measure: Measure) -> str:
    return f"{value:z.{measure.digits}f}"


def _flaws(found: Mapping[str, Any], bullet: str) -> Iterator[str]:
    """Yield what failed, run by run, and how many runs the audit passes."""
    passed, count = sum(run["audit"] == ["ok"] for run in found["runs"]), len(found["runs"])
    yield (
        f"{bullet.removesuffix('- ')}Audited independently: {passed} of {count} runs keep what"
        " their methods promise."
    )
    lines = []
    for run in found["runs"]:
        audited = [f"audit: {line}" for line in run["audit"] if line != "ok"]
        said = [line for line in run["verdict"] if line != "ok"]
        flaws = [run["error"]] if run["error"] else [*said, *audited]
        if flaws:
            more = f" (and {len(flaws) - 1} more)" if len(flaws) > 1 else ""
            lines.append(f"{bullet}{run['folder']}: {flaws[0]}{more}")
    if lines:
        left_out = len(lines) - _SHOWN_FLAWS
        tail = [f"{bullet}… and {left_out} more runs"] if left_out > 0 else []
        yield "\n".join(["Failed:", *lines[:_SHOWN_FLAWS], *tail])


def _as_text(header: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    return format_table(header, rows)


def _as_markdown(header: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    rule = ["---", *("---:" for _ in header[1:])]
    return "\n".join(f"| {' | '.join(cells)} |" for cells in [header, rule, *rows])
