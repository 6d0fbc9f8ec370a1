"""Whether agents heard only what was said, by somebody in range, and not before.

``audit_hearing``  what an agent can't have heard
``unheard``        of which agents, and from when on, it isn't known what they heard

In lock step a message is heard by who is in range, and in sight if need be, when it arrives: at one
instant. Running freely, agents are told who is in range at least once a second, and may learn of it
as late as that; so there the message must come from whom it was in range of at some time in the
second before it was said.
"""

from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import groupby
from operator import attrgetter
from typing import Final

import numpy as np
from numpy.typing import NDArray

from tlcomm_core.pace import Pace
from tlcomm_core.records import HeardRecord
from tlcomm_tools.audit.evidence import Evidence
from tlcomm_tools.audit.proximity import Proximity

__all__ = ["audit_hearing", "unheard"]

# Running freely, how late an agent may learn who is in range, and what time it is.
_LAG_S: Final = 1.0
_TIME_SLACK_S: Final = 1e-6
_COPIES: Final = 2


@dataclass(frozen=True, slots=True)
class _Rule:
    """When a message is heard.

    Attributes:
        arrival_s: how long after it was said it arrives.
        lag_s: how long before that it may be that speaker and hearer were in range.
        copies: how often one is heard at the most.
    """

    arrival_s: float
    lag_s: float
    copies: int


def unheard(evidence: Evidence, pace: Pace | None) -> tuple[str, ...]:
    """Say of whom, and from when on, nothing tells what they heard; or why of nobody."""
    until_ns = evidence.records.heard_until_ns
    if not until_ns:
        return ("nothing recorded of what agents heard",)
    if pace is None:
        return ("the bag doesn't say its run's pace, which tells when a message is heard",)
    return tuple(_gaps(evidence, until_ns))


def audit_hearing(evidence: Evidence, pace: Pace | None) -> Iterator[str]:
    """Say what agents heard that wasn't said, was said later, or came from too far away.

    Args:
        evidence: the run.
        pace: whether it was in lock step; ``None`` if that isn't known, and nothing is audited.

    Cost: about 2 µs for each message.
    """
    if pace is None:
        return
    rule = _rule(evidence, pace)
    said = Counter((own.agent, own.topic, own.stamp_ns) for own in evidence.records.said)
    heard = sorted(evidence.records.heard, key=attrgetter("agent", "sender"))
    for _, group in groupby(heard, key=attrgetter("agent", "sender")):
        own = list(group)
        if own[0].agent == own[0].sender:
            yield from _line(own, "which is its own")
            continue
        yield from _unsaid(own, said, rule)
        yield from _early(own, rule)
        yield from _distant(evidence, own, rule)


def _rule(evidence: Evidence, pace: Pace) -> _Rule:
    scenario = evidence.scenario
    copies = _COPIES if scenario.radio.duplication else 1
    if pace.is_lockstep:
        return _Rule(scenario.communication.hop_latency_s, 0.0, copies)
    return _Rule(0.0, _LAG_S, copies)


def _gaps(evidence: Evidence, until_ns: Mapping[str, int]) -> Iterator[str]:
    for agent in evidence.agents:
        if agent not in until_ns:
            yield f"{agent}: nothing recorded of what it heard"
        elif until_ns[agent] * 1e-9 < evidence.end_s - _LAG_S:
            yield f"{agent}: nothing recorded of what it heard after {until_ns[agent] * 1e-9:.3f} s"


def _unsaid(
    heard: Sequence[HeardRecord], said: Mapping[tuple[str, str, int], int], rule: _Rule
) -> Iterator[str]:
    """Say what wasn't said, or not as often."""
    times: Counter[tuple[str, str, int]] = Counter()
    never, again = [], []
    for own in heard:
        message = (own.sender, own.topic, own.said_ns)
        times[message] += 1
        if message not in said:
            never.append(own)
        elif times[message] > rule.copies * said[message]:
            again.append(own)
    yield from _line(never, "which was never said")
    yield from _line(again, "more often than it was said")


def _early(heard: Sequence[HeardRecord], rule: _Rule) -> Iterator[str]:
    """Say what was heard before it was said, or before it can arrive."""
    least_s = rule.arrival_s - rule.lag_s - _TIME_SLACK_S
    early = [own for own in heard if (own.stamp_ns - own.said_ns) * 1e-9 < least_s]
    before = [own for own in early if own.stamp_ns < own.said_ns]
    hasty = [own for own in early if own.stamp_ns >= own.said_ns]
    yield from _line(before, "before it was said")
    yield from _line(hasty, f"sooner than {rule.arrival_s:g} s after")


def _distant(evidence: Evidence, heard: Sequence[HeardRecord], rule: _Rule) -> Iterator[str]:
    """Say what came from out of range or sight."""
    agent, sender = heard[0].agent, heard[0].sender
    if not evidence.track_of.keys() >= {agent, sender}:
        return
    proximity = Proximity.of(evidence, agent, sender)
    times_s = np.array([own.said_ns for own in heard]) * 1e-9 + rule.arrival_s
    apart = ~proximity.linked_at(times_s)
    if rule.lag_s:
        apart[apart] = ~proximity.linked_within(times_s[apart] - rule.lag_s, times_s[apart])
    if not apart.any():
        return
    distances_m = proximity.distances_m(times_s[apart])
    far = [own for own, is_apart in zip(heard, apart.tolist(), strict=True) if is_apart]
    yield from _line(far, _whence(distances_m, evidence.scenario.communication.range_m))


def _whence(distances_m: NDArray[np.float64], range_m: float) -> str:
    first_m = float(distances_m[0])
    if first_m <= range_m:
        return f"from {first_m:.3f} m away, out of sight"
    return f"from {first_m:.3f} m away, out of range"


def _line(heard: Iterable[HeardRecord], how: str) -> Iterator[str]:
    """Say what was first heard so, and how much there is."""
    own = sorted(heard, key=attrgetter("stamp_ns"))
    if not own:
        return
    first = own[0]
    count = "" if len(own) == 1 else f"; {len(own)} messages in all"
    yield (
        f"{first.agent}: {first.stamp_ns * 1e-9:.3f} s: heard {first.topic!r} of {first.sender}, "
        f"said at {first.said_ns * 1e-9:.3f} s, {how}{count}"
    )
