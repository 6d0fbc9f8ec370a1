"""Windows of communication: whether the team was connected for long enough in each.

``Window``         one window's outcome
``judge_windows``  all windows' outcomes, from the intervals in which the team was connected
"""

from collections.abc import Sequence
from dataclasses import dataclass

from tlcomm_core.units import nanoseconds

__all__ = ["TOLERANCE_NS", "Window", "judge_windows"]

TOLERANCE_NS = 1_000
"""By how much a connection may fall short of D_c: rounding of times, never a physical effect."""


@dataclass(frozen=True, slots=True)
class Window:
    """The outcome of the window [r·T_c, (r+1)·T_c).

    Attributes:
        round: r.
        longest_ns: the longest that the team was connected from a time inside the window on.
        satisfied: whether that was D_c.
    """

    round: int
    longest_ns: int
    satisfied: bool


def judge_windows(
    connected_ns: Sequence[tuple[int, int]], period_s: float, duration_s: float, end_ns: int
) -> tuple[Window, ...]:
    """Return the outcome of every window that is decided by the end of the run.

    A window is decided when it is satisfied, or when it is over and no connection that began in it
    is still going on.

    Args:
        connected_ns: [from, to) of each connection of the whole team, ascending and disjoint.
        period_s: T_c.
        duration_s: D_c.
        end_ns: end of the run.

    Source: constraint (2) of the paper: connected during [t', t' + D_c] for some t' in the window.
    """
    period_ns, duration_ns = nanoseconds(period_s), nanoseconds(duration_s)
    windows = []
    for number in range(end_ns // period_ns + 1):
        opens_ns = number * period_ns
        closes_ns = opens_ns + period_ns
        inside = [
            (max(start_ns, opens_ns), stop_ns)
            for start_ns, stop_ns in connected_ns
            if start_ns < closes_ns and stop_ns > opens_ns
        ]
        longest_ns = max((stop_ns - start_ns for start_ns, stop_ns in inside), default=0)
        satisfied = longest_ns >= duration_ns - TOLERANCE_NS
        going_on = any(stop_ns >= end_ns for _, stop_ns in inside)
        if satisfied or (closes_ns <= end_ns and not going_on):
            windows.append(Window(number, longest_ns, satisfied))
    return tuple(windows)
