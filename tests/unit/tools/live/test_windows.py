"""Which windows were kept, as they are decided."""

from itertools import pairwise

import pytest

from tlcomm_core.units import nanoseconds
from tlcomm_core.windows import judge_windows
from tlcomm_core.world.observation import Connectivity
from tlcomm_tools.live.growing import Growing
from tlcomm_tools.live.windows import Windows

PERIOD_S, DURATION_S, END_S = 10.0, 2.0, 60.0


@pytest.mark.parametrize(
    "changes_s",
    [
        [],
        [0.0, 2.0],
        [0.0, 1.9, 12.0, 15.0, 33.0, 36.0],
        [9.0, 11.5, 18.5, 20.2, 29.0, 30.9, 45.0, 60.0],
        [5.0, 60.0],
    ],
)
def test_windows_are_judged_as_afterwards(changes_s: list[float]) -> None:
    """Connected and not by turns, told of every half second: each is listed once, in order."""
    decided = Growing("windows")
    windows = Windows(decided, PERIOD_S, DURATION_S)
    spans_s = [*pairwise(changes_s)][::2]
    for half in range(int(2 * END_S) + 1):
        time_s = 0.5 * half
        within = [own for own in changes_s if time_s - 0.5 < own <= time_s]
        for moment_s in sorted({*within, time_s}):
            is_connected = any(start_s <= moment_s < stop_s for start_s, stop_s in spans_s)
            windows.follow(Connectivity(nanoseconds(moment_s), (), connected=is_connected))
    windows.advance(nanoseconds(END_S))
    spans_ns = [(nanoseconds(start_s), nanoseconds(stop_s)) for start_s, stop_s in spans_s]
    judged = judge_windows(spans_ns, PERIOD_S, DURATION_S, nanoseconds(END_S))
    known = [own for own in judged if own.round < END_S // PERIOD_S]
    assert decided.items[: len(known)] == [
        {"round": own.round, "satisfied": own.satisfied} for own in known
    ]
    assert len(decided.items) == len(known)
