"""The promise of a schedule: every pair meets again after so many windows, and all are linked.

``keep_schedule``  whether it was kept
"""

from collections import Counter, defaultdict
from collections.abc import Iterator, Mapping, Sequence
from itertools import pairwise

from tlcomm_tools.audit.evidence import Evidence
from tlcomm_tools.audit.guarantees.guarantee import Guarantee
from tlcomm_tools.audit.guarantees.pairs import Pair, agreed_windows
from tlcomm_tools.audit.links import reaches_all

__all__ = ["keep_schedule"]

_SLACK_WINDOWS = 1e-6

_Agreed = Mapping[Pair, Sequence[int]]


def keep_schedule(evidence: Evidence) -> Guarantee:
    """Say which meetings are missing, out of turn, late or at once, and who is out of reach.

    All that is known of the schedule is what was agreed: how many windows a cycle has is what most
    pairs need to meet again. Windows that the run doesn't last to the end of are owed by nobody.
    """
    agreed = agreed_windows(evidence)
    complete = int(evidence.end_s / evidence.scenario.communication.period_s + _SLACK_WINDOWS)
    cycle = _cycle(agreed)
    violations = [
        *_double(agreed),
        *_irregular(agreed, cycle or _span(agreed), complete),
        *_parted(agreed, cycle, complete, evidence.agents),
    ]
    shown = f"{len(agreed)} pairs"
    if cycle is not None:
        shown += f", again after {cycle} windows"
    return Guarantee(
        promise="every pair meets once in each cycle, and pairs link the whole team",
        shown={"schedule": shown},
        figures={"pairs": len(agreed), "cycle_windows": cycle},
        violations=tuple(violations),
    )


def _cycle(agreed: _Agreed) -> int | None:
    """Return after how many windows pairs meet again, or ``None`` if none does."""
    steps = Counter(
        later - earlier for windows in agreed.values() for earlier, later in pairwise(windows)
    )
    return min(steps, key=lambda step: (-steps[step], step), default=None)


def _span(agreed: _Agreed) -> int:
    """Return how many windows there are meetings in: where no pair meets again, a cycle's least."""
    return max(1, len({window for windows in agreed.values() for window in windows}))


def _double(agreed: _Agreed) -> Iterator[str]:
    """Say who is to be in two meetings in one window."""
    partners: dict[tuple[int, str], list[str]] = defaultdict(list)
    for (one, other), windows in agreed.items():
        for window in windows:
            partners[window, one].append(other)
            partners[window, other].append(one)
    for (window, agent), names in sorted(partners.items()):
        if len(names) > 1:
            yield f"window {window}: {agent} is to meet {' and '.join(sorted(names))}"


def _irregular(agreed: _Agreed, cycle: int, complete: int) -> Iterator[str]:
    """Say which meetings are late, missing or out of turn."""
    begin = min((windows[0] for windows in agreed.values()), default=0)
    for (one, other), windows in agreed.items():
        first = windows[0]
        names, rhythm = f"{one} and {other}", f"every {cycle} windows from {first} on"
        if first >= begin + cycle:
            yield f"window {first}: {names} are to meet for the first time, after a whole cycle"
        for window in sorted(set(range(first, complete, cycle)) - set(windows)):
            yield f"window {window}: {names} aren't to meet, though due {rhythm}"
        for window in windows:
            if (window - first) % cycle:
                yield f"window {window}: {names} are to meet out of turn, {rhythm}"


def _parted(
    agreed: _Agreed, cycle: int | None, complete: int, agents: Sequence[str]
) -> Iterator[str]:
    """Say if pairs don't link the whole team, once they had the time to."""
    begin = min((windows[0] for windows in agreed.values()), default=0)
    if agreed and (cycle is None or complete < begin + cycle):
        return
    if len(agents) == 1 or complete <= 1:
        return
    bits = {agent: 1 << index for index, agent in enumerate(agents)}
    neighbours = dict.fromkeys(agents, 0)
    for one, other in agreed:
        if one in bits and other in bits:
            neighbours[one] |= bits[other]
            neighbours[other] |= bits[one]
    lonely = [agent for agent in agents if not neighbours[agent]]
    if lonely:
        yield f"{', '.join(lonely)}: in no pair"
    elif not reaches_all([neighbours[agent] for agent in agents]):
        yield f"the {len(agreed)} pairs don't link the whole team"
