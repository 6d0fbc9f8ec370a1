"""On which topic each kind of message is said.

``TEAM_TOPICS``  the topics that agents talk on
``topic_of``     the one on which something is said
"""

from collections.abc import Mapping
from types import MappingProxyType
from typing import Final

from tlcomm_core.protocol.messages import (
    BestResponse,
    Confirmation,
    EstimateExchange,
    PlanOffer,
    Proposal,
    TeamMessage,
)

__all__ = ["TEAM_TOPICS", "topic_of"]

_TOPICS: Final[Mapping[type[TeamMessage], str]] = MappingProxyType(
    {
        PlanOffer: "plan_offer",
        Proposal: "proposal",
        BestResponse: "best_response",
        Confirmation: "confirmation",
        EstimateExchange: "estimate_exchange",
    }
)
TEAM_TOPICS: Final = tuple(_TOPICS.values())
"""The topics that agents talk on."""


def topic_of(message: TeamMessage) -> str:
    """Return the topic on which something is said."""
    return _TOPICS[type(message)]
