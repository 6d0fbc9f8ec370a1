"""What a team knows beforehand that takes turns, and meets whenever a turn is over.

``TurnTeam``  a team whose rounds are turns
``pause_s``   how long it stays together before the next turn
"""

import math
from dataclasses import dataclass
from typing import Final

from tlcomm_core.protocol.team import Team

__all__ = ["TurnTeam", "pause_s"]

# At one place everyone hears everyone. Then these exchanges come one after the other: the offer of
# the last to arrive, those that it lacks, two of best responses, the confirmation, and that all
# confirmations are known; one is spare.
_EXCHANGES: Final = 7
# For computing, and for timers that are late.
_COMPUTING_S: Final = 0.2
# How probably some message of an exchange still lacks after the repetitions that are waited for.
_LACKING: Final = 1e-6
_MOST_REPETITIONS: Final = 100


@dataclass(frozen=True, slots=True)
class TurnTeam(Team):
    """A team whose rounds are turns: none has a time before or after which it can't be.

    ``duration_s`` is the pause between two turns instead of D_c.

    Attributes:
        off_m: how far a member may be off its place.
    """

    off_m: float = 0.0

    def opens_s(self, round_: int) -> float:
        """Return when a round's window opens: it always is open."""
        del round_
        return 0.0

    def window_s(self, round_: int) -> tuple[float, float]:
        """Return a round's window, [0, ∞)."""
        return self.opens_s(round_), math.inf

    def horizon_s(self, window: int, departure_s: float) -> float:
        """Return how far offers look ahead: T_c, in which any agent gets to its next action."""
        del window, departure_s
        return self.period_s

    def confirmable_until_s(self, round_: int) -> float:
        """Return until when a round may be confirmed: for ever, as nobody goes before."""
        del round_
        return math.inf


def pause_s(team: Team, latency_s: float, jitter_s: float = 0.0, loss: float = 0.0) -> float:
    """Return how long after the last arrival all members at one place hardly ever lack agreement.

    They leave together then; who lacks it comes later. One exchange is allowed the worst luck; that
    others have it at the same meeting too is less likely still. How long messages wait for each
    other on a narrow band isn't reckoned with.

    Args:
        team: says how often messages are repeated.
        latency_s: of each message.
        jitter_s: by how much it may be later.
        loss: probability that a message isn't heard.
    """
    lacking, repeated_s, wait_s = loss * len(team.members) ** 2, 0.0, team.retry_s
    for _ in range(_MOST_REPETITIONS):
        if lacking <= _LACKING:
            break
        lacking *= loss
        repeated_s += wait_s
        wait_s = min(2.0 * wait_s, team.longest_retry_s)
    return _COMPUTING_S + _EXCHANGES * (latency_s + jitter_s) + repeated_s
