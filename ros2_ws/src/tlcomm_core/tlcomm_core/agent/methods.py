"""Which brain, and which team, a method of coordination makes.

``brain_for``  an agent's brain
``rules_for``  what the places of meetings must be
``rounds_for`` what poses the rounds
"""

from tlcomm_core.agent.brain import Brain, TeamBrain
from tlcomm_core.agent.charts import Charts
from tlcomm_core.agent.lone_brain import LoneBrain
from tlcomm_core.agent.pairs import pairs_of
from tlcomm_core.agent.pairwise_brain import PairwiseBrain
from tlcomm_core.agent.rounds import MeetingRounds
from tlcomm_core.agent.settings import Settings
from tlcomm_core.agent.turn_brain import TurnBrain
from tlcomm_core.agent.turn_rounds import TurnRounds
from tlcomm_core.game.rules import Rules
from tlcomm_core.method import Method
from tlcomm_core.protocol.negotiation import Rounds
from tlcomm_core.protocol.team import Team
from tlcomm_core.protocol.turns import TurnTeam
from tlcomm_core.scenario.model import Communication
from tlcomm_core.scenario.site import Site

__all__ = ["brain_for", "rounds_for", "rules_for"]


def brain_for(method: Method, settings: Settings, site: Site) -> Brain:
    """Return an agent's brain."""
    match method:
        case Method.NONE:
            return LoneBrain(settings)
        case Method.PAIRWISE:
            return _pairwise_brain(settings, site)
        case Method.ALL_TIME:
            assert isinstance(settings.rounds, TurnRounds), "rounds_for makes them for its team"
            return TurnBrain(settings, settings.rounds)
        case _:
            return TeamBrain(settings)


def _pairwise_brain(settings: Settings, site: Site) -> Brain:
    """Return the brain of a member of pairs; a single agent has nobody to meet."""
    pairs = [pair for pair in pairs_of(site) if settings.name in pair.members]
    return PairwiseBrain(settings, pairs) if pairs else LoneBrain(settings)


def rounds_for(team: Team, charts: Charts, allowance_s: float) -> Rounds:
    """Return what poses a team's rounds.

    Args:
        team: the team.
        charts: the maps that the agent knows.
        allowance_s: that travel times are computed with.
    """
    if isinstance(team, TurnTeam):
        return TurnRounds(charts, team, allowance_s)
    return MeetingRounds(charts, team, allowance_s)


def rules_for(method: Method, communication: Communication) -> Rules:
    """Return what the places of meetings must be."""
    if method is Method.ALL_TIME:
        return Rules(keeps_places=True)
    return Rules(
        separation_m=communication.separation_m,
        resilience=communication.resilience,
        keeps_places=method is Method.STATIC,
    )
