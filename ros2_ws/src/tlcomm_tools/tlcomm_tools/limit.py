"""How long a run may last at most.

``time_limit_s``  the simulated time at which it ends, whether or not its rounds are done
"""

from tlcomm_core.method import Method
from tlcomm_core.scenario.model import Scenario

__all__ = ["time_limit_s"]


def time_limit_s(
    scenario: Scenario, rounds: int | None, until_s: float | None, method: Method = Method.TEAM
) -> float:
    """Return the simulated time at which a run ends at the latest.

    The meeting of round N begins before (N+1)·T_c, so a run that goes on D_c after that has lost
    it: it ends there with its window missed instead of going on for ever. One second is spare.
    Where the team doesn't meet in windows, the run ends with window N.

    Args:
        scenario: what is run.
        rounds: N, or ``None``.
        until_s: the end asked for, or ``None``; one of the two is given.
        method: of coordination.
    """
    if until_s is not None:
        return until_s
    assert rounds is not None
    timing = scenario.communication
    closes_s = (rounds + 1) * timing.period_s
    return closes_s + timing.duration_s + 1.0 if method.meets_in_windows else closes_s
