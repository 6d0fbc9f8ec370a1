"""States that a negotiation passes through, to try messages upon.

``States``      copies of one agent's negotiation at every turn of a meeting
``is_settled``  whether it is done with everything
"""

import copy
import math
from dataclasses import dataclass, field
from functools import cached_property

from support.fake_network import FakeNetwork, Faults
from support.meetings import Meeting, sample_meeting
from tlcomm_core.protocol.actions import SendMessage
from tlcomm_core.protocol.messages import Message
from tlcomm_core.protocol.negotiation import Negotiation, Phase

__all__ = ["States", "is_settled"]


def is_settled(negotiation: Negotiation) -> bool:
    """Return whether an agent has agreed and falls silent."""
    return negotiation.phase is Phase.AGREED and negotiation.next_need_s == math.inf


@dataclass
class States:
    """A line of four plans; ``agent_01`` hears 00 and 02, and knows of 03 by hearsay.

    Attributes:
        meeting: the four.
        own: who is looked at.
        beside: its neighbours.
        beyond: a member that it can't hear.
    """

    meeting: Meeting = field(default_factory=lambda: sample_meeting("line", 4, 7))
    own: str = "agent_01"
    beside: tuple[str, str] = ("agent_00", "agent_02")
    beyond: str = "agent_03"

    @cached_property
    def network(self) -> FakeNetwork:
        """The whole meeting, over a jittery network so that messages come apart."""
        network = self._fresh()
        network.run()
        return network

    @cached_property
    def negotiations(self) -> dict[str, Negotiation]:
        """The first and the last state of each phase, and of being settled, by name."""
        network, states = self._fresh(), dict[str, Negotiation]()
        while network.next_s < math.inf:
            network.step()
            if self.own in network.agents:
                now = network.agents[self.own]
                name = "settled" if is_settled(now) else now.phase.value
                states.setdefault(f"first {name}", copy.deepcopy(now))
                states[f"last {name}"] = copy.deepcopy(now)
        return states

    @cached_property
    def said(self) -> tuple[Message, ...]:
        """All that was said, each thing once, in order."""
        actions = (entry.action for entry in self.network.transcript)
        return tuple(
            dict.fromkeys(action.message for action in actions if isinstance(action, SendMessage))
        )

    def _fresh(self) -> FakeNetwork:
        meeting = self.meeting
        return FakeNetwork(
            meeting.offers,
            meeting.round,
            meeting.team,
            meeting.rounds,
            Faults(jitter_s=0.02),
            seed=3,
        )
