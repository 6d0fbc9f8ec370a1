"""The promise of constant connection: the team is connected at every instant.

``stay_connected``  whether it was
"""

from collections.abc import Sequence
from itertools import pairwise

from tlcomm_tools.audit.evidence import Evidence
from tlcomm_tools.audit.guarantees.guarantee import Guarantee
from tlcomm_tools.audit.links import Interval

__all__ = ["stay_connected"]

# Rounding of times, far below anything physical.
_SLACK_S = 1e-6


def stay_connected(evidence: Evidence) -> Guarantee:
    """Say when the connection was first broken, how often, and for how long together."""
    breaks = _breaks(evidence.connected, evidence.end_s)
    broken_s = sum(stop_s - start_s for start_s, stop_s in breaks)
    kept_s = evidence.end_s - broken_s
    return Guarantee(
        promise="the team is connected at every instant",
        shown={
            "connected": f"{kept_s:.1f} of {evidence.end_s:.1f} s, by the poses",
            "breaks": str(len(breaks)),
        },
        figures={
            "connected_s": kept_s,
            "breaks": len(breaks),
            "first_break_s": breaks[0][0] if breaks else None,
        },
        violations=_describe(breaks, broken_s),
    )


def _breaks(connected: Sequence[Interval], end_s: float) -> list[Interval]:
    """Return the times from 0 to the end that are in none of the ascending intervals."""
    bounds = [(0.0, 0.0), *connected, (end_s, end_s)]
    return [
        (earlier[1], later[0])
        for earlier, later in pairwise(bounds)
        if later[0] - earlier[1] > _SLACK_S
    ]


def _describe(breaks: Sequence[Interval], broken_s: float) -> tuple[str, ...]:
    if not breaks:
        return ()
    (start_s, stop_s), *more = breaks
    first = f"not connected from {start_s:.3f} s to {stop_s:.3f} s"
    if not more:
        return (first,)
    return (f"{first}, the first of {len(breaks)} breaks, {broken_s:.3f} s together",)
