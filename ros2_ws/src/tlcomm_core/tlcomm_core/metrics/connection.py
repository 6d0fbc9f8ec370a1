"""When the team, or two of it, were connected, by the world's own account.

``connected_intervals``  from when to when the whole team was
``windows_of``           whether that was long enough in each window of communication
``pair_windows_of``      the same for the pairs that meet by turns, each in its own windows
"""

from collections.abc import Callable, Sequence

from tlcomm_core.agent.pairs import Pair, pairs_of
from tlcomm_core.records import RunRecords
from tlcomm_core.scenario.model import Scenario
from tlcomm_core.scenario.site import Site
from tlcomm_core.windows import Window, judge_windows
from tlcomm_core.world.observation import Connectivity

__all__ = ["connected_intervals", "pair_windows_of", "windows_of"]

Intervals = list[tuple[int, int]]
"""[from, to) in nanoseconds, ascending and disjoint."""


def connected_intervals(connectivity: Sequence[Connectivity], end_ns: int) -> Intervals:
    """Return [from, to) of each connection of the whole team; the last state holds to the end."""
    return _intervals(connectivity, end_ns, lambda seen: seen.connected)


def windows_of(scenario: Scenario, records: RunRecords, end_ns: int) -> tuple[Window, ...]:
    """Return the outcome of every window that is decided by the end, whatever the method.

    Source: constraint (2) of the paper.
    """
    return _judged(scenario, connected_intervals(records.connectivity, end_ns), end_ns)


def pair_windows_of(
    scenario: Scenario, records: RunRecords, end_ns: int
) -> dict[Pair, tuple[Window, ...]]:
    """Return, for each pair of the schedule, the outcome of its windows that are decided.

    A window is kept if the two hear each other, without others between them, for D_c.

    Cost: O(pairs · changes of the links).
    """
    number = {name: index for index, name in enumerate(scenario.agents)}
    outcomes = {}
    for pair in pairs_of(Site.from_scenario(scenario)):
        first, second = sorted(number[name] for name in pair.members)
        link = (first, second)
        windows = _judged(scenario, _linked(records.connectivity, link, end_ns), end_ns)
        outcomes[pair] = tuple(window for window in windows if pair.meets_in(window.round))
    return outcomes


def _linked(connectivity: Sequence[Connectivity], link: tuple[int, int], end_ns: int) -> Intervals:
    return _intervals(connectivity, end_ns, lambda seen: link in seen.edges)


def _intervals(
    connectivity: Sequence[Connectivity], end_ns: int, holds: Callable[[Connectivity], bool]
) -> Intervals:
    """Return from when to when something held of the links; the last state holds to the end."""
    intervals: Intervals = []
    since_ns: int | None = None
    for seen in connectivity:
        is_so = holds(seen)
        if is_so and since_ns is None:
            since_ns = seen.stamp_ns
        elif not is_so and since_ns is not None:
            intervals.append((since_ns, seen.stamp_ns))
            since_ns = None
    if since_ns is not None:
        intervals.append((since_ns, end_ns))
    return intervals


def _judged(scenario: Scenario, linked_ns: Intervals, end_ns: int) -> tuple[Window, ...]:
    timing = scenario.communication
    return judge_windows(linked_ns, timing.period_s, timing.duration_s, end_ns)
