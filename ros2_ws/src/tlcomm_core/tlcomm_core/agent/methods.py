"""Which brain, and which team, a method of coordination makes.

``brain_for``  an agent's brain
``rules_for``  what the places of meetings must be
"""

from tlcomm_core.agent.brain import Brain, TeamBrain
from tlcomm_core.agent.lone_brain import LoneBrain
from tlcomm_core.agent.settings import Settings
from tlcomm_core.game.rules import Rules
from tlcomm_core.method import Method
from tlcomm_core.scenario.model import Communication

__all__ = ["brain_for", "rules_for"]


def brain_for(method: Method, settings: Settings) -> Brain:
    """Return an agent's brain."""
    return LoneBrain(settings) if method is Method.NONE else TeamBrain(settings)


def rules_for(method: Method, communication: Communication) -> Rules:
    """Return what the places of meetings must be."""
    return Rules(
        separation_m=communication.separation_m,
        resilience=communication.resilience,
        keeps_places=method is Method.STATIC,
    )
