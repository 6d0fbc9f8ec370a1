"""Which brain, and which team, a method of coordination makes.

``brain_for``  an agent's brain
``rules_for``  what the places of meetings must be
"""

from tlcomm_core.agent.brain import Brain, TeamBrain
from tlcomm_core.agent.lone_brain import LoneBrain
from tlcomm_core.agent.pairs import pairs_of
from tlcomm_core.agent.pairwise_brain import PairwiseBrain
from tlcomm_core.agent.settings import Settings
from tlcomm_core.game.rules import Rules
from tlcomm_core.method import Method
from tlcomm_core.scenario.model import Communication
from tlcomm_core.scenario.site import Site

__all__ = ["brain_for", "rules_for"]


def brain_for(method: Method, settings: Settings, site: Site) -> Brain:
    """Return an agent's brain."""
    match method:
        case Method.NONE:
            return LoneBrain(settings)
        case Method.PAIRWISE:
            return _pairwise_brain(settings, site)
        case _:
            return TeamBrain(settings)


def _pairwise_brain(settings: Settings, site: Site) -> Brain:
    """Return the brain of a member of pairs; a single agent has nobody to meet."""
    pairs = [pair for pair in pairs_of(site) if settings.name in pair.members]
    return PairwiseBrain(settings, pairs) if pairs else LoneBrain(settings)


def rules_for(method: Method, communication: Communication) -> Rules:
    """Return what the places of meetings must be."""
    return Rules(
        separation_m=communication.separation_m,
        resilience=communication.resilience,
        keeps_places=method is Method.STATIC,
    )
