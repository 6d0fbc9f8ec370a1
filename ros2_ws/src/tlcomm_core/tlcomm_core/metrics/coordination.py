"""What agreeing on a round took the team, in wall time: the only figures that differ between runs.

``solve_wall_s``         an agent's own computing
``coordination_wall_s``  from the complete team to the last agreement
"""

from collections.abc import Sequence

from tlcomm_core.agent.timing import RoundTiming

__all__ = ["coordination_wall_s", "solve_wall_s"]


def solve_wall_s(timings: Sequence[RoundTiming]) -> float | None:
    """Return the own computing of the slowest agent; ``None`` if nobody's is known.

    Args:
        timings: of one round.
    """
    return max((timing.solve_wall_s for timing in timings), default=None)


def coordination_wall_s(timings: Sequence[RoundTiming], members: int) -> float | None:
    """Return the time from when all had offered to when all had agreed; ``None`` if unknown.

    It begins when the last agent makes its first offer, so that the team is complete.

    Args:
        timings: of one round.
        members: how many agents meet.
    """
    if len(timings) < members:
        return None
    complete_s = max(timing.offered_wall_s for timing in timings)
    return max(timing.agreed_wall_s for timing in timings) - complete_s
