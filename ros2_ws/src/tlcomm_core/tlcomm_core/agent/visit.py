"""One stay at a place of meeting, of an agent that meets one partner after another.

``Partner``     what an agent keeps of one of its pairs
``partner_of``  what it knows of one beforehand
``Encounter``   a meeting of the two
``Visit``       all encounters at one place
"""

import math
from collections import deque
from dataclasses import dataclass, field, replace

from tlcomm_core.agent.meeting import Meeting
from tlcomm_core.agent.offering import Presence
from tlcomm_core.agent.pairs import Pair
from tlcomm_core.game.offer import PlannedStop
from tlcomm_core.geometry import Pose
from tlcomm_core.protocol.team import OnInfeasible, Team
from tlcomm_core.protocol.whereabouts import Ending, Place, Whereabouts
from tlcomm_core.units import is_due

__all__ = ["Encounter", "Partner", "Visit", "partner_of"]

_UNKNOWN = Whereabouts((math.nan, math.nan))


@dataclass(slots=True)
class Partner:
    """What an agent keeps of one of its pairs.

    Attributes:
        name: the other's.
        pair: when they meet.
        team: the two of them.
        window: that of their present or next meeting.
        whereabouts: of this agent, with the pair's windows counted one by one.
    """

    name: str
    pair: Pair
    team: Team
    window: int = 0
    whereabouts: Whereabouts = _UNKNOWN

    @property
    def place_m(self) -> Place:
        """Where the agent is to be in ``window``, agreed or not."""
        return self.whereabouts.place(self.pair.turn(self.window))

    @property
    def next_window(self) -> int:
        """The one after ``window``."""
        return self.pair.after(self.window)

    def part(self, ending: Ending, new_m: Place | None) -> None:
        """Be on the way to the next meeting.

        Args:
            ending: how the present one has ended.
            new_m: the agent's place in the strategy that it has confirmed, if it has.
        """
        turn = self.pair.turn(self.window)
        self.whereabouts = self.whereabouts.after(turn, ending, new_m)
        self.window = self.next_window


def partner_of(name: str, pair: Pair, team: Team) -> Partner:
    """Return what an agent knows beforehand of the other of a pair.

    A pair can't put a meeting off to its next window: others will be agreed for those in between.

    Args:
        name: the agent's.
        pair: to which it belongs.
        team: the whole team.
    """
    (other,) = (member for member in pair.members if member != name)
    skips = team.on_infeasible is OnInfeasible.SKIP
    two = replace(
        team,
        members=frozenset(pair.members),
        stride=pair.stride,
        on_infeasible=OnInfeasible.WAIT if skips else team.on_infeasible,
    )
    return Partner(other, pair, two)


@dataclass(slots=True)
class Encounter:
    """A meeting of two under way.

    Attributes:
        partner: whom the agent meets.
        meeting: of the two.
        stops: what the agent has offered.
        is_booked: whether their next meeting is in the diary.
        is_over: whether the agent may leave, for this partner's part.
    """

    partner: Partner
    meeting: Meeting
    stops: tuple[PlannedStop, ...]
    is_booked: bool = False
    is_over: bool = False

    @property
    def next_need_s(self) -> float:
        """When it must go on, whatever is heard until then."""
        meeting = self.meeting
        return meeting.negotiation.next_need_s if self.is_over else meeting.next_need_s

    def ending(self, now_s: float) -> Ending | None:
        """Return how the meeting has ended for the agent, if it has just now.

        Two who see that they can't plan their next window part after D_c: they have others to meet
        before it.
        """
        if self.is_over:
            return None
        is_met = is_due(self.meeting.over_s, now_s)
        if is_met and self.meeting.negotiation.obstacle is not None:
            return Ending.GATHERED
        return self.meeting.ending(now_s)

    def pose_after(self, task_index: int) -> Pose:
        """Return in which pose the agent finishes a step that it has offered."""
        stop = next(stop for stop in self.stops if stop.task_index == task_index)
        return Pose(stop.x_m, stop.y_m, stop.yaw_rad)


@dataclass(slots=True)
class Visit:
    """A stay at a place of meeting.

    Attributes:
        presence: how the agent is there.
        ahead: partners here with whom it hasn't begun to plan.
        encounters: with the others, in order; several at the start only.
    """

    presence: Presence
    ahead: deque[Partner]
    encounters: list[Encounter] = field(default_factory=list)

    @property
    def latest(self) -> Encounter:
        """The encounter that began last."""
        return self.encounters[-1]

    @property
    def next_need_s(self) -> float:
        """When one of the encounters must go on, whatever is heard until then."""
        return min(encounter.next_need_s for encounter in self.encounters)

    @property
    def is_alone(self) -> bool:
        """Whether no partner has been heard of here."""
        return all(own.meeting.negotiation.is_alone for own in self.encounters)

    @property
    def is_over(self) -> bool:
        """Whether all meetings here are."""
        return not self.ahead and all(own.is_over for own in self.encounters)

    def with_sender(self, name: str) -> Encounter | None:
        """Return the encounter with a partner, if there is one."""
        return next((own for own in self.encounters if own.partner.name == name), None)
