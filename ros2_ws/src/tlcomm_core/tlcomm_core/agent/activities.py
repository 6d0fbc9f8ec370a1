"""What an agent does between two meetings.

``Driving``  on the way
``Acting``   at a step's region
"""

import math
from dataclasses import dataclass

from tlcomm_core.agent.controller import Follower
from tlcomm_core.game.strategy import Strategy
from tlcomm_core.planning.plan import PlanStep
from tlcomm_core.workspace.travel import Leg

__all__ = ["Acting", "Driving"]


@dataclass(slots=True)
class Driving:
    """On the way to the next step or to a place of meeting.

    Attributes:
        leg: the way.
        follower: drives it.
        meeting: where it leads; ``None`` for the next step.
        control_s: when the follower is to be asked again.
        ends_s: when it ends at the earliest.
        is_early: it has come to the end before that.
        displaced_m: how far something has put the agent off its way.
        is_closed: the map has closed the way since.
    """

    leg: Leg
    follower: Follower
    meeting: Strategy | None
    control_s: float
    ends_s: float = -math.inf
    is_early: bool = False
    displaced_m: float | None = None
    is_closed: bool = False


@dataclass(frozen=True, slots=True)
class Acting:
    """At a step's region.

    Attributes:
        step: what is done there.
        until_s: when it is done.
    """

    step: PlanStep
    until_s: float
