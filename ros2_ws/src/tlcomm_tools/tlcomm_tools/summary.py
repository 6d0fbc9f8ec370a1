"""A run's results for people.

``format_summary``  the text
"""

import statistics
from collections import Counter
from collections.abc import Mapping, Sequence
from typing import Any

from tlcomm_tools.folder import RunFolder
from tlcomm_tools.table import format_number, format_table

__all__ = ["format_summary"]

_SHOWN_ROUNDS = 12
_SHOWN_FAILURES = 20


def format_summary(result: Mapping[str, Any], folder: RunFolder, *, has_bag: bool) -> str:
    """Return a summary for a terminal of 80 columns.

    Args:
        result: the result document.
        folder: where everything is.
        has_bag: whether there is a bag to check.
    """
    links = result["communication"]
    wall = format_number(result["wall_s"], 1, "s")
    factor = format_number(result["realtime_factor"], 1, "× real time")
    parts = [
        "{scenario}, method {method}, solver {solver}, seed {seed}, pace {pace}".format(**result),
        _format_verdict(result["verdict"]),
        "",
        f"  windows kept     {links['satisfied']} of {links['windows']}",
        f"  simulated        {format_number(result['sim_s'], 1, 's')} in {wall}, {factor}",
        *_format_metrics(result["metrics"]["team"]),
        *_format_times(result["rounds"]),
        *_format_undelivered(result["agents"]),
        "",
        _format_agents(result["agents"]),
    ]
    if result["rounds"]:
        parts += ["", _format_rounds(result["rounds"])]
    parts += ["", f"files   {folder.path}"]
    if has_bag:
        parts.append(f"check   scripts/tlcomm check {folder.path}")
    return "\n".join(parts)


def _format_verdict(verdict: str | Sequence[str]) -> str:
    if isinstance(verdict, str):
        return f"verdict: {verdict}"
    shown = [f"  - {line}" for line in verdict[:_SHOWN_FAILURES]]
    if len(verdict) > _SHOWN_FAILURES:
        shown.append(f"  … and {len(verdict) - _SHOWN_FAILURES} more")
    return "\n".join(["verdict: FAILED", *shown])


def _format_metrics(team: Mapping[str, Any]) -> list[str]:
    """Return the figures of the team that methods are compared by, as far as there are any."""

    def told(key: str, digits: int = 1, unit: str = "s") -> str:
        return format_number(team[key], digits, unit)

    lines = {
        "makespan_sum_s": f"makespans        {told('makespan_sum_s')} together",
        "additional_s": (
            f"additional time  {told('additional_s')} per meeting: detour {told('detour_s')}, "
            f"wait {told('wait_s')}; {told('additional_with_duration_s')} with D_c"
        ),
        "lost_per_window_s": f"lost time        {told('lost_per_window_s')} of each window",
        "information_age_max_s": (
            f"information age  {told('information_age_mean_s')} on average, "
            f"at most {told('information_age_max_s')}"
        ),
        "deviation_max": (
            f"deviation        {told('deviation_mean', 3, '')} on average, "
            f"at most {told('deviation_max', 3, '')}, "
            f"{told('deviation_settled_max', 3, '')} once settled"
        ),
    }
    return [f"  {line}" for key, line in lines.items() if team[key] is not None]


def _format_times(rounds: Sequence[Mapping[str, Any]]) -> list[str]:
    lines = []
    for name, key in (("own computing", "solve_wall_s"), ("coordination", "coordination_wall_s")):
        times_s = [own[key] for own in rounds if own[key] is not None]
        if times_s:
            lines.append(
                f"  {name:15}  median {1e3 * statistics.median(times_s):.1f} ms, "
                f"at most {1e3 * max(times_s):.1f} ms per round"
            )
    return lines


def _format_undelivered(agents: Mapping[str, Mapping[str, Any]]) -> list[str]:
    """Return how many messages weren't heard, by reason, if any."""
    counts: Counter[str] = Counter()
    for own in agents.values():
        counts.update(own["messages_undelivered"] or {})
    reasons = ", ".join(f"{reason} {count}" for reason, count in sorted(counts.items()))
    return [f"  not heard        {reasons}"] if reasons else []


def _format_agents(agents: Mapping[str, Mapping[str, Any]]) -> str:
    rows = [
        (
            name,
            str(own["tasks_satisfied"]),
            format_number(own["makespan_s"]),
            format_number(own["distance_m"]),
            format_number(own["messages_sent"], 0),
            format_number(own["bytes_sent"], 0),
        )
        for name, own in agents.items()
    ]
    return format_table(("agent", "tasks", "makespan/s", "distance/m", "messages", "bytes"), rows)


def _format_rounds(rounds: Sequence[Mapping[str, Any]]) -> str:
    shown = rounds[-_SHOWN_ROUNDS:]
    # Where not all meet in each round, it matters who did.
    tells_who = len({tuple(own["members"]) for own in rounds}) > 1
    rows = []
    for own in shown:
        extra_s = [value for value in own["additional_time"].values() if value is not None]
        rows.append(
            (
                str(own["round"]),
                format_number(own["t_c"]),
                format_number(own["initial_potential"]),
                format_number(own["potential"]),
                str(own["iterations"]),
                format_number(sum(extra_s) if extra_s else None),
                format_number(max(extra_s, default=None)),
                *([" ".join(own["members"])] if tells_who else []),
            )
        )
    header = ("round", "t_c/s", "Φ(S⁰)/s", "Φ/s", "moves", "additional/s", "worst agent/s")
    table = format_table((*header, "who") if tells_who else header, rows, left=0)
    left_out = len(rounds) - len(shown)
    return f"  … {left_out} rounds before\n{table}" if left_out else table
