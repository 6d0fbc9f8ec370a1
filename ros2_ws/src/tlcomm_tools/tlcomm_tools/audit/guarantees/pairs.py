"""The promise of pairs: who agrees to meet in a window is together for D_c in it.

``Pair``        two agents
``agreed_windows``  when each pair agreed to meet
``meet_in_pairs``   whether they did
"""

from collections import defaultdict
from collections.abc import Iterator

from tlcomm_tools.audit.evidence import Evidence
from tlcomm_tools.audit.guarantees.guarantee import Guarantee
from tlcomm_tools.table import format_number

__all__ = ["Pair", "agreed_windows", "meet_in_pairs"]

_PAIR = 2

Pair = tuple[str, str]
"""Two agents, in order of their names."""


def agreed_windows(evidence: Evidence) -> dict[Pair, list[int]]:
    """Return the windows, ascending, that each pair's strategies are for."""
    windows: dict[Pair, set[int]] = defaultdict(set)
    for record in evidence.records.strategies:
        names = sorted(own.agent for own in record.strategy.strategies)
        if len(names) == _PAIR:
            windows[names[0], names[1]].add(record.strategy.round)
    return {pair: sorted(windows[pair]) for pair in sorted(windows)}


def meet_in_pairs(evidence: Evidence) -> Guarantee:
    """Say which pairs weren't within range of each other for D_c in a window of theirs."""
    duration_s = evidence.scenario.communication.duration_s
    violations = list(_not_of_two(evidence))
    longest_s = []
    met = 0
    for pair, windows in agreed_windows(evidence).items():
        # A window that the run didn't last to decide has no finding.
        for own in evidence.windows_of(pair):
            if own.round not in windows:
                continue
            longest_s.append(own.longest_s)
            met += own.satisfied
            if not own.satisfied:
                violations.append(
                    f"window {own.round}: {pair[0]} and {pair[1]} are in range of each other for "
                    f"{own.longest_s:.3f} s, not {duration_s:g} s"
                )
    shortest_s = min(longest_s, default=None)
    return Guarantee(
        promise="a pair is connected for D_c in the window that it agrees on",
        shown={
            "pairs met": f"{met} of {len(longest_s)} times, by the poses",
            "shortest meeting": format_number(shortest_s, 3, "s"),
        },
        figures={"meetings": len(longest_s), "meetings_kept": met, "shortest_s": shortest_s},
        violations=tuple(violations),
    )


def _not_of_two(evidence: Evidence) -> Iterator[str]:
    for held in dict.fromkeys(record.strategy for record in evidence.records.strategies):
        names = sorted({own.agent for own in held.strategies})
        if len(names) != _PAIR or not set(names) <= set(evidence.agents):
            yield f"window {held.round}: strategies of {names}, not of two agents"
