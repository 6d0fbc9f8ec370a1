"""What the places of a meeting must be, beside connected.

``Rules``          a scenario's demands on the places of a meeting
``PLAIN_RULES``    those of the paper: none
``is_admissible``  whether a team may meet at some places
``crowding``       who is too close to another
``indispensable``  whose failure would part the others
``lone_cuts``      the places of such agents
``open_places``    where one agent may go while the others stay
"""

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from tlcomm_core.game.links import Links
from tlcomm_core.game.resilience import cut_places

__all__ = [
    "PLAIN_RULES",
    "Rules",
    "crowding",
    "indispensable",
    "is_admissible",
    "lone_cuts",
    "open_places",
]

# A team of two is apart when one fails, wherever they meet.
_LEAST_RESILIENT_TEAM: Final = 3


@dataclass(frozen=True, slots=True)
class Rules:
    """A scenario's demands on the places of a meeting.

    Attributes:
        separation_m: the least distance between two agents' places; 0 lets them share one.
        resilience: how many agents may fail so that the others are still connected, 0 or 1. A team
            of less than three is only connected.
        keeps_places: everybody meets where it stands now, so that only the time is open.
    """

    separation_m: float = 0.0
    resilience: int = 0
    keeps_places: bool = False


PLAIN_RULES: Final = Rules()
"""The paper's: a meeting has to be connected, no more."""


def is_admissible(links: Links, rules: Rules, places: Sequence[int]) -> bool:
    """Tell whether a team may meet at some places, one for each agent."""
    if not links.is_connected(places):
        return False
    return not crowding(links, rules, places) and not indispensable(links, rules, places)


def crowding(links: Links, rules: Rules, places: Sequence[int]) -> tuple[int, ...]:
    """Return the agents, ascending, whose places are too close to another's."""
    if not rules.separation_m:
        return ()
    return tuple(
        agent
        for agent, place in enumerate(places)
        if links.crowded(place, rules.separation_m)[[*places[:agent], *places[agent + 1 :]]].any()
    )


def indispensable(links: Links, rules: Rules, places: Sequence[int]) -> tuple[int, ...]:
    """Return the agents, ascending, without whom the others would be apart but mustn't be.

    Args:
        links: between the places.
        rules: whether that matters.
        places: of the agents, connected.
    """
    if not rules.resilience or len(places) < _LEAST_RESILIENT_TEAM:
        return ()
    cuts = lone_cuts(links, places)
    return tuple(agent for agent, place in enumerate(places) if place in cuts)


def open_places(links: Links, rules: Rules, others: Sequence[int]) -> NDArray[np.bool_]:
    """Tell where one more agent makes the team's places admissible.

    Args:
        links: between the places.
        rules: that hold.
        others: the places of all the others, admissible but for the connection through the agent.

    Returns:
        [Z], fresh.

    Source: Υ_i in Section IV-B3 of the paper, without its ball.
    """
    mask = links.connecting(others)
    if rules.separation_m:
        for place in others:
            mask &= ~links.crowded(place, rules.separation_m)
    if rules.resilience and len(others) + 1 >= _LEAST_RESILIENT_TEAM:
        mask &= _backed_up(links, others)
    return mask


def _backed_up(links: Links, others: Sequence[int]) -> NDArray[np.bool_]:
    """Tell where one more agent makes the team one that can lose anyone, itself included.

    Without it the others must be connected. Without another, it must be linked to each component
    of the rest: that is one unless the other is a cut, and then two links are enough.
    """
    if not links.is_connected(others):
        return np.zeros(len(links), dtype=np.bool_)
    near = np.concatenate([links.near(place) for place in others])
    mask = np.bincount(near, minlength=len(links)) > 1
    for cut in sorted(lone_cuts(links, others)):
        mask &= links.connecting([place for place in others if place != cut])
    return mask


def lone_cuts(links: Links, places: Sequence[int]) -> frozenset[int]:
    """Return the places whose only agent holds others together: where two are, one may go."""
    lone = {place for place, agents in Counter(places).items() if agents == 1}
    return cut_places(links, places) & lone
