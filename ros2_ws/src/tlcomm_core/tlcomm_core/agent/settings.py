"""What an agent's brain is made of.

``Settings``  all of it
"""

from dataclasses import dataclass

from tlcomm_core.agent.controller import Pacing
from tlcomm_core.agent.faults import ActionFaults
from tlcomm_core.agent.planner import Planner
from tlcomm_core.planning.plan import LocalPlan
from tlcomm_core.protocol.negotiation import Rounds
from tlcomm_core.protocol.team import Team
from tlcomm_core.workspace.travel import TravelTimes

__all__ = ["Settings"]


@dataclass(frozen=True, slots=True)
class Settings:
    """What a brain is made of.

    Attributes:
        name: the agent's name.
        plan: its local plan.
        travel: travel times with its own motion.
        planner: makes its plan anew when the map changes.
        team: the team.
        rounds: poses round problems.
        position_tolerance_m: how far its controller may be off a waypoint.
        most_deviation_m: further off its way than this it has been displaced.
        pacing: how often its controller is asked.
        faults: which attempts at actions fail.
        retries: how often a failed action is begun anew before the next meeting.
    """

    name: str
    plan: LocalPlan
    travel: TravelTimes
    planner: Planner
    team: Team
    rounds: Rounds
    position_tolerance_m: float
    most_deviation_m: float
    pacing: Pacing
    faults: ActionFaults
    retries: int
