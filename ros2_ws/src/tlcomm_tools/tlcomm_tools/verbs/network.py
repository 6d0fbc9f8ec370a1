"""Rehearse meetings over bad radio: how long agreement takes, and how often longer than D_c."""

import math
import statistics
from argparse import ArgumentParser, Namespace
from typing import Any, Final

from tlcomm_core.errors import InputError
from tlcomm_core.scenario.model import Radio
from tlcomm_tools.campaign import LATENCY_S, MOST_AGENTS, Campaign, rehearse
from tlcomm_tools.status import Status
from tlcomm_tools.table import format_number, format_table
from tlcomm_tools.verbs.options import (
    add_seed_argument,
    not_negative_float,
    positive_float,
    positive_int,
    print_json,
    share,
    team_size,
)

__all__ = ["EXAMPLE", "add_arguments", "run"]

EXAMPLE: Final = "tlcomm network --agents 8 20 --loss 0.3 --jitter 0.05 --duplication 0.2"

_PERCENTILE: Final = 95


def add_arguments(parser: ArgumentParser) -> None:
    """Add the verb's arguments."""
    parser.add_argument(
        "--agents",
        type=team_size(MOST_AGENTS),
        nargs="+",
        default=[8],
        metavar="N",
        help=f"team sizes, from 2 to {MOST_AGENTS} (default 8)",
    )
    parser.add_argument(
        "--meetings", type=positive_int, default=100, metavar="N", help="of each (default 100)"
    )
    parser.add_argument(
        "--loss", type=share, default=0.3, metavar="P", help="of each message (default 0.3)"
    )
    parser.add_argument(
        "--jitter", type=not_negative_float, default=0.05, metavar="S", help="(s; default 0.05)"
    )
    parser.add_argument("--duplication", type=share, default=0.2, metavar="P", help="(default 0.2)")
    parser.add_argument(
        "--duration", type=positive_float, default=5.0, metavar="S", help="D_c (s; default 5)"
    )
    parser.add_argument(
        "--best-response",
        action="store_true",
        help="agree by best responses alone; otherwise proposals come first",
    )
    add_seed_argument(parser, of="the first meeting")


def run(options: Namespace) -> Status:
    """Rehearse and show the table.

    Raises:
        InputError: no message would be sure to arrive while a meeting lasts.
    """
    slowest_s = LATENCY_S + options.jitter
    if slowest_s >= options.duration:
        raise InputError(
            f"--duration: {options.duration!r} isn't longer than a message may take"
            f" ({slowest_s:.9g} s: {LATENCY_S!r} s and --jitter); expected a longer meeting"
        )
    radio = Radio(loss=options.loss, jitter_s=options.jitter, duplication=options.duplication)
    measured = [
        _measure(
            Campaign(
                agents=agents,
                meetings=options.meetings,
                radio=radio,
                duration_s=options.duration,
                proposes=not options.best_response,
                seed=options.seed,
            )
        )
        for agents in options.agents
    ]
    if options.json:
        print_json(
            {
                "format": "tlcomm-network/1",
                "radio": radio.model_dump(),
                "duration_s": options.duration,
                "proposals": not options.best_response,
                "seed": options.seed,
                "teams": measured,
            }
        )
    else:
        print(_format(measured, options))
    return Status.FINE


def _measure(campaign: Campaign) -> dict[str, Any]:
    """Return a campaign's figures; times over all meetings, ``None`` where that is too late."""
    results = list(rehearse(campaign))
    times_s = sorted(result.agreed_s for result in results)
    late = sum(time_s == math.inf for time_s in times_s)
    # The least time that so many of a hundred meetings don't exceed.
    high_s = times_s[math.ceil(_PERCENTILE / 100 * len(times_s)) - 1]
    return {
        "agents": campaign.agents,
        "meetings": campaign.meetings,
        "late": late,
        "median_s": _finite(statistics.median_low(times_s)),
        "p95_s": _finite(high_s),
        "longest_s": _finite(times_s[-1]),
        "messages": statistics.fmean(result.messages for result in results),
    }


def _finite(time_s: float) -> float | None:
    return time_s if time_s < math.inf else None


def _format(measured: list[dict[str, Any]], options: Namespace) -> str:
    way = "best responses" if options.best_response else "proposals, then best responses"
    title = (
        f"{options.meetings} meetings each, by {way}\n"
        f"  {options.loss:.0%} lost, {options.duplication:.0%} doubled, "
        f"{1000.0 * options.jitter:g} ms jitter; D_c = {options.duration:g} s"
    )
    rows = [
        [
            str(team["agents"]),
            str(team["late"]),
            *(format_number(team[key], 2) for key in ("median_s", "p95_s", "longest_s")),
            format_number(team["messages"], 0),
        ]
        for team in measured
    ]
    header = ["agents", "late", "median/s", "95 %/s", "longest/s", "messages/agent"]
    return f"{title}\n{format_table(header, rows)}"
