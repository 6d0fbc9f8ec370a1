"""What agreeing on a round takes an agent, in wall time.

``RoundTiming``  what it took one agent for one round
``TimedMember``  a member whose steps are measured while it plans a round
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Final

from tlcomm_core.agent.actions import Action
from tlcomm_core.agent.member import Member
from tlcomm_core.protocol.actions import HoldStrategy, SendMessage
from tlcomm_core.protocol.negotiation import Phase

__all__ = ["RoundTiming", "TimedMember"]


@dataclass(frozen=True, slots=True)
class RoundTiming:
    """Wall time that one agent spent on one round.

    Attributes:
        agent: whose.
        round: the round agreed on.
        solve_wall_s: its own computing, from the tables to the equilibrium: what it takes by the
            wall clock of a computer that it needn't share.
        offered_wall_s: when it first offered its plan (seconds of the wall clock's epoch).
        agreed_wall_s: when it held the strategy as agreed (the same clock).
    """

    agent: str
    round: int
    solve_wall_s: float
    offered_wall_s: float
    agreed_wall_s: float


# A step from one of these to one of those went through the whole of Algorithm 1, or began it.
_EARLIER: Final = (None, Phase.GATHERING)
_LATER: Final = (Phase.IMPROVING, Phase.CONFIRMING, Phase.AGREED)


class TimedMember:
    """A member whose steps are measured while it plans a round.

    The clocks are the shell's, so that the core stays without any.
    """

    def __init__(
        self, member: Member, stopwatch_s: Callable[[], float], wall_s: Callable[[], float]
    ) -> None:
        """Measure ``member``.

        Args:
            member: whose steps.
            stopwatch_s: a clock of this agent's own computing, such as ``time.thread_time``:
                agents that share a computer would otherwise count each other's.
            wall_s: a clock that all processes share, such as ``time.time``.
        """
        self.member = member
        self._stopwatch_s = stopwatch_s
        self._wall_s = wall_s
        self._solve_wall_s = 0.0
        self._offered_wall_s: float | None = None

    def step(self, now_ns: int) -> tuple[tuple[Action, ...], RoundTiming | None]:
        """Take a step; return its actions and, when it agreed on a round, what that took.

        Raises:
            InfeasibleRoundError: the team has no admissible next meeting.
        """
        begin_wall_s = self._wall_s()
        begin_s = self._stopwatch_s()
        before, ended = self.member.phase, self.member.meetings_ended
        actions = self.member.step(now_ns)
        elapsed_s = self._stopwatch_s() - begin_s
        held = next((a.strategy for a in actions if isinstance(a, HoldStrategy)), None)
        if before is Phase.IMPROVING or (before in _EARLIER and self.member.phase in _LATER):
            self._solve_wall_s += elapsed_s
        if held is None and self.member.meetings_ended != ended:
            # What a meeting without agreement took is nothing of the next one's.
            self._solve_wall_s, self._offered_wall_s = 0.0, None
        # What is still said after the agreement offers nothing.
        is_planning = before is not Phase.AGREED and self.member.phase is not None
        if is_planning and self._offered_wall_s is None and _says_something(actions):
            self._offered_wall_s = begin_wall_s
        if held is None:
            return actions, None
        timing = RoundTiming(
            agent=self.member.name,
            round=held.round,
            solve_wall_s=self._solve_wall_s,
            offered_wall_s=begin_wall_s if self._offered_wall_s is None else self._offered_wall_s,
            agreed_wall_s=self._wall_s(),
        )
        self._solve_wall_s = 0.0
        self._offered_wall_s = None
        return actions, timing


def _says_something(actions: tuple[Action, ...]) -> bool:
    return any(isinstance(action, SendMessage) for action in actions)
