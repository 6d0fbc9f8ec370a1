"""ROS messages, put into a page's document.

``shown_topics``  the topics that a page shows anything of
``Heard``         a message as it was heard
``read_stamp``    when it was said
``Intake``        decodes messages into a document
"""

import contextlib
from collections.abc import Callable, Sequence
from typing import Final

from rosbags.serde import SerdeError
from rosbags.typesys.store import Typestore

from tlcomm_core.protocol.messages import BestResponse
from tlcomm_core.scenario.model import Scenario
from tlcomm_core.wire.fields import WireError
from tlcomm_core.wire.team_messages import decode_message
from tlcomm_tools import wire
from tlcomm_tools.bag.stamps import first_stamp_ns
from tlcomm_tools.bag.topics import Topic, mirror_topics, recorded_topics, split_topic
from tlcomm_tools.live.document import LiveDocument
from tlcomm_tools.report.plans import PLAN_TYPE, read_corners

__all__ = ["Heard", "Intake", "read_stamp", "shown_topics"]

# topic's number among the shown ones, data
Heard = tuple[int, bytes]

# Without the clock: all of these together tell the time often enough.
_SHOWN: Final = frozenset(
    {
        "connectivity",
        "odom",
        "task_event",
        "team_strategy",
        "estimate",
        "best_response",
        "plan",
    }
)

_Taker = Callable[[wire.DecodedMessage, str], None]


def shown_topics(scenario: Scenario) -> tuple[Topic, ...]:
    """Return the topics that a page shows anything of."""
    recorded = recorded_topics(scenario.agents, measures=scenario.field is not None)
    topics = (*recorded, *mirror_topics(scenario.agents))
    return tuple(topic for topic in topics if split_topic(topic.name)[1] in _SHOWN)


def read_stamp(data: bytes) -> int:
    """Return when a message was said (ns); 0 if there is no stamp."""
    try:
        return first_stamp_ns(data)
    except ValueError:
        return 0


class Intake:
    """Decodes messages into a document."""

    def __init__(self, document: LiveDocument, topics: Sequence[Topic], store: Typestore) -> None:
        """Take messages as a store defines them.

        Args:
            document: to be filled.
            topics: a topic's place in this sequence is its number.
            store: their types.
        """
        self._document: Final = document
        self._topics: Final = tuple(topics)
        self._store: Final = store
        self._takers: Final[dict[str, _Taker]] = {
            "tlcomm_msgs/msg/Connectivity": self._take_connectivity,
            "nav_msgs/msg/Odometry": self._take_odometry,
            "tlcomm_msgs/msg/TaskEvent": self._take_event,
            "tlcomm_msgs/msg/TeamStrategy": self._take_strategy,
            "tlcomm_msgs/msg/Estimate": self._take_estimate,
            "tlcomm_msgs/msg/BestResponse": self._take_response,
        }

    def take(self, heard: Heard) -> None:
        """Take a message; one that makes no sense shows nothing."""
        number, data = heard
        topic = self._topics[number]
        if topic.type == PLAN_TYPE:
            self._document.take_plan(topic.agent, read_stamp(data), read_corners(data))
            return
        with contextlib.suppress(WireError, SerdeError, ValueError):
            self._takers[topic.type](self._store.deserialize_cdr(data, topic.type), topic.agent)

    def _take_connectivity(self, message: wire.DecodedMessage, _: str) -> None:
        self._document.take_connectivity(wire.read_connectivity(message))

    def _take_odometry(self, message: wire.DecodedMessage, agent: str) -> None:
        self._document.take_odometry(wire.read_odometry(message, agent))

    def _take_event(self, message: wire.DecodedMessage, _: str) -> None:
        self._document.take_event(wire.read_task_event(message))

    def _take_strategy(self, message: wire.DecodedMessage, agent: str) -> None:
        self._document.take_strategy(wire.read_team_strategy(message, agent))

    def _take_estimate(self, message: wire.DecodedMessage, _: str) -> None:
        self._document.take_estimate(wire.read_estimate(message))

    def _take_response(self, message: wire.DecodedMessage, _: str) -> None:
        said, _sent_ns = decode_message(message, "best_response")
        assert isinstance(said, BestResponse)
        self._document.take_response(said)
