"""Recorded messages, put into the picture.

``Intake``  decodes messages into a picture
"""

import contextlib
from collections.abc import Callable
from typing import Final

from rosbags.typesys.store import Typestore

from tlcomm_core.wire.fields import WireError
from tlcomm_core.wire.team_messages import decode_offer
from tlcomm_core.wire.world_messages import decode_map
from tlcomm_tools import wire
from tlcomm_tools.bag.topics import Topic
from tlcomm_tools.mirror.odometry import decode_odometry
from tlcomm_tools.mirror.picture import Picture

__all__ = ["Intake"]

_ODOMETRY: Final = "nav_msgs/msg/Odometry"

_Taker = Callable[[wire.DecodedMessage, str], None]


class Intake:
    """Decodes messages into a picture."""

    def __init__(self, picture: Picture, store: Typestore) -> None:
        """Take messages as a store defines them."""
        self._picture: Final = picture
        self._store: Final = store
        self._takers: Final[dict[str, _Taker]] = {
            "nav_msgs/msg/OccupancyGrid": self._take_map,
            "tlcomm_msgs/msg/Connectivity": self._take_connectivity,
            "tlcomm_msgs/msg/TaskEvent": self._take_event,
            "tlcomm_msgs/msg/TeamStrategy": self._take_strategy,
            "tlcomm_msgs/msg/PlanOffer": self._take_offers,
        }

    def wants(self, topic: Topic) -> bool:
        """Return whether the picture shows anything of a topic."""
        return topic.type == _ODOMETRY or topic.type in self._takers

    def take(self, topic: Topic, data: bytes) -> None:
        """Take a message of a topic that is wanted; one that makes no sense shows nothing."""
        if topic.type == _ODOMETRY:
            with contextlib.suppress(ValueError):
                self._picture.take_odometry(decode_odometry(data, topic.agent))
            return
        message = self._store.deserialize_cdr(data, topic.type)
        with contextlib.suppress(ValueError, WireError):
            self._takers[topic.type](message, topic.agent)

    def _take_connectivity(self, message: wire.DecodedMessage, _: str) -> None:
        self._picture.take_connectivity(wire.read_connectivity(message))

    def _take_event(self, message: wire.DecodedMessage, _: str) -> None:
        self._picture.take_event(wire.read_task_event(message))

    def _take_strategy(self, message: wire.DecodedMessage, agent: str) -> None:
        self._picture.agents[agent].held = wire.read_team_strategy(message, agent)

    def _take_offers(self, message: wire.DecodedMessage, agent: str) -> None:
        """Take what an agent offers itself; the rest of a message it only relays."""
        for offer in message.offers:
            if offer.agent == agent:
                self._picture.agents[agent].offered = (message.round, decode_offer(offer))

    def _take_map(self, message: wire.DecodedMessage, _: str) -> None:
        rows, columns = self._picture.site.grid.shape
        if (message.info.height, message.info.width) == (rows, columns):
            self._picture.charts.take(*decode_map(message))
