"""What agreeing on a round took the team, in wall time: the only figures that differ between runs.

``indexed``              times by round and agent
``timings_of``           those of one meeting
``solve_wall_s``         an agent's own computing
``coordination_wall_s``  from the complete team to the last agreement
"""

from collections.abc import Iterable, Mapping, Sequence

from tlcomm_core.agent.timing import RoundTiming
from tlcomm_core.metrics.meeting import Meeting

__all__ = ["coordination_wall_s", "indexed", "solve_wall_s", "timings_of"]

Index = Mapping[tuple[int, str], RoundTiming]


def indexed(timings: Iterable[RoundTiming]) -> Index:
    """Return times by round and agent; fresh."""
    return {(timing.round, timing.agent): timing for timing in timings}


def timings_of(meeting: Meeting, timings: Index) -> list[RoundTiming]:
    """Return what agreeing on a meeting took its members, of those of whom it is known; fresh."""
    keys = ((meeting.round, name) for name in meeting.members)
    return [timings[key] for key in keys if key in timings]


def solve_wall_s(timings: Sequence[RoundTiming]) -> float | None:
    """Return the own computing of the slowest agent; ``None`` if nobody's is known.

    Args:
        timings: of one meeting.
    """
    return max((timing.solve_wall_s for timing in timings), default=None)


def coordination_wall_s(timings: Sequence[RoundTiming], members: int) -> float | None:
    """Return the time from when all had offered to when all had agreed; ``None`` if unknown.

    It begins when the last agent makes its first offer, so that the team is complete.

    Args:
        timings: of one meeting, one of each member that has agreed.
        members: how many agents meet.
    """
    if len(timings) < members:
        return None
    complete_s = max(timing.offered_wall_s for timing in timings)
    return max(timing.agreed_wall_s for timing in timings) - complete_s
