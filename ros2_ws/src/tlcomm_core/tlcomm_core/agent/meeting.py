"""One meeting, from the arrival at the place to leaving it.

``Meeting``  the negotiation, and how long it is worth staying for it
``News``     what happens there

A meeting begins with the last arrival, t_c, and lasts for D_c. Whoever then holds the strategy as
agreed, and sees that its neighbours do, leaves. On a bad network some don't:

* Who has agreed, but may be the one whose word a neighbour lacks, lingers a little.
* Who has confirmed stays for the others' confirmations as long as it can still be at its place by
  the next t_c, going straight there. Then it leaves in any case: others may have agreed.
* Who hasn't confirmed stays until it is too late for that; so nobody can have agreed.

How the team comes together again is said in ``protocol.whereabouts``.
"""

import math
from collections.abc import Callable
from enum import Enum
from typing import Final

from tlcomm_core.agent.actions import Fault, TaskEventKind
from tlcomm_core.game.strategy import Strategy, TeamStrategy
from tlcomm_core.protocol.actions import Action
from tlcomm_core.protocol.negotiation import Negotiation
from tlcomm_core.protocol.team import Team
from tlcomm_core.protocol.whereabouts import Ending
from tlcomm_core.units import is_due

__all__ = ["Meeting", "News"]


class News(Enum):
    """What happens at a meeting, each at most once."""

    STARTED = "everybody is there, and t_c has come"
    AGREED = "the next meeting is agreed"
    OBSTRUCTED = "the next window can't be met in"
    OVERDUE = "it is over without agreement"


class Meeting:
    """The negotiation of round r at the meeting of round r − 1, and when to leave it.

    Attributes:
        negotiation: what is said.
    """

    def __init__(
        self,
        own: str,
        negotiation: Negotiation,
        team: Team,
        leave_by_s: Callable[[TeamStrategy], float],
    ) -> None:
        """Be there.

        Args:
            own: this agent's name.
            negotiation: of the next round.
            team: the team.
            leave_by_s: when to leave at the latest to be punctual at what comes next, if that is
                what the team has confirmed, going straight there.
        """
        self.negotiation: Final = negotiation
        self._told: set[News] = set()
        self._own = own
        self._linger_s = team.linger_s
        self._duration_s = team.duration_s
        self._window = team.planned_in(negotiation.round)
        self._latest_s = team.confirmable_until_s(negotiation.round)
        self._leave_by_s = leave_by_s
        self._confirmed_s = math.inf
        self._agreed_s = math.inf
        self._settled_s = math.inf
        self._punctual_s = math.inf

    def proceed(self, now_s: float) -> tuple[Action, ...]:
        """Let the negotiation go on.

        Raises:
            InfeasibleRoundError: no admissible meeting exists in the next window.
        """
        actions = self.negotiation.proceed(now_s)
        if self.negotiation.confirmed is not None and self._confirmed_s == math.inf:
            self._confirmed_s = now_s
            self._punctual_s = self._leave_by_s(self.negotiation.confirmed)
        if self.negotiation.agreed is not None:
            self._agreed_s = min(self._agreed_s, now_s)
        if self.negotiation.is_settled:
            self._settled_s = min(self._settled_s, now_s)
        return actions

    def news(self, now_s: float) -> tuple[News, ...]:
        """Return what has happened since this was last asked."""
        negotiation = self.negotiation
        is_agreed = negotiation.agreed is not None
        starts_s = negotiation.meeting_s
        happened = {
            News.STARTED: starts_s is not None and is_due(starts_s, now_s),
            News.AGREED: is_agreed,
            News.OBSTRUCTED: negotiation.obstacle is not None,
            News.OVERDUE: is_due(self.over_s, now_s) and not is_agreed,
        }
        news = tuple(kind for kind in News if happened[kind] and kind not in self._told)
        self._told.update(news)
        return news

    def own_part(self, strategy: TeamStrategy) -> Strategy:
        """Return this agent's part in a team strategy."""
        return strategy.part_of(self._own)

    def tell(self, what: News | Ending) -> tuple[TaskEventKind, int, str]:
        """Return how to report something that has happened here: kind, round and detail."""
        negotiation = self.negotiation
        window, round_ = self._window, negotiation.round
        match what:
            case News.STARTED:
                return TaskEventKind.MEETING_STARTED, window, f"t_c_s={negotiation.meeting_s:.9f}"
            case News.AGREED:
                agreed = negotiation.agreed
                return TaskEventKind.ROUND_AGREED, round_ if agreed is None else agreed.round, ""
            case News.OBSTRUCTED:
                return TaskEventKind.FAULT, window, f"{Fault.INFEASIBLE}={negotiation.obstacle}"
            case Ending.AGREED:
                return TaskEventKind.MEETING_ENDED, window, ""
            case _:
                how = "late" if what is News.OVERDUE else what.value
                detail = f"{Fault.DISAGREEMENT}={how} round={round_}"
                return TaskEventKind.FAULT, window, detail

    @property
    def is_agreed(self) -> bool:
        """Whether the news has been told that the next meeting is agreed."""
        return News.AGREED in self._told

    @property
    def over_s(self) -> float:
        """t_c + D_c; inf while t_c isn't known."""
        starts_s = self.negotiation.meeting_s
        return math.inf if starts_s is None else starts_s + self._duration_s

    @property
    def is_prolonged(self) -> bool:
        """Whether this agent stays, or stayed, for longer than D_c."""
        return self._settled_s > self.over_s

    @property
    def next_need_s(self) -> float:
        """When the meeting must go on, whatever is heard until then."""
        return min(self.negotiation.next_need_s, self.next_change_s)

    @property
    def next_change_s(self) -> float:
        """When it starts, is over or is to be left, as far as that is known."""
        starts_s = self.negotiation.meeting_s
        if starts_s is not None and News.STARTED not in self._told:
            return min(starts_s, self._stays_until_s)
        if not self._told.isdisjoint((News.AGREED, News.OVERDUE)):
            return self._stays_until_s
        return min(self.over_s, self._stays_until_s)

    def ending(self, now_s: float) -> Ending | None:
        """Return how the meeting has ended for this agent, if it is time to leave."""
        if not is_due(self._stays_until_s, now_s):
            return None
        if self.negotiation.agreed is not None:
            return Ending.AGREED
        if self.negotiation.confirmed is not None:
            return Ending.DOUBTFUL
        return Ending.MISSED if self.negotiation.meeting_s is None else Ending.GATHERED

    @property
    def _stays_until_s(self) -> float:
        """When to leave, from what is known now."""
        if self._settled_s < math.inf:
            return self.over_s
        if self._confirmed_s == math.inf:
            return self._latest_s
        if self._agreed_s < math.inf:
            until_s = max(self.over_s, self._agreed_s) + self._linger_s
        else:
            until_s = max(self.over_s + self._linger_s, self._punctual_s)
        return max(self.over_s, min(until_s, self._latest_s))
